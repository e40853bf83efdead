// A headless run against a frame budget: plays the traces, times every frame, compares some with the reference.
#pragma once

#include <filesystem>
#include <functional>

#include "frame/budget_rows.hpp"
#include "frame/frame_maker.hpp"

namespace dioptre {

/// Fills run.frames, up to run.framesWanted of them at run.budgetMs and run.hz, with a progress line; fewer where
/// `stopped` (asked before each frame) said so. Frame i is that of the moment start + i / run.hz seconds. A frame that
/// is compared is read back and drawn again as the reference between two frames, untimed. Throws RunError; the frames
/// before stay.
void playBudget(FrameMaker& maker, double start, const std::function<bool()>& stopped, BudgetRun& run);

/// frames.csv, budget.json and index.html in a folder that is there, each whole or not at all. Throws RunError.
void writeBudget(const BudgetRun& run, const std::filesystem::path& folder);

}  // namespace dioptre
