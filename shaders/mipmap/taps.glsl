// A disc of radius 1 as sixteen taps of equal weight: the centre, five on a circle of 0.47 and ten on one of 0.84.
const int kTaps = 16;
const vec2 kDisc[kTaps] =
    vec2[](vec2(0.0, 0.0), vec2(0.47, 0.0), vec2(0.1452, 0.447), vec2(-0.3802, 0.2763), vec2(-0.3802, -0.2763),
           vec2(0.1452, -0.447), vec2(0.7988, 0.2596), vec2(0.4937, 0.6795), vec2(0.0, 0.84), vec2(-0.4937, 0.6795),
           vec2(-0.7988, 0.2596), vec2(-0.7988, -0.2596), vec2(-0.4937, -0.6795), vec2(0.0, -0.84),
           vec2(0.4937, -0.6795), vec2(0.7988, -0.2596));
