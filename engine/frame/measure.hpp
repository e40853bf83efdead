// The speed-accuracy trade: every technique with every setting of its dials, on scenes, blurs and sizes, against the
// reference. What is written: engine/frame/measure_rows.hpp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/log.hpp"
#include "core/settings.hpp"
#include "frame/measure_pictures.hpp"
#include "frame/measure_rows.hpp"
#include "render/technique.hpp"
#include "scene/scene.hpp"

namespace dioptre {

struct MeasureRequest {
    std::filesystem::path folder;  // made if missing
    std::vector<PictureSize> sizes{{640, 480}};
    int samplesPerHalf = 256;         // of the reference; it is the mean of two halves
    double rowMilliseconds = 6000.0;  // fewer than nine frames, not fewer than two, where nine take longer
    double exposureEv = 0.0;
    ViewSettings view;            // camera, pose
    bool resume = false;          // keep the rows that are in the folder
    std::size_t scenes = 1;       // that will come
    std::filesystem::path cache;  // references are kept here; empty: nowhere
    std::filesystem::path lods;   // levels of detail are; empty: nowhere
    std::string program, commit, context;
    std::function<bool()> stopped = [] { return false; };  // asked often; once true, always true
};

/// A run, one scene at a time. Needs a current context. Files are whole after every row:
/// trade.csv, trade.json, pictures/; finish() writes trade-<renderer>.json and index.html.
class Measuring {
  public:
    /// InputError: --resume where the folder holds what another build, machine or other settings measured.
    explicit Measuring(MeasureRequest request);

    /// Measures what is not there yet. False where it was stopped; what was finished is kept.
    bool add(const std::string& name, const Scene& scene);

    /// Writes what is there, the page included.
    void finish();

    const Measurements& measurements() const { return all_; }
    std::size_t rowsWanted() const { return rowsWanted_; }
    std::size_t rowsAdded() const { return rowsAdded_; }

  private:
    struct Subject;

    bool measureView(const Subject& subject, MeasuredView view);
    bool measureRow(const Subject& subject, const MeasuredView& view, std::size_t planIndex);
    void keep(const MeasuredView& view);
    void writeTables() const;
    void progressed(double work, const std::string& doing);

    MeasureRequest request_;
    Measurements all_;
    PictureFolder pictures_;
    std::vector<Plan> plans_;
    std::vector<double> work_;  // of each plan, in drawings of the scene
    std::size_t rowsWanted_ = 0, rowsDone_ = 0, rowsAdded_ = 0;
    double workDone_ = 0.0, workSkipped_ = 0.0, workTotal_ = 0.0;  // drawings × pixels
    double start_ = 0.0;                                           // milliseconds
    std::optional<ProgressLine> progress_;
};

/// What this process runs on, for MeasuredWith: cpu, cores, memory, system, date; the GL's names.
MeasuredWith measuredHere();

}  // namespace dioptre
