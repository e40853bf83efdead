#include "quality/price_fit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dioptre {

namespace {

/// Of the full-screen passes, for each pixel. What mipmap reads, with a foreground: Mipmap::fetchesPerPixel.
double fetchesOf(const Plan& plan) {
    const double samples = plan.samples.value_or(1);
    switch (plan.technique) {
        case TechniqueChoice::pinhole:
            return 2.0 * plan.msaa.value_or(0);
        case TechniqueChoice::mipmap:
            return 22.0 + 2.0 * plan.msaa.value_or(0);
        case TechniqueChoice::accumulate:
            // Sub-samples are searched along a line: bounds, then a few fetches for each. Their footprints are smoothed.
            if (plan.subsamples.value_or(0) > 0) return 20.0 + samples * (4.0 + 2.0 * *plan.subsamples);
            return 1.0 + samples;
        case TechniqueChoice::reference:
            return 1.0 + samples;
    }
    return 0.0;
}

/// About as many as the techniques' pass logs name; the fit finds what one takes.
double passesOf(const Plan& plan) {
    const double samples = plan.samples.value_or(1);
    switch (plan.technique) {
        case TechniqueChoice::pinhole:
            return 2.0;
        case TechniqueChoice::mipmap:
            return 14.0;
        case TechniqueChoice::accumulate:
            return 2.0 + 2.0 * samples;
        case TechniqueChoice::reference:
            return 2.0 + 0.5 * samples;
    }
    return 0.0;
}

using Rows = std::vector<Work>;  // each divided by its milliseconds: the fit is to 1

/// Normal equations over the stages of `set` (a bit each), by elimination. None where they do not determine it.
std::optional<Coefficients> solve(const Rows& rows, unsigned set) {
    double a[kStages][kStages + 1] = {};
    for (std::size_t i = 0; i < kStages; ++i) {
        if (!(set >> i & 1u)) {
            a[i][i] = 1.0;
            continue;
        }
        for (const Work& row : rows) {
            for (std::size_t j = 0; j < kStages; ++j)
                if (set >> j & 1u) a[i][j] += row[i] * row[j];
            a[i][kStages] += row[i];
        }
    }
    for (std::size_t i = 0; i < kStages; ++i) {
        constexpr double kSingular = 1e-9;
        if (!(a[i][i] > kSingular)) return std::nullopt;
        for (std::size_t k = 0; k < kStages; ++k) {
            if (k == i) continue;
            const double factor = a[k][i] / a[i][i];
            for (std::size_t j = i; j <= kStages; ++j) a[k][j] -= factor * a[i][j];
        }
    }
    Coefficients c{};
    for (std::size_t i = 0; i < kStages; ++i) c[i] = a[i][kStages] / a[i][i];
    return c;
}

double squares(const Rows& rows, const Coefficients& c) {
    double sum = 0.0;
    for (const Work& row : rows) {
        const double difference = priceOf(c, row) - 1.0;
        sum += difference * difference;
    }
    return sum;
}

}  // namespace

Work workOf(const Plan& plan, const ViewClass& view) {
    const double eyes = std::max(view.eyes, 1);
    const double scale = plan.eighths / 8.0;
    const double pixels = std::max(view.pixels, 1.0) * scale * scale;
    const double samples = plan.samples.value_or(1);
    std::optional<double> leveled;
    if (detailPx(plan) > 0.0) leveled = view.leveled.at(static_cast<std::size_t>(plan.eighths - kLeastEighths));
    return {eyes * std::max(leveled.value_or(view.triangles), 0.0) * samples,
            eyes * pixels * samples * std::max(plan.msaa.value_or(0), 1), eyes * pixels * fetchesOf(plan),
            eyes * passesOf(plan)};
}

double priceOf(const Coefficients& coefficients, const Work& work) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kStages; ++k) sum += coefficients[k] * work[k];
    return sum;
}

// With four stages the active set of a least-squares fit without negative parts (Lawson, Hanson 1974) is found by
// trying all fifteen.
Coefficients fitPrices(const TradeTable& table) {
    Rows rows;
    Work largest{};
    for (const TradeTable::Row& row : table.rows)
        for (const TradeTable::Entry& entry : row.entries) {
            Work work = workOf(row.plan, table.views[entry.view]);
            for (std::size_t k = 0; k < kStages; ++k) {
                work[k] /= entry.milliseconds;
                largest[k] = std::max(largest[k], work[k]);
            }
            rows.push_back(work);
        }
    for (Work& row : rows)
        for (std::size_t k = 0; k < kStages; ++k) row[k] /= std::max(largest[k], 1e-300);
    Coefficients best{};
    double least = std::numeric_limits<double>::infinity();
    for (unsigned set = 1; set < 1u << kStages; ++set) {
        const auto c = solve(rows, set);
        if (!c || *std::min_element(c->begin(), c->end()) < 0.0) continue;
        // Of equal fits the one with fewer stages
        const double error = squares(rows, *c) * (1.0 + 1e-9 * std::popcount(set));
        if (error < least) std::tie(best, least) = std::pair(*c, error);
    }
    for (std::size_t k = 0; k < kStages; ++k) best[k] /= std::max(largest[k], 1e-300);
    return best;
}

}  // namespace dioptre
