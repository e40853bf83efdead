// Pictures that several built-in scenes use. Grey ones lie around 1 and are multiplied by a material's colour.
#pragma once

#include "scene/builtin/model.hpp"

namespace dioptre::builtin {

/// Grey; repeats at its edges.
Paint mottled(int cells, float depth, std::uint32_t seed);
/// Grey grain along v; repeats at its edges.
Paint woodGrain(std::uint32_t seed);
/// Grey fibres; repeats at its edges.
Paint felt(std::uint32_t seed);
/// Grey scratches along u.
Paint brushed(std::uint32_t seed);
/// Boards of a floor in metres: colour at (x, z), grain along z.
vec3 floorBoard(const vec2& xz);
/// Rock: colour at a place, in metres.
vec3 rock(const vec3& p);

/// Distance from `p` to a line through the points.
float strokeDistance(const vec2& p, const std::vector<vec2>& line);
/// Distance to the strokes of a capital A to F in the unit square, v down.
float letterDistance(char letter, const vec2& p);

/// A rectangle of ground under the camera's view, flat at y = 0, with the shadows of all that stands on it.
struct Ground {
    vec2 low, high;  // x, z in metres
    int side;        // texels along the longer side of its picture
};
/// `color` at (x, z); `shadow` how dark the key light's shadow is, in [0, 1]. Returns the mesh.
int addGround(Model& model, const std::string& name, const Ground& ground, const vec3& toLight, float roughness,
              float shadow, const std::function<vec3(const vec2& xz)>& color);

}  // namespace dioptre::builtin
