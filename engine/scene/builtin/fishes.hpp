// The fishes and what grows around them.
#pragma once

#include <array>

#include "scene/builtin/paints.hpp"

namespace dioptre::builtin {

/// One kind of fish, its length 1 from the snout (x = 0.5) to the tail's root (x = -0.36) and fin (x = -0.5). Outlines
/// are heights above and below the axis and half widths at even steps from snout to tail root.
struct Species {
    std::string name;
    std::vector<float> above, below, width;
    float eye = 0.0f;        // way along at which it sits
    float eyeRadius = 0.0f;  // of the length
    float dorsalFrom = 0.3f, dorsalTo = 0.9f, dorsalHeight = 0.1f, dorsalLean = 0.3f;
    float analFrom = 0.6f, analTo = 0.9f, analHeight = 0.08f;
    float tailSpan = 0.16f, tailFork = 0.4f;  // half its height; how deep its notch is, 0 round, 1 to the root
    float pectoral = 0.14f;                   // length
    float trail = 0.0f;                       // the dorsal fin's first ray drawn out
    Paint skin;                               // u 0 at the back, 1 at the belly; v from snout to tail root
    Paint finColor;                           // u from root to rim; v along
    float roughness = 0.3f, metallic = 0.1f, scales = 40.0f;
};
std::vector<Species> allSpecies();

/// How it holds itself: the tail's sideways swing and where in its beat.
struct Pose {
    float swing, phase;
};
/// `haze` in [0, 1]: how much water there is before it.
int addFish(Model& model, const Species& species, const Pose& pose, int skin, int fins, float haze);

// Around them: fishes_reef.cpp. Each standing on y = 0, about a metre.
int addBranchCoral(Model& model, const vec3& color, std::uint32_t seed);
int addBrainCoral(Model& model, const vec3& color);
int addFanCoral(Model& model, const vec3& color, std::uint32_t seed);
int addTubeSponge(Model& model, const vec3& color, std::uint32_t seed);
int addKelp(Model& model, std::uint32_t seed);
int addAnemone(Model& model, const vec3& color, std::uint32_t seed);
int addBoulder(Model& model, std::uint32_t seed);
int addStarfish(Model& model, const vec3& color);
int addBubbles(Model& model, std::uint32_t seed);

}  // namespace dioptre::builtin
