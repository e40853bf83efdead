// The scene before it is glTF: objects made of rectangular patches, each with its paint, and the lights.
// A patch is a grid of vertices over the unit square (u right, v down, as in its picture), so every patch is one
// rectangular chart of its object's texture and baked light is a plain grid over the same square.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common.hpp"

namespace studio {

/// Where a paint is asked for a colour.
struct SurfacePoint {
    vec2 unit;               // in the patch's unit square, u right, v down
    vec2 metres;             // the same, in metres from the patch's top left corner
    vec2 size;               // the patch, metres
    vec3 position;           // world, metres
    vec3 normal;             // world, unit
    std::uint32_t seed = 0;  // the patch's own
};

/// What a paint answers. `height` becomes the normal map of lit objects.
struct Coat {
    vec3 albedo{0.5f};  // linear; of painted objects: the radiance itself
    float roughness = 0.6f;
    float metallic = 0.0f;
    float height = 0.0f;  // metres above the geometry
    float alpha = 1.0f;
    vec3 glow{0.0f};  // emitted radiance over the object's emissive strength
};

using Paint = std::function<Coat(const SurfacePoint&)>;

struct Patch {
    int columns = 2, rows = 2;           // vertices across (u) and down (v)
    std::vector<vec3> position, normal;  // columns * rows, row by row; world metres once placed
    vec2 size{1.0f};                     // metres, mean extent along u and v
    std::vector<float> across, down;     // the columns' u and the rows' v, 0 to 1
    Paint paint;
    std::uint32_t seed = 0;
    float detail = 1.0f;   // texels per metre relative to the object's other patches
    int sharedChart = -1;  // patch index whose chart this one shows too, -1: a chart of its own
    // Filled by packCharts: the chart's texel rectangle.
    int chartX = 0, chartY = 0, chartWidth = 0, chartHeight = 0;
};

using Patches = std::vector<Patch>;

enum class Finish {
    baked,    // unlit: albedo times baked light
    lit,      // metallic-roughness, shaded by the viewer; what the lights cannot do is baked into emissive
    painted,  // unlit: the paint is the radiance (the world outside)
    masked,   // as painted, with alpha MASK
    glowing,  // emissive only, no texture
    shining,  // emissive only, with the paint's glow as texture
};

/// A mirror-like share of light, baked as seen from the main camera; 0: none.
struct Gloss {
    vec3 reflectance{0.0f};  // at normal incidence
    float roughness = 0.3f;  // GGX alpha
};

struct Object {
    std::string name;
    Finish finish = Finish::baked;
    int textureWidth = 256, textureHeight = 256;
    float lightStep = 4.0f;   // texels between baked light samples
    bool thin = false;        // two-sided and translucent: leaves, curtains, shades
    bool castsShadow = true;  // false for lamps' own bodies: their light is sampled from inside
    bool normalMap = false;
    Gloss gloss;
    vec3 emissive{0.0f};  // glowing: colour, at most 1
    float emissiveStrength = 1.0f;
    int jpegQuality = 88;
    Patches patches;

    /// Adds patches with their paint; seeds follow from the patch's place in the object.
    Object& add(Patches more, const Paint& paint, float detail = 1.0f);
    Object& add(Patch one, const Paint& paint, float detail = 1.0f) {
        return add(Patches{std::move(one)}, paint, detail);
    }
    bool indoors() const { return finish == Finish::baked || finish == Finish::lit; }
    std::size_t triangleCount() const;
};

/// A small spherical lamp: irradiance = intensity * cos / distance^2 (candela in the viewer's units).
struct Lamp {
    std::string name;
    vec3 position{0.0f};
    float radius = 0.02f;  // metres, for soft shadows
    vec3 intensity{1.0f};
    bool exported = false;  // becomes a KHR_lights_punctual point light
};

struct CameraView {
    std::string name;
    vec3 position{0.0f}, target{0.0f, 0.0f, -1.0f};
    float yfovDegrees = 47.0f;
};

/// A window's opening; right x up points into the room.
struct Portal {
    vec3 corner{0.0f}, right{1, 0, 0}, up{0, 1, 0};
    vec3 inwards() const { return glm::normalize(glm::cross(right, up)); }
};

/// The windows as sources of sky light, and the sun behind them.
struct Daylight {
    std::vector<Portal> portals;
    vec3 toSun{0, 1, 0};                             // unit
    vec3 sunIrradiance{0.0f};                        // on a surface facing it
    std::function<vec3(const vec3& direction)> sky;  // radiance that enters the room
};

struct Model {
    std::vector<Object> objects;
    std::vector<Lamp> lamps;
    std::vector<CameraView> cameras;  // the first is the one that glossy light is baked for
    Daylight daylight;

    Object& add(const std::string& name, Finish finish, int textureWidth, int textureHeight);
};

}  // namespace studio
