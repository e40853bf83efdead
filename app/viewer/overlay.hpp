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

/// Text on the picture, on a dark ground; `align` 0: right of x, 1: left of it, 0.5: around it.
struct Label {
    float x = 0.0f, y = 0.0f, align = 0.0f;
};
void drawLabel(const Label& label, const std::string& text);

/// One line in the lower right corner.
void drawNotice(const std::string& text);

/// What went wrong, until somebody has read it; false once they have.
bool drawError(const std::string& text);

}  // namespace dioptre
