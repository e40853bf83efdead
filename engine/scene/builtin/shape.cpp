// The plain part of shape.hpp: vertices, normals, grids, boxes.
#include "scene/builtin/shape.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <unordered_map>

namespace dioptre::builtin {

namespace {

std::uint32_t toIndex(std::size_t i) {
    return static_cast<std::uint32_t>(i);
}

/// Two triangles along the shorter diagonal, corners in order around.
void addQuad(Shape& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto at = [&](std::uint32_t i) { return shape.position[i]; };
    if (glm::distance(at(a), at(c)) <= glm::distance(at(b), at(d)))
        shape.index.insert(shape.index.end(), {a, b, c, a, c, d});
    else
        shape.index.insert(shape.index.end(), {a, b, d, b, c, d});
}

/// A closed shape's outside is out: six times its volume is positive.
void turnOutside(Shape& shape) {
    double volume = 0.0;
    for (std::size_t i = 0; i < shape.index.size(); i += 3) {
        const glm::dvec3 a(shape.position[shape.index[i]]), b(shape.position[shape.index[i + 1]]),
            c(shape.position[shape.index[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c));
    }
    if (volume >= 0.0) return;
    for (std::size_t i = 0; i < shape.index.size(); i += 3) std::swap(shape.index[i + 1], shape.index[i + 2]);
}

float mirrored(float u) {
    return 1.0f - std::abs(1.0f - 2.0f * u);
}

/// Where (x, y) of the square grid [-r, r]^2 lies around its ring, in steps from 0 to 8 * ring.
int placeOnRing(int x, int y, int ring) {
    if (x == ring && y < ring) return y + ring;
    if (y == ring && x > -ring) return 3 * ring - x;
    if (x == -ring && y > -ring) return 5 * ring - y;
    return 7 * ring + x;
}

struct PositionHash {
    std::size_t operator()(const vec3& p) const {
        std::uint32_t bits[3];
        std::memcpy(bits, &p, sizeof bits);
        return hash(bits[0] ^ hash(bits[1] ^ hash(bits[2])));
    }
};

}  // namespace

Shape& Shape::add(const Shape& other) {
    const std::uint32_t first = toIndex(position.size());
    position.insert(position.end(), other.position.begin(), other.position.end());
    uv.insert(uv.end(), other.uv.begin(), other.uv.end());
    index.reserve(index.size() + other.index.size());
    for (const std::uint32_t i : other.index) index.push_back(first + i);
    seams = seams || other.seams;
    return *this;
}

Shape& Shape::move(const mat4& m) {
    for (vec3& p : position) p = apply(m, p);
    if (glm::determinant(glm::mat3(m)) < 0.0f)
        for (std::size_t i = 0; i < index.size(); i += 3) std::swap(index[i + 1], index[i + 2]);
    return *this;
}

Shape& Shape::scaleUv(const vec2& factor) {
    for (vec2& t : uv) t *= factor;
    return *this;
}

Shape& Shape::bend(const std::function<vec3(const vec3&)>& to) {
    for (vec3& p : position) p = to(p);
    return *this;
}

Primitive toPrimitive(const Shape& shape, int material) {
    Primitive primitive;
    primitive.material = material;
    // Which normal a vertex has its share in
    std::vector<std::uint32_t> normalOf(shape.position.size());
    std::unordered_map<vec3, std::uint32_t, PositionHash> firstAt;
    for (std::uint32_t i = 0; i < normalOf.size(); ++i)
        normalOf[i] = shape.seams ? firstAt.try_emplace(shape.position[i] + 0.0f, i).first->second : i;

    std::vector<vec3> normals(shape.position.size(), vec3(0.0f));
    primitive.indices.reserve(shape.index.size());
    std::vector<std::uint32_t> number(shape.position.size(), ~0u);  // of the vertices that are kept
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < shape.index.size(); i += 3) {
        const std::uint32_t* t = &shape.index[i];
        const vec3 a = shape.position[t[0]], b = shape.position[t[1]], c = shape.position[t[2]];
        const vec3 area = glm::cross(b - a, c - a);
        const float longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        if (!(glm::length(area) > 1e-6f * longest * longest) || longest < 1e-7f) continue;
        for (int k = 0; k < 3; ++k) {
            normals[normalOf[t[k]]] += area;
            if (number[t[k]] == ~0u) number[t[k]] = kept++;
            primitive.indices.push_back(number[t[k]]);
        }
    }
    primitive.vertices.resize(kept);
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] == ~0u) continue;
        Vertex& vertex = primitive.vertices[number[i]];
        const vec3 normal = normals[normalOf[i]];
        vertex.position = shape.position[i];
        vertex.normal = glm::length(normal) > 0.0f ? glm::normalize(normal) : kY;
        vertex.uv = shape.uv[i];
        primitive.bounds.add(vertex.position);
    }
    return primitive;
}

int Detail::around(int count) const {
    return std::max(8, 8 * static_cast<int>(std::lround(toFloat(count) * scale / 8.0f)));
}

int Detail::along(int count) const {
    return std::max(4, static_cast<int>(std::lround(toFloat(count) * scale)));
}

Shape polar(int around, int along, const Surface& point) {
    assert(around % 8 == 0);
    const int cap = around / 8;
    along = std::max(along, 2 * cap + 1);
    Shape shape;
    const auto put = [&](int numerator, int denominator, int row) {
        const float u = denominator > 0 ? toFloat(numerator) / toFloat(denominator) : 0.0f;
        const float v = toFloat(row) / toFloat(along);
        shape.position.push_back(point(u, v));
        shape.uv.emplace_back(mirrored(u), v);
        return toIndex(shape.position.size() - 1);
    };
    // The rings between the caps
    for (int j = cap; j <= along - cap; ++j)
        for (int i = 0; i < around; ++i) put(i, around, j);
    const auto body = [&](int i, int j) { return toIndex(static_cast<std::size_t>(j * around + i % around)); };
    const int last = along - 2 * cap;
    for (int j = 0; j < last; ++j)
        for (int i = 0; i < around; ++i) addQuad(shape, body(i, j), body(i, j + 1), body(i + 1, j + 1), body(i + 1, j));
    // The caps, whose outermost ring is the body's first or last
    for (const bool end : {false, true}) {
        std::vector<std::uint32_t> number;
        const int side = 2 * cap + 1;
        for (int y = -cap; y <= cap; ++y) {
            for (int x = -cap; x <= cap; ++x) {
                const int ring = std::max(std::abs(x), std::abs(y)), place = placeOnRing(x, y, ring);
                number.push_back(ring == cap ? body(place, end ? last : 0)
                                             : put(place, 8 * ring, end ? along - ring : ring));
            }
        }
        const auto at = [&](int x, int y) { return number[static_cast<std::size_t>(y * side + x)]; };
        for (int y = 0; y + 1 < side; ++y) {
            for (int x = 0; x + 1 < side; ++x) {
                if (end)
                    addQuad(shape, at(x, y), at(x, y + 1), at(x + 1, y + 1), at(x + 1, y));
                else
                    addQuad(shape, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
            }
        }
    }
    turnOutside(shape);
    return shape;
}

Shape loop(int around, int along, const Surface& point) {
    Shape shape;
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < around; ++i) {
            const float u = toFloat(i) / toFloat(around), v = toFloat(j) / toFloat(along);
            shape.position.push_back(point(u, v));
            shape.uv.emplace_back(mirrored(u), mirrored(v));
        }
    }
    const auto at = [&](int i, int j) { return toIndex(static_cast<std::size_t>((j % along) * around + i % around)); };
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) addQuad(shape, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    turnOutside(shape);
    return shape;
}

Shape sheet(int columns, int rows, const Surface& point) {
    Shape shape;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const float u = toFloat(i) / toFloat(columns), v = toFloat(j) / toFloat(rows);
            shape.position.push_back(point(u, v));
            shape.uv.emplace_back(u, v);
        }
    }
    const auto at = [&](int i, int j) { return toIndex(static_cast<std::size_t>(j * (columns + 1) + i)); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) addQuad(shape, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    return shape;
}

Shape cube(int steps, const std::function<vec3(const vec3&)>& point, float inset) {
    Shape all;
    struct Face {
        vec3 middle, right, down;
    };
    const Face faces[] = {{kX, -kZ, -kY}, {-kX, kZ, -kY}, {kY, kX, kZ}, {-kY, kX, -kZ}, {kZ, kX, -kY}, {-kZ, -kX, -kY}};
    for (int f = 0; f < 6; ++f) {
        const Face& face = faces[f];
        // Neighbouring faces count in opposite directions: exactly symmetric, so that their edges meet to the last bit
        const auto coordinate = [&](float t) {
            return toFloat(2 * static_cast<int>(std::lround(t * toFloat(steps))) - steps) / toFloat(steps);
        };
        Shape one = sheet(steps, steps, [&](float u, float v) {
            return point(face.middle + coordinate(u) * face.right + coordinate(v) * face.down);
        });
        const vec2 corner(toFloat(f % 3), toFloat(f / 3)), size(1.0f / 3.0f, 0.5f);
        for (vec2& t : one.uv) t = (corner + inset + t * (1.0f - 2.0f * inset)) * size;
        all.add(one);
    }
    all.seams = true;
    return all;
}

Shape roundedBox(const Detail& detail, const vec3& half, float radius, int steps) {
    const int count = std::max(4, detail.around(steps) / 4 * 4);
    const float r = std::min({radius, half.x, half.y, half.z});
    const auto spread = [&](float t, float extent) {
        const float edge = 0.5f, inner = 1.0f - r / extent, size = std::abs(t);
        const float place = size < edge ? inner * size / edge : inner + (1.0f - inner) * (size - edge) / (1.0f - edge);
        return std::copysign(place * extent, t);
    };
    return cube(count, [&](const vec3& onCube) {
        const vec3 target(spread(onCube.x, half.x), spread(onCube.y, half.y), spread(onCube.z, half.z));
        const vec3 core = glm::clamp(target, r - half, half - r), out = target - core;
        const float length = glm::length(out);
        return length > 0.0f ? core + out * (r / length) : core;
    });
}

}  // namespace dioptre::builtin
