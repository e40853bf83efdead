// Isosurfaces of shape.hpp.
// Gibson 1998, "Constrained elastic surface nets", without the relaxation: a vertex where the surface passes through a
// cell, at the mean of its crossings with the edges. Nielson 2004, "Dual marching cubes": as many vertices as there are
// sheets in a cell, so that no edge has more than two triangles.
#include <algorithm>
#include <array>
#include <numeric>

#include "scene/builtin/shape.hpp"

namespace dioptre::builtin {

namespace {

// A cell's edges: 4 along each axis, numbered by where they lie on the next two axes.
int edgeNumber(int axis, int onNext, int onOther) {
    return 4 * axis + onNext + 2 * onOther;
}

/// Which sheet each crossed edge of a cell belongs to; `inside` has bit x + 2 y + 4 z of each corner.
std::array<std::uint8_t, 12> sheetsOf(unsigned inside, int& count) {
    std::array<std::uint8_t, 12> sheet;
    std::iota(sheet.begin(), sheet.end(), std::uint8_t{0});
    const auto join = [&](int a, int b) {
        const auto from = sheet[static_cast<std::size_t>(a)], to = sheet[static_cast<std::size_t>(b)];
        std::replace(sheet.begin(), sheet.end(), from, to);
    };
    std::array<bool, 12> crossed{};
    for (int n = 0; n < 3; ++n) {
        const int p = (n + 1) % 3, q = (n + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            const auto in = [&](int onP, int onQ) {
                return (inside >> ((side << n) + (onP << p) + (onQ << q)) & 1u) != 0;
            };
            const auto alongP = [&](int onQ) { return edgeNumber(p, onQ, side); };
            const auto alongQ = [&](int onP) { return edgeNumber(q, side, onP); };
            std::array<int, 4> edges{};
            std::size_t found = 0;
            for (int k = 0; k < 2; ++k) {
                if (in(0, k) != in(1, k)) edges[found++] = alongP(k);
                if (in(k, 0) != in(k, 1)) edges[found++] = alongQ(k);
            }
            for (std::size_t k = 0; k < found; ++k) crossed[static_cast<std::size_t>(edges[k])] = true;
            if (found == 2) join(edges[0], edges[1]);
            // Two corners across are inside: each is cut off by itself, whichever cell looks at the face
            if (found == 4) {
                join(alongP(0), alongQ(in(0, 0) ? 0 : 1));
                join(alongP(1), alongQ(in(0, 0) ? 1 : 0));
            }
        }
    }
    // Number the sheets 0, 1, ...
    std::array<int, 12> number;
    number.fill(-1);
    count = 0;
    for (std::size_t e = 0; e < 12; ++e) {
        if (!crossed[e]) continue;
        int& of = number[sheet[e]];
        if (of < 0) of = count++;
    }
    for (std::size_t e = 0; e < 12; ++e) sheet[e] = static_cast<std::uint8_t>(std::max(0, number[sheet[e]]));
    return sheet;
}

class Net {
  public:
    Net(const std::function<float(const vec3&)>& distance, const vec3& low, const vec3& high, int cells)
        : distance_(distance),
          low_(low),
          step_(std::max({(high - low).x, (high - low).y, (high - low).z}) / toFloat(cells)),
          n_(glm::ivec3(glm::ceil((high - low) / step_)) + 1) {}

    Shape make() {
        value_.resize(number({0, 0, n_.z}));
        first_.resize(value_.size());
        sheets_.resize(value_.size());
        each(0, [&](const glm::ivec3& at) { value_[number(at)] = distance_(point(at)); });
        each(1, [&](const glm::ivec3& at) { addVertices(at); });
        for (vec3& p : shape_.position) settle(p);
        each(1, [&](const glm::ivec3& at) {
            if (at.x > 0 && at.y > 0 && at.z > 0)
                for (int axis = 0; axis < 3; ++axis) addQuad(at, axis);
        });
        return std::move(shape_);
    }

  private:
    std::size_t number(const glm::ivec3& at) const {
        return static_cast<std::size_t>((at.z * n_.y + at.y) * n_.x + at.x);
    }
    vec3 point(const glm::ivec3& at) const { return low_ + step_ * vec3(at); }

    /// All places but the last `less` along each axis.
    void each(int less, const std::function<void(const glm::ivec3&)>& body) const {
        for (int z = 0; z < n_.z - less; ++z)
            for (int y = 0; y < n_.y - less; ++y)
                for (int x = 0; x < n_.x - less; ++x) body({x, y, z});
    }

    void addVertices(const glm::ivec3& cell) {
        unsigned inside = 0;
        for (int corner = 0; corner < 8; ++corner)
            if (value_[number(cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2))] < 0.0f)
                inside |= 1u << corner;
        if (inside == 0 || inside == 255) return;
        int count = 0;
        const auto sheets = sheetsOf(inside, count);
        std::array<vec3, 4> sums{};
        std::array<int, 4> crossings{};
        std::uint32_t packed = 0;
        for (int edge = 0; edge < 12; ++edge) {
            const int axis = edge / 4;
            glm::ivec3 a = cell;
            a[(axis + 1) % 3] += edge & 1;
            a[(axis + 2) % 3] += edge >> 1 & 1;
            glm::ivec3 b = a;
            ++b[axis];
            const float va = value_[number(a)], vb = value_[number(b)];
            if ((va < 0.0f) == (vb < 0.0f)) continue;
            const std::uint8_t sheet = sheets[static_cast<std::size_t>(edge)];
            sums[sheet] += glm::mix(point(a), point(b), va / (va - vb));
            ++crossings[sheet];
            packed |= static_cast<std::uint32_t>(sheet) << (2 * edge);
        }
        first_[number(cell)] = static_cast<std::uint32_t>(shape_.position.size());
        sheets_[number(cell)] = packed;
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
            shape_.position.push_back(sums[k] / toFloat(crossings[k]));
    }

    /// Two steps along the gradient, within the cell.
    void settle(vec3& p) const {
        const vec3 start = p;
        const float h = 0.2f * step_;
        for (int pass = 0; pass < 2; ++pass) {
            const float d = distance_(p);
            const vec3 g = vec3(distance_(p + h * kX), distance_(p + h * kY), distance_(p + h * kZ)) - d;
            const float length = glm::length(g);
            if (length > 1e-9f) p -= g / length * glm::clamp(d * h / length, -0.3f * step_, 0.3f * step_);
        }
        p = glm::clamp(p, start - 0.45f * step_, start + 0.45f * step_);
    }

    /// The two triangles around the edge from `at` along `axis`, if the surface crosses it.
    void addQuad(const glm::ivec3& at, int axis) {
        glm::ivec3 end = at;
        ++end[axis];
        const bool inside = value_[number(at)] < 0.0f;
        if (inside == (value_[number(end)] < 0.0f)) return;
        std::array<std::uint32_t, 4> corner{};
        for (int k = 0; k < 4; ++k) {
            const int next = k == 0 || k == 3 ? 1 : 0, other = k < 2 ? 1 : 0;
            glm::ivec3 cell = at;
            cell[(axis + 1) % 3] -= next;
            cell[(axis + 2) % 3] -= other;
            const std::uint32_t sheet = sheets_[number(cell)] >> (2 * edgeNumber(axis, next, other)) & 3u;
            corner[static_cast<std::size_t>(k)] = first_[number(cell)] + sheet;
        }
        if (!inside) std::swap(corner[1], corner[3]);
        const auto [p, q, r, s] = corner;
        const auto gap = [&](std::uint32_t i, std::uint32_t j) {
            return glm::distance(shape_.position[i], shape_.position[j]);
        };
        if (gap(p, r) <= gap(q, s))
            shape_.index.insert(shape_.index.end(), {p, q, r, p, r, s});
        else
            shape_.index.insert(shape_.index.end(), {p, q, s, q, r, s});
    }

    const std::function<float(const vec3&)>& distance_;
    vec3 low_;
    float step_;
    glm::ivec3 n_;
    std::vector<float> value_;
    std::vector<std::uint32_t> first_, sheets_;  // of each cell: its first vertex, its edges' sheets in 2 bits each
    Shape shape_;
};

}  // namespace

Shape isosurface(const std::function<float(const vec3&)>& distance, const vec3& low, const vec3& high, int cells) {
    Shape shape = Net(distance, low, high, cells).make();
    for (const vec3& p : shape.position)
        shape.uv.emplace_back(std::abs(std::atan2(p.x, p.z)) / kPi, (high.y - p.y) / (high.y - low.y));
    return shape;
}

}  // namespace dioptre::builtin
