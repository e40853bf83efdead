// The studio, part by part. Room: x right, y up, -z towards the window; the viewer sits at the desk at x = 0.35, z = 0.
#pragma once

#include "model.hpp"

namespace studio {

// The room's inner faces, metres.
inline constexpr float kWest = -1.25f, kEast = 2.6f, kNorth = -4.0f, kSouth = 1.6f, kCeiling = 2.8f, kWallDepth = 0.22f;
// The window behind the desk and the one at the side, metres.
inline constexpr float kWindowLeft = -0.35f, kWindowRight = 1.45f, kWindowSill = 0.6f, kWindowTop = 2.4f;
inline constexpr float kSideNear = -0.8f, kSideFar = -2.5f, kSideSill = 0.85f, kSideTop = 2.3f;
inline constexpr float kDeskTop = 0.74f;

// How far the hills are that mist swallows, and where the sky is painted, metres.
inline constexpr float kSkyRadius = 12000.0f;

/// Radiance of the sky in a direction, as seen (display white is 1); `clouds` false for lighting.
vec3 skyColor(const vec3& direction, bool clouds);
vec3 toSun();

Daylight makeDaylight();
void addShell(Model& model);
void addFurniture(Model& model);
void addBooks(Model& model);
void addDesk(Model& model);
void addDeskThings(Model& model);
void addLamps(Model& model);
void addPlants(Model& model);
void addLand(Model& model);
void addTown(Model& model);

/// A book standing with its spine towards +z, its foot's middle at the origin.
struct BookSize {
    float thickness, height, depth;  // metres
};
void addBook(Object& object, const mat4& worldFromBook, const BookSize& size, std::uint32_t seed, float sideDetail);

Model makeStudio();

}  // namespace studio
