// A sequence of frames on disk, with a page to look at it and a table of what was shown.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "frame/frame_maker.hpp"

namespace dioptre {

struct SequenceRequest {
    std::string title;  // the scene's name
    int frames = 1;
    double fps = 30.0;                                     // frame i is at start + i / fps seconds
    double budgetMs = 0.0;                                 // of a frame
    std::filesystem::path folder;                          // must be there
    double start = 0.0;                                    // seconds
    std::function<bool()> stopped = [] { return false; };  // asked before each frame
};

/// Draws frame_0000.png and on, then index.html, with a progress line; fewer frames than asked for where `stopped` said
/// so. Throws RunError; what was finished before stays.
std::vector<FrameReport> renderSequence(FrameMaker& maker, const SequenceRequest& request);

/// One line per frame: time, gaze, focus (D), pupil diameter (mm), plan, milliseconds. What `--log` writes.
std::string frameLogCsv(std::span<const FrameReport> frames);

/// The page: per frame picture, focus distance, plan and milliseconds; focus and time over the sequence as a plot.
/// Self-contained but for the pictures, which lie beside it.
std::string sequencePage(const SequenceRequest& request, std::span<const FrameReport> frames);

}  // namespace dioptre
