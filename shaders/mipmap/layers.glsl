// How a pixel is shared out between the layers (mipmap.hpp). c is the signed CoC radius in pixels, > 0 behind focus.
#include "shared/mipmap.h"
uniform vec2 coc;           // c = x * depth + y (optics/lens.hpp)
uniform float baseLargest;  // largest |c| that the base layer may hold, px

float cocRadius(float depth) { return coc.x * depth + coc.y; }
