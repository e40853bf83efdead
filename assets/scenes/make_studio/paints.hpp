// Procedural albedo: every function returns a paint. Lengths in metres, colours linear.
#pragma once

#include "model.hpp"

namespace studio {

/// One colour with a little cloudiness.
Paint plain(const vec3& color, float variation = 0.06f);
/// Sawn wood, grain along u or v.
Paint wood(const vec3& light, const vec3& dark, bool alongU, float roughness = 0.5f);
/// Floor boards running along v.
Paint floorBoards(const vec3& light, const vec3& dark);
/// Boards side by side across v, grain along u: a table top.
Paint tableBoards(const vec3& light, const vec3& dark, int boards);
Paint brick();
Paint plaster(const vec3& color);
/// Vertical wainscot panels, `panelWidth` apart.
Paint wainscot(const vec3& color, float panelWidth);
/// Plain weave with threads of the given pitch.
Paint fabric(const vec3& color, float pitch = 0.0035f);
/// Fine cloth with irregular upright threads.
Paint linen(const vec3& color);
Paint leather(const vec3& color);
/// An oriental rug over the whole unit square.
Paint rug();
/// Cloth-bound spine with bands and a title; colours by the patch's seed.
Paint bookSpine(std::uint32_t seed);
Paint bookCover(std::uint32_t seed);
Paint bookPages();
/// A notebook page: `left` has text, the other a drawing of a lens and its rays.
Paint notebookPage(bool left);
/// Sheet with lines of writing.
Paint letter(std::uint32_t seed);
/// A framed picture, 0: moon over hills, 1: colour fields, 2: circles, 3: botanical.
Paint framedPicture(int motif);
/// Glazed down to `bareFrom` of the patch's height, clay below.
Paint ceramic(const vec3& glaze, const vec3& clay, float roughness, float bareFrom = 0.78f);
Paint brass(float roughness, float tarnish);
/// Hammered, tarnished brass with relief.
Paint hammeredBrass();
/// A globe over longitude (u) and latitude (v).
Paint earth();
Paint foliage(const vec3& young, const vec3& old);
Paint bark(const vec3& color);
Paint fruit(const vec3& color);

}  // namespace studio
