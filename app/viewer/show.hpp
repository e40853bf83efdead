// A scene, and what draws it in a window.
#pragma once

#include <memory>

#include "frame/frame_maker.hpp"
#include "scene/lod.hpp"

namespace dioptre {

class Show {
  public:
    /// Uploads the scene. InputError, RunError: see FrameMaker.
    Show(Scene&& shown, const Settings& settings);

    /// InputError changes nothing.
    void change(const Settings& settings);

    /// Takes over levels of detail that became ready, made in the background while finer ones are drawn; whether there
    /// were any.
    bool takeLevels();
    bool makesLevels() const { return levels_ != nullptr; }
    double levelsProgress() const { return levels_ ? levels_->progress() : 1.0; }

    const Scene& scene() const { return scene_; }
    FrameMaker& maker() { return maker_; }
    const FrameMaker& maker() const { return maker_; }

  private:
    void wantLevels();

    // Keeps its vertices until its levels of detail are made, which a technique may ask for at any time.
    Scene scene_;
    FrameMaker maker_;
    std::unique_ptr<LodBuilder> levels_;
    bool haveLevels_ = false;
};

}  // namespace dioptre
