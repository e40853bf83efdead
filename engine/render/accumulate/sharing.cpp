#include "render/accumulate/sharing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dioptre {

namespace {

struct Cell {
    std::vector<int> samples;
    int parents = 1;
};

}  // namespace

SharedRenderings shareRenderings(std::span<const LensSample> samples, double cocRadius, int grid) {
    const double scale = cocRadius * grid;
    std::map<std::pair<double, double>, Cell> cells;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::dvec2 middle = glm::round(samples[i].lens * scale);
        cells[{middle.x, middle.y}].samples.push_back(static_cast<int>(i));
    }
    const std::size_t most = (samples.size() + kLeastJitters - 1) / kLeastJitters;
    for (auto& [middle, cell] : cells) cell.parents = static_cast<int>((cell.samples.size() + most - 1) / most);

    SharedRenderings shared;
    shared.parentOf.resize(samples.size());
    for (const auto& [middle, cell] : cells) {
        for (int part = 0; part < cell.parents; ++part) {
            glm::dvec2 sum(0.0);
            int children = 0;
            for (auto i = static_cast<std::size_t>(part); i < cell.samples.size();
                 i += static_cast<std::size_t>(cell.parents), ++children) {
                const auto sample = static_cast<std::size_t>(cell.samples[i]);
                shared.parentOf[sample] = static_cast<int>(shared.parents.size());
                sum += samples[sample].lens;
            }
            shared.parents.push_back({sum / static_cast<double>(children), {}});
        }
    }
    // The first jitters of the sequence cover the pixel evenly, however few there are.
    for (std::size_t i = 0; i < shared.parents.size(); ++i) shared.parents[i].pixel = samples[i].pixel;
    return shared;
}

}  // namespace dioptre
