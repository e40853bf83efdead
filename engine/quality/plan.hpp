// A plan: a technique and the values of its dials. Both eyes of a frame follow the same one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/settings.hpp"

namespace dioptre {

/// All there are, in the order of their values. New techniques join here and in the lists of plan.cpp and
/// render/technique.cpp.
inline constexpr TechniqueChoice kTechniques[] = {TechniqueChoice::pinhole, TechniqueChoice::mipmap,
                                                  TechniqueChoice::accumulate, TechniqueChoice::reference};

/// A dial that the technique does not have is empty.
struct Plan {
    TechniqueChoice technique = TechniqueChoice::pinhole;
    std::optional<int> msaa;        // samples per pixel, 0 or 4
    std::optional<int> samples;     // points of the lens, >= 1
    std::optional<int> subsamples;  // more points of the lens for each of them, on average; 0..16
    int eighths = 8;                // 2..8: width and height of what is drawn, in eighths of the picture's

    bool operator==(const Plan&) const = default;

    /// Those it has, {"msaa", 4}.
    std::vector<std::pair<std::string_view, int>> dials() const;
};

/// "mipmap"
std::string_view techniqueName(TechniqueChoice choice);
std::optional<TechniqueChoice> techniqueNamed(std::string_view name);

/// Points of the lens that a technique averages where nobody says how many.
int defaultSamples(TechniqueChoice choice);
/// As many samples as last time, but for what those took more or less than the budget; 1..most.
int samplesInTime(int before, double tookMs, double budgetMs, int most);
/// Whether antialiasing by msaa is its own choice.
bool usesMsaa(TechniqueChoice choice);
/// Whether it averages pictures through points of the lens, as many as the dial `samples` says.
bool usesSamples(TechniqueChoice choice);
/// What levels of detail may be off where no blur hides it, pixels of the picture as it is drawn; 0: level 0. Below half
/// the size a picture is one that has to be cheap, and most of its triangles are smaller than its pixels; at larger ones
/// levels lose more than they save (docs/measured.md).
double detailPx(const Plan& plan);
/// Whether it draws levels of detail.
bool usesLevels(const Plan& plan);

inline constexpr int kLeastEighths = 2;
/// Fewer pixels in steps of a half or so: each change of size is seen.
inline constexpr int kSmallerEighths[] = {kLeastEighths, 3, 4, 6};
/// Whether a plan may be drawn smaller: only without msaa, whose samples are worth more than as many pixels.
bool maySize(const Plan& plan);

/// The plan that settings name; none where they leave it to the governor. A stage to be shown is of the technique that
/// has it.
std::optional<Plan> planOf(const RenderSettings& settings);

/// "mipmap, msaa 4"; "accumulate, 32 samples, 4 sub-samples each"; "pinhole, msaa 0, 6/8 size"
std::string planText(const Plan& plan);

/// The plan without its number of samples. Changes within a method are small steps (a prefix of one sequence of
/// samples), changes of the method are seen.
Plan methodOf(Plan plan);

}  // namespace dioptre
