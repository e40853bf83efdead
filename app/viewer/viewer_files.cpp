// What the viewer reads and writes: dropped files, pictures, recordings.
#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "viewer/viewer.hpp"

namespace dioptre {

bool Viewer::isSettingsFile(const std::string& file) {
    return file.ends_with(".json");
}

/// A file of settings, or else a scene.
void Viewer::open(const std::string& file, Wish& wish) {
    if (!isSettingsFile(file)) {
        Command command = command_;
        command.settings = settings_;
        command.scene = file;
        error_.clear();
        loader_.load(command);
        return;
    }
    try {
        loadSettings(file, wish.settings);
        wish.edit = true;
        say("settings: " + file);
    } catch (const InputError& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
}

Moment Viewer::moment() const {
    return {report_->time, show_->maker().head().pose, report_->gaze, report_->lens.lens.focus, report_->plan};
}

/// From the next frame on the moment is drawn as `render` would, until nothing is missing of it.
void Viewer::beginPicture() {
    if (!show_ || !report_) return;
    if (wanted_) {  // nobody waits for it any longer
        wanted_.reset();
        show_->change(settings_);
        stillFrames_ = 0;
        return;
    }
    WantedPicture picture{nextName("."), settingsOf(moment(), settings_)};
    show_->change(picture.settings);
    wanted_ = std::move(picture);
    ImGui::SetWindowFocus(nullptr);  // what is being typed would not be taken
}

void Viewer::drawPictureToBeWritten() {
    FrameMaker::Input input;
    input.time = wanted_->settings.view.time;
    input.budgetMilliseconds = kRefineMilliseconds;
    input.refines = true;
    report_ = &show_->maker().make(input);
    pictureMade_ = true;
    const bool coarse = show_->makesLevels() && show_->maker().mayUseLevels();
    if (coarse || show_->maker().progress() < 1.0) return;
    const WantedPicture done = std::move(*wanted_);
    wanted_.reset();
    try {
        writePicture(done.name, show_->maker().composed(), done.settings);
        say(fmt::format(
            "written: {0}.png, .exr; dioptre render {1} --config {0}.json --out {0}-again.png draws it again",
            done.name.lexically_normal().string(), command_.scene));
    } catch (const std::runtime_error& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
    show_->change(settings_);
    stillFrames_ = 0;
}

void Viewer::toggleRecording() {
    if (!show_ || !report_) return;
    if (recording_)
        finishRecording();
    else
        recording_.emplace(show_->maker().startingView().pose);
    stillFrames_ = 0;
}

void Viewer::finishRecording() {
    if (!recording_) return;
    const Recording recording = std::move(*recording_);
    recording_.reset();
    if (recording.empty()) return;
    try {
        const auto name = nextName(".").lexically_normal();
        recording.write(name, settings_);
        say(fmt::format("written: {0}.head.csv, .gaze.csv; --config {0}.json follows them for {1:.1f} s", name.string(),
                        recording.seconds()));
    } catch (const std::runtime_error& problem) {
        error_ = problem.what();
        logError(problem.what());
    }
}

}  // namespace dioptre
