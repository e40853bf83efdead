// What the viewer leaves on disk: pictures with the settings that draw them again, and recordings of head and gaze.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "core/settings.hpp"
#include "focus/traces.hpp"
#include "optics/units.hpp"
#include "quality/plan.hpp"

namespace dioptre {

/// What a window shows at one moment.
struct Moment {
    double time = 0.0;  // s, of the scene
    Pose head;          // in the world
    GazeSample gaze;
    Dioptres focus;  // that was reached
    Plan plan;
};

/// Settings by which `render` draws that moment: head and focus where they are, whatever led them there, by
/// the same plan at full size.
Settings settingsOf(const Moment& moment, const Settings& shown);

/// The first of FOLDER/dioptre-0001, -0002, ... that no file there begins with.
std::filesystem::path nextName(const std::filesystem::path& folder);

/// NAME.png, NAME.exr and NAME.json.
void writePicture(const std::filesystem::path& name, const Image& image, const Settings& settings);

/// Head and gaze over a while.
class Recording {
  public:
    /// Poses are kept relative to `start`, by which a replay begins.
    explicit Recording(const Pose& start) : start_(start) {}

    void add(const Moment& moment);
    double seconds() const { return head_.empty() ? 0.0 : head_.back().time - head_.front().time; }
    bool empty() const { return head_.empty(); }

    /// Not of an empty one. NAME.head.csv, NAME.gaze.csv, and NAME.json: what was shown, with these two to be followed.
    void write(const std::filesystem::path& name, const Settings& shown) const;

  private:
    Pose start_;
    std::vector<HeadSample> head_;
    std::vector<GazeSample> gaze_;
};

}  // namespace dioptre
