// A bounding volume hierarchy over the scene's triangles for the bake and the preview.
// Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies" (binned surface area heuristic).
#pragma once

#include <cstdint>
#include <vector>

#include "model.hpp"

namespace studio {

struct Ray {
    vec3 origin, direction;  // direction need not be unit
    float limit = 1e9f;      // in lengths of the direction
};

/// What a ray met: the place in a patch's unit square.
struct Hit {
    float distance = 1e9f;
    int object = -1, patch = -1;
    vec2 unit{0.0f};
    vec3 normal{0.0f};  // interpolated, unit
    bool back = false;  // met from behind
    bool found() const { return object >= 0; }
};

struct Triangle {
    vec3 corner, edge1, edge2;
    int object = 0, patch = 0;
    int vertex[3] = {0, 0, 0};  // in the patch
    bool blocks = true;         // casts shadows
};

class Bvh {
  public:
    /// `wanted(object)` chooses what takes part.
    Bvh(const Model& model, const std::function<bool(const Object&)>& wanted);
    Hit nearest(const Ray& ray) const;
    /// Whether anything that casts shadows lies between origin and limit.
    bool blocked(const Ray& ray) const;

  private:
    struct Node {
        vec3 low, high;
        int first = 0;  // leaf: first triangle; inner: index of the right child (the left one follows its parent)
        int count = 0;  // triangles; 0: inner
    };
    int build(int first, int count);
    template <class Visit>
    void walk(const Ray& ray, float& limit, const Visit& visit) const;

    const Model& model_;
    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

/// The two triangles of a grid cell as vertex numbers of the patch; counter-clockwise seen from outside.
void cellTriangles(const Patch& patch, int column, int row, int (&vertices)[6]);

}  // namespace studio
