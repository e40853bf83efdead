// Which points of the lens are looked up in which primary sample's picture.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "optics/lens.hpp"

namespace dioptre {

/// N (S + 1) points of the lens sequence from `first` on, of which the first N are primary samples: each of the others
/// is a sub-sample of the nearest primary. So all together they cover the lens as evenly as N (S + 1) samples do, and
/// no lookup goes farther than it must; [JKLL13] scatters S points around each primary, which overlap. A primary has S
/// on average.
struct Subsamples {
    std::vector<glm::vec2>
        offsets;             // from the primary, in units of the lens's radius; all of sample 0, of sample 1, ...
    std::vector<int> first;  // of each primary, and one more: the end
    double farthest = 0.0;   // the longest offset
};
Subsamples subsamples(int samples, int perSample, const Lens& lens, int first = 0);

}  // namespace dioptre
