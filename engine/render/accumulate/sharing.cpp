#include "render/accumulate/sharing.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace dioptre {

namespace {

struct Cell {
    std::size_t samples = 0, seen = 0;
    std::vector<int> parents;  // -1: no sample needed it yet
};

}  // namespace

SharedRenderings shareRenderings(std::span<const LensSample> samples, double cocRadius, int grid) {
    std::map<std::pair<double, double>, Cell> cells;
    const auto cellOf = [&](const LensSample& sample) -> Cell& {
        const glm::dvec2 middle = glm::round(sample.lens * (cocRadius * grid));
        return cells[{middle.x, middle.y}];
    };
    for (const LensSample& sample : samples) ++cellOf(sample).samples;
    const std::size_t most = (samples.size() + kLeastJitters - 1) / kLeastJitters;
    for (auto& [middle, cell] : cells) cell.parents.assign((cell.samples + most - 1) / most, -1);

    // The samples of a cell take its parents in turn.
    SharedRenderings shared;
    std::vector<double> children;
    for (const LensSample& sample : samples) {
        Cell& cell = cellOf(sample);
        int& parent = cell.parents[cell.seen++ % cell.parents.size()];
        if (parent < 0) {
            parent = static_cast<int>(shared.parents.size());
            shared.parents.emplace_back();
            children.push_back(0.0);
        }
        const auto i = static_cast<std::size_t>(parent);
        shared.parents[i].lens += sample.lens;
        children[i] += 1.0;
        shared.parentOf.push_back(parent);
    }
    for (std::size_t i = 0; i < children.size(); ++i) shared.parents[i].lens /= children[i];
    // The first jitters of the sequence cover the pixel evenly, however few there are.
    for (std::size_t i = 0; i < shared.parents.size(); ++i) shared.parents[i].pixel = samples[i].pixel;
    return shared;
}

}  // namespace dioptre
