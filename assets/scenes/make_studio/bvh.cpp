// Building and walking the hierarchy of bvh.hpp.
#include "bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace studio {

namespace {

constexpr int kBins = 12;
constexpr int kLeafTriangles = 3;

float halfArea(const vec3& low, const vec3& high) {
    const vec3 e = glm::max(high - low, vec3(0.0f));
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Box {
    vec3 low{1e30f}, high{-1e30f};
    void add(const vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Triangle& t) {
        add(t.corner);
        add(t.corner + t.edge1);
        add(t.corner + t.edge2);
    }
};

vec3 centroid(const Triangle& t) {
    return t.corner + (t.edge1 + t.edge2) / 3.0f;
}

/// Möller, Trumbore 1997. Returns the distance, negative for a miss.
float meet(const Triangle& t, const Ray& ray, float limit, vec2& barycentric) {
    const vec3 p = glm::cross(ray.direction, t.edge2);
    const float det = glm::dot(t.edge1, p);
    if (std::abs(det) < 1e-14f) return -1.0f;
    const vec3 s = ray.origin - t.corner;
    const float b1 = glm::dot(s, p) / det;
    if (b1 < 0.0f || b1 > 1.0f) return -1.0f;
    const vec3 q = glm::cross(s, t.edge1);
    const float b2 = glm::dot(ray.direction, q) / det;
    if (b2 < 0.0f || b1 + b2 > 1.0f) return -1.0f;
    const float d = glm::dot(t.edge2, q) / det;
    if (d <= 0.0f || d >= limit) return -1.0f;
    barycentric = {b1, b2};
    return d;
}

}  // namespace

void cellTriangles(const Patch& patch, int i, int j, int (&v)[6]) {
    const int topLeft = j * patch.columns + i, bottomLeft = topLeft + patch.columns;
    const int order[6] = {topLeft, bottomLeft, topLeft + 1, topLeft + 1, bottomLeft, bottomLeft + 1};
    std::copy(std::begin(order), std::end(order), std::begin(v));
}

Bvh::Bvh(const Model& model, const std::function<bool(const Object&)>& wanted) : model_(model) {
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const Object& object = model.objects[o];
        if (!wanted(object)) continue;
        for (std::size_t p = 0; p < object.patches.size(); ++p) {
            const Patch& patch = object.patches[p];
            for (int j = 0; j + 1 < patch.rows; ++j) {
                for (int i = 0; i + 1 < patch.columns; ++i) {
                    int v[6];
                    cellTriangles(patch, i, j, v);
                    for (int k = 0; k < 6; k += 3) {
                        const auto at = [&](int n) { return patch.position[static_cast<std::size_t>(v[k + n])]; };
                        Triangle t{at(0), at(1) - at(0), at(2) - at(0), static_cast<int>(o), static_cast<int>(p)};
                        if (glm::length(glm::cross(t.edge1, t.edge2)) < 1e-14f) continue;
                        for (int n = 0; n < 3; ++n) t.vertex[n] = v[k + n];
                        t.blocks = object.castsShadow;
                        triangles_.push_back(t);
                    }
                }
            }
        }
    }
    nodes_.reserve(triangles_.size());
    build(0, static_cast<int>(triangles_.size()));
}

int Bvh::build(int first, int count) {
    const auto begin = triangles_.begin() + first, end = begin + count;
    Box bounds, centres;
    for (auto t = begin; t != end; ++t) {
        bounds.add(*t);
        centres.add(centroid(*t));
    }
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({bounds.low, bounds.high, first, count});
    if (count <= kLeafTriangles) return index;

    // Find the cheapest of the bins' borders over the three axes.
    float bestCost = static_cast<float>(count) * halfArea(bounds.low, bounds.high);
    int bestAxis = -1, bestBin = 0;
    const vec3 extent = centres.high - centres.low;
    const auto binOf = [&](const Triangle& t, int axis) {
        const float x = (centroid(t)[axis] - centres.low[axis]) / extent[axis];
        return std::clamp(static_cast<int>(x * kBins), 0, kBins - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (extent[axis] <= 0.0f) continue;
        std::array<Box, kBins> boxes;
        std::array<int, kBins> counts{};
        for (auto t = begin; t != end; ++t) {
            const auto b = static_cast<std::size_t>(binOf(*t, axis));
            boxes[b].add(*t);
            ++counts[b];
        }
        for (int split = 1; split < kBins; ++split) {
            Box left, right;
            int leftCount = 0, rightCount = 0;
            for (int b = 0; b < kBins; ++b) {
                const auto k = static_cast<std::size_t>(b);
                if (counts[k] == 0) continue;
                Box& side = b < split ? left : right;
                side.add(boxes[k].low);
                side.add(boxes[k].high);
                (b < split ? leftCount : rightCount) += counts[k];
            }
            if (leftCount == 0 || rightCount == 0) continue;
            const float cost = static_cast<float>(leftCount) * halfArea(left.low, left.high) +
                               static_cast<float>(rightCount) * halfArea(right.low, right.high);
            if (cost < bestCost) {
                bestCost = cost;
                bestAxis = axis;
                bestBin = split;
            }
        }
    }
    if (bestAxis < 0) return index;

    const auto middle = std::partition(begin, end, [&](const Triangle& t) { return binOf(t, bestAxis) < bestBin; });
    const int leftCount = static_cast<int>(middle - begin);
    build(first, leftCount);
    const int right = build(first + leftCount, count - leftCount);
    nodes_[static_cast<std::size_t>(index)].first = right;
    nodes_[static_cast<std::size_t>(index)].count = 0;
    return index;
}

template <class Visit>
void Bvh::walk(const Ray& ray, float& limit, const Visit& visit) const {
    if (triangles_.empty()) return;
    const vec3 inverse = 1.0f / ray.direction;
    const auto enter = [&](const Node& n) {
        const vec3 a = (n.low - ray.origin) * inverse, b = (n.high - ray.origin) * inverse;
        const vec3 lo = glm::min(a, b), hi = glm::max(a, b);
        const float near = std::max({lo.x, lo.y, lo.z, 0.0f}), far = std::min({hi.x, hi.y, hi.z, limit});
        return near <= far ? near : -1.0f;
    };
    int stack[96];
    int top = 0, current = 0;
    if (enter(nodes_[0]) < 0.0f) return;
    for (;;) {
        const Node& node = nodes_[static_cast<std::size_t>(current)];
        if (node.count > 0) {
            for (int t = node.first; t < node.first + node.count; ++t) {
                if (visit(triangles_[static_cast<std::size_t>(t)])) return;
            }
        } else {
            const int left = current + 1, right = node.first;
            const float toLeft = enter(nodes_[static_cast<std::size_t>(left)]);
            const float toRight = enter(nodes_[static_cast<std::size_t>(right)]);
            if (toLeft >= 0.0f && toRight >= 0.0f) {
                const bool leftFirst = toLeft <= toRight;
                stack[top++] = leftFirst ? right : left;
                current = leftFirst ? left : right;
                continue;
            }
            if (toLeft >= 0.0f || toRight >= 0.0f) {
                current = toLeft >= 0.0f ? left : right;
                continue;
            }
        }
        if (top == 0) return;
        current = stack[--top];
    }
}

Hit Bvh::nearest(const Ray& ray) const {
    float limit = ray.limit;
    const Triangle* best = nullptr;
    vec2 at(0.0f);
    walk(ray, limit, [&](const Triangle& t) {
        vec2 b;
        const float d = meet(t, ray, limit, b);
        if (d > 0.0f) {
            limit = d;
            best = &t;
            at = b;
        }
        return false;
    });
    Hit hit;
    if (!best) return hit;
    const Patch& patch =
        model_.objects[static_cast<std::size_t>(best->object)].patches[static_cast<std::size_t>(best->patch)];
    const float weight[3] = {1.0f - at.x - at.y, at.x, at.y};
    vec3 normal(0.0f);
    for (int k = 0; k < 3; ++k) {
        const int v = best->vertex[k];
        hit.unit += weight[k] * vec2(patch.across[static_cast<std::size_t>(v % patch.columns)],
                                     patch.down[static_cast<std::size_t>(v / patch.columns)]);
        normal += weight[k] * patch.normal[static_cast<std::size_t>(v)];
    }
    hit.distance = limit;
    hit.object = best->object;
    hit.patch = best->patch;
    hit.back = glm::dot(glm::cross(best->edge1, best->edge2), ray.direction) > 0.0f;
    const vec3 flat = glm::cross(best->edge1, best->edge2);
    hit.normal = glm::length(normal) > 1e-6f ? glm::normalize(normal) : glm::normalize(flat);
    return hit;
}

bool Bvh::blocked(const Ray& ray) const {
    float limit = ray.limit;
    bool found = false;
    walk(ray, limit, [&](const Triangle& t) {
        vec2 b;
        found = t.blocks && meet(t, ray, limit, b) > 0.0f;
        return found;
    });
    return found;
}

}  // namespace studio
