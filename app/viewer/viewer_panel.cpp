// What the viewer puts into its panel, and what it makes of edits there.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/file.hpp"
#include "core/resources.hpp"
#include "core/text.hpp"
#include "viewer/sharp_range.hpp"
#include "viewer/viewer.hpp"

namespace dioptre {

namespace {

// Where a screen stands that was never measured: a desktop's, one eye's picture half of it.
constexpr double kScreenWidthMm = 300.0, kScreenDistanceMm = 650.0;

}  // namespace

/// A screen has a width and a distance: with the first of them comes the other, and they go together.
void Viewer::completeScreen(const ViewSettings& before, ViewSettings& after) {
    if (after.screenWidthMm.has_value() == after.screenDistanceMm.has_value()) return;
    const bool went = before.screenWidthMm && before.screenDistanceMm;
    if (went) {
        after.screenWidthMm.reset();
        after.screenDistanceMm.reset();
    } else {
        if (!after.screenWidthMm) after.screenWidthMm = kScreenWidthMm;
        if (!after.screenDistanceMm) after.screenDistanceMm = kScreenDistanceMm;
    }
}

void Viewer::drawPanel(Wish& wish) {
    const ValueHints known = hints();
    const std::function<void(std::string_view)> pictures = [&](std::string_view group) {
        drawInstruments(group, wish);
    };
    stages_.hide();  // unless they are drawn
    const PanelEdit edit = panel_.draw({wish.settings, known, history_.canUndo(), history_.canRedo(), settingsWait(),
                                        status(), disparityWarning(), pictures});
    if (edit.undo) act(Action::undo, wish);
    if (edit.redo) act(Action::redo, wish);
    if (!edit.load.empty()) open(edit.load, wish);
    if (edit.settings) {
        wish.settings = *edit.settings;
        wish.edit = true;
        wish.goesOn = edit.goesOn;
    }
    if (edit.save.empty()) return;
    try {
        writeFileAtomically(edit.save, printSettings(settings_));
        say("written: " + edit.save);
    } catch (const std::runtime_error& problem) {
        panel_.complain(problem.what());
    }
}

void Viewer::drawInstruments(std::string_view group, Wish& wish) {
    if (!show_ || !report_) return;
    if (group == "Eye and lens") depths_.draw(*report_, show_->maker().head());
    if (group == "Focus" && settings_.focus.focus.mode == FocusMode::gaze) instruments_.drawFocus();
    if (group == "Display") drawDisparity();
    if (group == "Budget") instruments_.drawFrameTimes();
    if (group != "Measure") return;
    if (const auto stage = stages_.draw(settings_.render.show)) {
        wish.settings.render.show = *stage;
        wish.edit = true;
    }
    ImGui::Spacing();
    if (split_.drawPanel()) stillFrames_ = 0;
    ImGui::Spacing();
    instruments_.drawStages();
}

void Viewer::drawDisparity() const {
    if (const auto most = disparity())
        ImGui::TextDisabled("disparity: %.2f\u00b0 in front, %.2f\u00b0 behind", most->x, most->y);
    else if (!settings_.view.screenDistanceMm)
        ImGui::TextDisabled("disparity: needs the screen's distance");
}

/// Of what is seen, in front of the screen and behind it, degrees; none where nobody knows where the screen is.
std::optional<glm::dvec2> Viewer::disparity() const {
    const ViewSettings& view = settings_.view;
    const bool both = view.eye == EyeChoice::both && view.display != DisplayChoice::mono;
    if (!both || !view.screenDistanceMm || !depths_.range()) return std::nullopt;
    const auto degrees = [&](double vergence) {
        const Radians angle =
            screenDisparity(Metres(view.ipdMm * 1e-3), Metres(*view.screenDistanceMm * 1e-3), Dioptres(vergence));
        return glm::degrees(angle.value);
    };
    const double front = degrees(depths_.range()->nearest), behind = -degrees(depths_.range()->farthest);
    return glm::dvec2(std::max(front, 0.0), std::max(behind, 0.0));
}

std::string Viewer::disparityWarning() const {
    const auto most = disparity();
    if (!most || std::max(most->x, most->y) <= kComfortableDegrees) return {};
    return fmt::format(
        "disparity {:.1f}\u00b0 in front of the screen, {:.1f}\u00b0 behind it: hard to fuse beyond {:g}\u00b0",
        most->x, most->y, kComfortableDegrees);
}

std::string Viewer::status() const {
    if (!show_ || !report_) return {};
    return fmt::format("{} \u00b7 {} \u00b7 {:.1f} of {:.1f} ms", show_->scene().name, planText(report_->plan),
                       report_->milliseconds, report_->budgetMs);
}

ValueHints Viewer::hints() const {
    ValueHints hints;
    hints.first = [this](const Setting& setting) -> std::string {
        if (setting.name == "aperture-mm" && report_)
            return fmt::format("{:.2f}", report_->lens.apertureDiameter.value * 1e3);
        if (setting.name == "budget-ms") return printNumber(std::round(10.0 * refreshMs_) / 10.0);
        if (setting.name == "age") return "40";
        if (setting.name == "samples") return "32";
        if (setting.name == "screen-width-mm") return printNumber(kScreenWidthMm);
        if (setting.name == "screen-distance-mm") return printNumber(kScreenDistanceMm);
        return {};
    };
    hints.standIn = [this](const Setting& setting) -> std::string {
        if (setting.name == "aperture-mm")
            return report_ ? fmt::format("auto {:.2f}", report_->lens.apertureDiameter.value * 1e3) : "auto";
        if (setting.name == "budget-ms") return fmt::format("screen's {:.1f}", refreshMs_);
        if (setting.name == "age") return "of the lens";
        if (setting.name == "samples") return "auto";
        return {};
    };
    hints.choices = [this](const Setting& setting) {
        std::vector<std::string> choices;
        if (setting.name == "lens")
            for (const auto& entry : std::filesystem::directory_iterator(resource("config/lenses")))
                choices.push_back(entry.path().stem().string());
        std::sort(choices.begin(), choices.end());
        if (setting.name == "monitor")
            for (const Monitor& monitor : window_->monitors()) choices.push_back(monitor.name);
        if (setting.name == "camera" && show_)
            for (const Camera& camera : show_->scene().cameras) choices.push_back(camera.name);
        return choices;
    };
    return hints;
}

}  // namespace dioptre
