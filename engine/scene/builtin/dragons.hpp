// The dragons: a body swept along a curve from the tail's tip to the neck, a head, and what grows from them.
#pragma once

#include "scene/builtin/paints.hpp"

namespace dioptre::builtin {

/// Colours of one dragon, linear.
struct Hide {
    vec3 back, flank, belly, edge;  // edge: between scales
    vec3 horn, membrane, eye;       // eye: radiance
    float roughness = 0.35f, metallic = 0.2f;
};

struct Dragon {
    std::string name;
    std::vector<vec3> path;        // tail to the back of the head, metres; about 1.4 high, on y = 0
    float girth = 0.1f;            // largest radius, metres
    vec3 gaze{0.0f, -0.1f, 1.0f};  // the way the head faces
    float headSize = 0.3f;         // metres from the neck to the snout
    int scales = 40;               // around the body
    float wings = 0.0f;            // span of one wing, metres; 0: none
    float wingsAt = 0.7f;          // way along the path
    std::vector<float> legs;       // ways along the path
    int spines = 56;
    float hornCurl = 1.0f;
    bool whiskers = false;
    Hide hide;
    float fineness = 1.0f;  // times the detail of the scene
};
std::vector<Dragon> allDragons();

/// What a picture and the relief share: the height of overlapping scales at `m` (0 the back, 1 the belly) and `row`, in
/// [0, 1]; then the number of the scale, and the distance from its edge in [0, 1].
struct ScalePlace {
    float height, id, edge;
};
ScalePlace scaleAt(float m, float row, int around, int rowPeriod);
inline constexpr int kScaleRows = 16;  // in one repeat of the picture

/// A tube with scales: its stations, radii and the rows of scales so far.
struct ScaledTube {
    std::vector<Station> stations;
    std::vector<float> radius, row;
    int scales = 40;
};
ScaledTube scaledTube(const std::vector<vec3>& path, const std::function<float(float)>& radius, int scales, int steps);
Shape shapeOf(const Detail& detail, const ScaledTube& tube, int around);

float bodyRadius(const Dragon& dragon, float t);

// dragons_head.cpp, in the head's frame: from the neck at the origin along +z, 1 long.
Shape headShape(const Detail& detail);
Shape hornsShape(const Detail& detail, float curl);
Shape teethShape(const Detail& detail);
Shape tongueShape(const Detail& detail);
Shape eyesShape(const Detail& detail);
Shape pupilsShape(const Detail& detail);
Shape whiskersShape(const Detail& detail);

// dragons_limbs.cpp, in the dragon's frame
Shape spinesShape(const Detail& detail, const ScaledTube& body, const Dragon& dragon);
Shape membraneShape(const Detail& detail, const Station& shoulder, float radius, float span);
Shape wingBonesShape(const Detail& detail, const Station& shoulder, float radius, float span);
Shape legShape(const Detail& detail, const Station& hip, float radius, float side, float ground);
Shape clawsShape(const Detail& detail, const Station& hip, float radius, float side, float ground);
Shape tailFinShape(const Detail& detail, const ScaledTube& body, float size);

int addDragon(Model& model, const Dragon& dragon);

}  // namespace dioptre::builtin
