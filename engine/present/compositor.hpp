// From the eyes' linear pictures to what a display shows.
#pragma once

#include <map>
#include <tuple>

#include "core/settings.hpp"
#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "gl/program.hpp"

namespace dioptre {

/// Size of the composed picture from ONE eye's: twice as wide for sideBySide, twice as high for topBottom.
PictureSize composedSize(DisplayChoice display, PictureSize eye);

struct Placement {
    int x = 0, y = 0, width = 1, height = 1;  // pixels
};
/// Where a picture lies in a window: as large as fits, in the middle, not stretched.
Placement fitted(PictureSize picture, PictureSize window);

struct Composition {
    const Texture& left;   // the only picture for DisplayChoice::mono
    const Texture& right;  // same size
    PictureSize eye;       // as each is shown: theirs, or more pixels
    DisplayChoice display = DisplayChoice::mono;
    bool swapEyes = false;
    ToneMapChoice tonemap = ToneMapChoice::none;
};

class Compositor {
  public:
    /// Linear, RGBA32F, composedSize; valid until the next call.
    const Texture& compose(const Composition& composition, PassLog& log);
    /// The last composition, sRGB-encoded, fitted into that part (y upwards) of the window's framebuffer (0), black
    /// around it.
    void present(const Placement& area, PassLog& log);

  private:
    const FullscreenPass& passFor(const Composition& composition, bool encode);
    void draw(const Composition& composition, const Placement& place, bool encode);

    // By display, tone map, whether encoded, whether of smaller pictures
    std::map<std::tuple<DisplayChoice, ToneMapChoice, bool, bool>, FullscreenPass> passes_;
    Texture output_;
    Framebuffer target_;
};

}  // namespace dioptre
