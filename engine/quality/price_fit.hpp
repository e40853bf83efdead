// The work of a plan, stage by stage, and what a unit of it costs, fitted to a measured table.
#pragma once

#include <array>

#include "quality/plan.hpp"
#include "quality/trade_table.hpp"
#include "quality/view_class.hpp"

namespace dioptre {

inline constexpr std::size_t kStages = 4;

/// How much of each stage a frame has, all eyes together: triangles (of the levels of detail that it draws) × samples of the lens; pixels × samples of lens and
/// msaa; fetches of full-screen passes; passes. Affine in the number of samples.
using Work = std::array<double, kStages>;
Work workOf(const Plan& plan, const ViewClass& view);

/// Milliseconds per unit of each stage, >= 0, one at least > 0.
using Coefficients = std::array<double, kStages>;

/// Least squares of relative errors over all entries of the table, none negative.
Coefficients fitPrices(const TradeTable& table);

/// Of one frame.
double priceOf(const Coefficients& coefficients, const Work& work);

}  // namespace dioptre
