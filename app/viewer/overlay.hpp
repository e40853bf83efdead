// What lies over the picture for a while: the list of keys, progress, messages.
#pragma once

#include <string>

namespace dioptre {

/// F1's list; false once it was closed.
bool drawKeyList();

/// A bar at the bottom: what, and the share 0..1 that is done.
struct Progress {
    std::string what;
    double share = 0.0;
};
void drawProgress(const Progress& progress, int place);  // place: 0 the lowest, 1 above it

/// One line in the lower left corner.
void drawNotice(const std::string& text);

/// What went wrong, until somebody has read it; false once they have.
bool drawError(const std::string& text);

}  // namespace dioptre
