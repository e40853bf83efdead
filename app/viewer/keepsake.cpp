#include "viewer/keepsake.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file.hpp"

namespace dioptre {

namespace {

// The farthest distance that a setting names; beyond it, infinity.
constexpr double kFarthestFocus = 1e9;

}  // namespace

Settings settingsOf(const Moment& moment, const Settings& shown) {
    Settings settings = shown;
    settings.view.time = moment.time;
    // A scene's camera may move by itself, and says more than a pose; what a trace added cannot be said otherwise.
    if (!shown.focus.headTrace.empty()) settings.view.pose = numbersOf(moment.head);
    settings.focus.headTrace.clear();
    settings.focus.gazeTrace.clear();
    settings.focus.gaze = {std::clamp(moment.gaze.position.x, 0.0, 1.0), std::clamp(moment.gaze.position.y, 0.0, 1.0)};
    RenderSettings& render = settings.render;
    render.technique = moment.plan.technique;
    render.budgetMs.reset();
    if (moment.plan.msaa) render.msaa = *moment.plan.msaa;
    if (moment.plan.samples) render.samples = *moment.plan.samples;
    if (moment.plan.subsamples) render.subsamples = *moment.plan.subsamples;
    // An eye that cannot reach infinity is asked for it all the same.
    settings.focus.focus = moment.focus.value * kFarthestFocus > 1.0
                               ? FocusChoice{FocusMode::metres, distance(moment.focus).value}
                               : FocusChoice{FocusMode::infinity, 0.0};
    return settings;
}

std::filesystem::path nextName(const std::filesystem::path& folder) {
    const auto taken = [&](const std::string& stem) {
        for (const char* ending : {".png", ".exr", ".json", ".head.csv", ".gaze.csv"})
            if (std::filesystem::exists(folder / (stem + ending))) return true;
        return false;
    };
    int number = 1;
    while (taken(fmt::format("dioptre-{:04}", number))) ++number;
    return folder / fmt::format("dioptre-{:04}", number);
}

void writePicture(const std::filesystem::path& name, const Image& image, const Settings& settings) {
    writeImage(name.string() + ".png", image);
    writeImage(name.string() + ".exr", image);
    writeFileAtomically(name.string() + ".json", printSettings(settings));
}

void Recording::add(const Moment& moment) {
    // Times of a trace do not decrease.
    if (!head_.empty() && moment.time < head_.back().time) return;
    const glm::dquat toStart = glm::conjugate(start_.orientation);
    head_.push_back(
        {moment.time, {toStart * (moment.head.position - start_.position), toStart * moment.head.orientation}});
    gaze_.push_back({moment.time, moment.gaze.position, moment.gaze.valid});
}

void Recording::write(const std::filesystem::path& name, const Settings& shown) const {
    Settings settings = shown;
    settings.view.time = head_.front().time;
    settings.view.pose = numbersOf(start_);
    settings.focus.headTrace = name.string() + ".head.csv";
    settings.focus.gazeTrace = name.string() + ".gaze.csv";
    writeFileAtomically(settings.focus.headTrace, headTraceCsv(head_));
    writeFileAtomically(settings.focus.gazeTrace, gazeTraceCsv(gaze_));
    writeFileAtomically(name.string() + ".json", printSettings(settings));
}

}  // namespace dioptre
