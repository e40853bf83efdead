// What `dioptre measure` writes down, and the arithmetic on it. No GL.
//
// trade.json, schema 1. All keys are always there; null is an infinite number, or one that was not counted.
//   schema, program, commit, renderer, version, context, cpu, cores, memory_bytes, system, date: to repeat it
//   load          of the machine when it began, as processes wanting to run; more than `cores` makes times too long
//   settings      samples_per_half, row_ms, exposure_ev, sizes
//                 blurs {name: mean CoC DIAMETER, px at 640 px width}
//   views[]       what the rows of one picture share
//     key         "studio-640x480-paper-near"; rows name it
//     scene, content (hash of its data), triangles (of all of it), width, height, blur, focus
//     aperture_mm (DIAMETER), focus_D
//     mean_coc_px, nearest_coc_px, farthest_coc_px: DIAMETERS of the circles of confusion, > 0 behind focus, < 0 in
//                 front of it; the mean without sign
//     nearest_D, farthest_D of the visible pixels
//     reference   samples (both halves), psnr_db, ssim, flip (one half against the other: its noise), ms (of drawing
//                 both; 0 where they came from the cache)
//   rows[]        one technique with one setting of its dials
//     view, technique, dials {"msaa": 4}
//     ms_median, ms_p10, ms_p90, frames: finished frames, warm, by a monotonic clock
//     stages[]    name, ms (median of the sum in a frame), runs; in frames of their own, which wait between stages and
//                 so are slower
//     skipped[]   name, why: what this view did not require
//     psnr_db, ssim, flip against the reference
//     triangles (drawn, times samples), fetches_per_px (Technique::fetchesPerPixel)
//     technique_bytes (textures), process_peak_bytes (resident, during this row)
//     pareto      no other row of the view is both faster and closer by SSIM
// trade.csv has a line per row, the view's columns first; stages and skipped are "name=ms;..." and "name: why;...".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/metrics.hpp"

namespace dioptre {

/// One picture to be drawn: all that its rows share.
struct MeasuredView {
    std::string key;
    std::string scene, content;
    std::uint64_t triangles = 0;
    int width = 0, height = 0;
    std::string blur, focus;  // "small", "paper", "strong"; "near", "far"
    double apertureMm = 0.0;  // DIAMETER
    double focusD = 0.0;
    double meanCocPx = 0.0, nearestCocPx = 0.0, farthestCocPx = 0.0;  // DIAMETERS, > 0 behind focus; mean without sign
    double nearestD = 0.0, farthestD = 0.0;
    int referenceSamples = 0;
    double referenceMs = 0.0;
    Comparison noise;

    /// Rows of the one are rows of the other: same scene, lens and reference.
    bool sameAs(const MeasuredView& other) const;
};

struct MeasuredStage {
    std::string name;
    double milliseconds = 0.0;
    int runs = 0;  // in one frame
};

struct SkippedStage {
    std::string name, why;
};

/// Median and spread of finished frames, milliseconds.
struct Timing {
    double median = 0.0, p10 = 0.0, p90 = 0.0;
    int frames = 0;
};

struct MeasuredRow {
    std::string view;  // MeasuredView::key
    std::string technique;
    std::map<std::string, int> dials;
    Timing time;
    std::vector<MeasuredStage> stages;
    std::vector<SkippedStage> skipped;
    Comparison error;
    std::uint64_t triangles = 0;
    std::optional<double> fetchesPerPixel;
    std::uint64_t techniqueBytes = 0, processPeakBytes = 0;
    bool pareto = false;

    /// "mipmap-msaa4": unique within a view, fit for a file's name.
    std::string key() const;
    /// "msaa 4"; empty without dials.
    std::string dialsText() const;
};

/// Everything to repeat a run.
struct MeasuredWith {
    std::string program, commit;
    std::string renderer, version, context;
    std::string cpu, system, date;
    int cores = 0;
    std::uint64_t memoryBytes = 0;
    double load = 0.0;
    int samplesPerHalf = 256;
    double rowMs = 6000.0;  // fewer than nine frames, not fewer than two, where nine take longer
    double exposureEv = 0.0;
    std::vector<std::string> sizes;
    std::map<std::string, double> blurs;

    /// Rows measured under equal conditions: date and load are left out.
    bool comparable(const MeasuredWith& other) const;
};

struct Measurements {
    MeasuredWith with;
    std::vector<MeasuredView> views;
    std::vector<MeasuredRow> rows;

    const MeasuredView* view(std::string_view key) const;
    const MeasuredRow* row(std::string_view viewKey, std::string_view rowKey) const;
    /// Sets every row's `pareto`.
    void markPareto();
};

std::string measurementsJson(const Measurements& all);
/// Reads back what measurementsJson wrote. InputError naming `where`: broken JSON, a missing key, another schema.
Measurements parseMeasurements(std::string_view json, std::string_view where);

std::string measurementsCsv(const Measurements& all);

/// The table for the governor, config/trade/<renderer>.json, which engine/quality/trade_table.hpp reads, schema 2:
///   schema, renderer, version, commit, cpu, date
///   views[]   key, triangles (that a pinhole draws), width, height, mean_coc_px, nearest_coc_px, farthest_coc_px (as
///             in trade.json), behind_share (of the visible pixels: what lies behind focus)
///   plans[]   technique, dials, ms, ms_over_pinhole (to the cheapest pinhole of the same view), psnr_db, ssim, flip:
///             means over everything; entries[] the same for each view, by its key
///             psnr_db: equal pictures count as 100
///   front[]   indices into plans, cheapest first: each is closer to the reference, by SSIM, than all before it
std::string governorTable(const Measurements& all);

/// Indices of the points that no other beats in both, by rising cost and falling error. Of equal points the first.
/// Points that are not finite are left out.
struct TradePoint {
    double cost = 0.0, error = 0.0;
};
std::vector<std::size_t> paretoFront(std::span<const TradePoint> points);

/// Linear between the sorted values; share in 0..1. 0 of no values.
double percentile(std::vector<double> values, double share);

/// Median, 10 % and 90 %.
Timing timingOf(const std::vector<double>& milliseconds);

/// "llvmpipe" of "llvmpipe (LLVM 15.0.6, 256 bits)": fit for a file's name.
std::string rendererFileName(std::string_view renderer);

/// "40 s", "12 min", "1 h 5 min".
std::string durationText(double seconds);

}  // namespace dioptre
