#include "scene/weld.hpp"

#include <algorithm>
#include <bit>

#include "core/hash_seed.hpp"

namespace dioptre {

namespace {

// More faces than this on one edge are not sorted out: comparing all with all is quadratic.
constexpr std::size_t kMostOnEdge = 16;

constexpr std::uint32_t kNone = 0xFFFFFFFF;

std::uint32_t next(std::uint32_t halfEdge) {
    return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1;
}
std::uint32_t previous(std::uint32_t halfEdge) {
    return halfEdge % 3 == 0 ? halfEdge + 2 : halfEdge - 1;
}

/// All of its bits.
template <class T>
auto wordsOf(const T& value) {
    return std::bit_cast<std::array<std::uint32_t, sizeof(T) / 4>>(value);
}

template <class T>
std::uint64_t hashOf(const T& value, std::uint64_t seed) {
    for (const std::uint32_t word : wordsOf(value)) {
        seed = (seed ^ word) * 0x9e3779b97f4a7c15ULL;
        seed ^= seed >> 29;
    }
    return seed;
}

/// Of each vertex that a triangle uses, the first that equals it; kNone of the others.
template <class Hash, class Equal>
std::vector<std::uint32_t> firstEqual(const Primitive& primitive, const Hash& hash, const Equal& equal) {
    const std::size_t mask = std::bit_ceil(2 * primitive.vertices.size() + 2) - 1;
    std::vector<std::uint32_t> table(mask + 1, kNone), first(primitive.vertices.size(), kNone);
    for (const std::uint32_t i : primitive.indices) {
        if (first[i] != kNone) continue;
        std::size_t at = hash(i) & mask;
        while (table[at] != kNone && !equal(table[at], i)) at = (at + 1) & mask;
        if (table[at] == kNone) table[at] = i;
        first[i] = table[at];
    }
    return first;
}

std::vector<std::uint32_t> findWedges(const Primitive& primitive) {
    const auto& v = primitive.vertices;
    const auto& extras = primitive.extras;
    static_assert(sizeof(Vertex) == 12 * sizeof(float) && sizeof(VertexExtra) == 16);  // no gaps
    const auto hash = [&](std::uint32_t i) {
        return extras.empty() ? hashOf(v[i], hashSeed()) : hashOf(extras[i], hashOf(v[i], hashSeed()));
    };
    const auto equal = [&](std::uint32_t a, std::uint32_t b) {
        return wordsOf(v[a]) == wordsOf(v[b]) && (extras.empty() || wordsOf(extras[a]) == wordsOf(extras[b]));
    };
    return firstEqual(primitive, hash, equal);
}

std::vector<std::uint32_t> findPlaces(const Primitive& primitive) {
    const auto& v = primitive.vertices;
    const auto hash = [&](std::uint32_t i) { return hashOf(v[i].position + 0.0f, hashSeed()); };  // -0 is 0
    const auto equal = [&](std::uint32_t a, std::uint32_t b) { return v[a].position == v[b].position; };
    return firstEqual(primitive, hash, equal);
}

/// Half-edges by the place at their ends that has the smaller number.
struct EdgeList {
    struct Entry {
        std::uint32_t other, halfEdge;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<std::uint32_t> begins;
    std::vector<Entry> entries;

    EdgeList(const std::vector<WeldedFace>& faces, std::size_t places) : begins(places + 1, 0) {
        const auto each = [&](const auto& visit) {
            for (std::uint32_t h = 0; h < 3 * faces.size(); ++h) {
                const std::uint32_t a = faces[h / 3].point[h % 3], b = faces[h / 3].point[next(h) % 3];
                visit(std::min(a, b), Entry{std::max(a, b), h});
            }
        };
        each([&](std::uint32_t place, const Entry&) { ++begins[place + 1]; });
        for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
        entries.resize(3 * faces.size());
        std::vector<std::uint32_t> end(begins.begin(), begins.end() - 1);
        each([&](std::uint32_t place, const Entry& entry) { entries[end[place]++] = entry; });
    }
};

class Welder {
  public:
    Welder(const Primitive& primitive, const std::function<bool()>& stopped)
        : primitive_(primitive), stopped_(stopped) {}

    WeldedMesh weld(std::span<const std::uint8_t> fixed) {
        placeFlags_.assign(primitive_.vertices.size(), 0);
        if (!stopped_()) addFaces(fixed);
        if (!stopped_()) pairEdges();
        if (!stopped_()) splitPlaces();
        if (stopped_()) return {};
        return std::move(mesh_);
    }

  private:
    // Until splitPlaces() a face's points are places: the first vertex of that position.
    void addFaces(std::span<const std::uint8_t> fixed) {
        const std::vector<std::uint32_t> place = findPlaces(primitive_);
        if (stopped_()) return;
        const std::vector<std::uint32_t> wedge = findWedges(primitive_);
        const auto& index = primitive_.indices;
        mesh_.faces.reserve(index.size() / 3);
        for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
            const WeldedFace face{{place[index[i]], place[index[i + 1]], place[index[i + 2]]},
                                  {wedge[index[i]], wedge[index[i + 1]], wedge[index[i + 2]]}};
            const auto& p = face.point;
            // A triangle with two corners in one place draws nothing, and its neighbours close the gap
            if (p[0] != p[1] && p[1] != p[2] && p[2] != p[0]) mesh_.faces.push_back(face);
        }
        for (std::size_t i = 0; i < fixed.size(); ++i)
            if (fixed[i] && place[i] != kNone) placeFlags_[place[i]] |= kFixed;
    }

    void pair(std::uint32_t a, std::uint32_t b) {
        mesh_.twins[a] = b;
        mesh_.twins[b] = a;
    }
    std::uint32_t placeAt(std::uint32_t halfEdge) const { return mesh_.faces[halfEdge / 3].point[halfEdge % 3]; }
    std::uint32_t wedgeAt(std::uint32_t halfEdge) const { return mesh_.faces[halfEdge / 3].wedge[halfEdge % 3]; }
    bool opposite(std::uint32_t a, std::uint32_t b) const { return placeAt(a) == placeAt(next(b)); }
    bool sameWedges(std::uint32_t a, std::uint32_t b) const {
        return wedgeAt(a) == wedgeAt(next(b)) && wedgeAt(next(a)) == wedgeAt(b);
    }

    void pairEdges() {
        mesh_.twins.assign(3 * mesh_.faces.size(), kNoTwin);
        EdgeList edges(mesh_.faces, primitive_.vertices.size());
        for (std::size_t place = 0; place + 1 < edges.begins.size(); ++place) {
            const std::span all(edges.entries.data() + edges.begins[place],
                                edges.begins[place + 1] - edges.begins[place]);
            if (all.size() > 1) std::sort(all.begin(), all.end());
            for (std::size_t i = 0; i < all.size();) {
                std::size_t end = i + 1;
                while (end < all.size() && all[end].other == all[i].other) ++end;
                pairEdge(all.subspan(i, end - i));
                i = end;
            }
            if (place % 65536 == 0 && stopped_()) return;
        }
    }

    void pairEdge(std::span<const EdgeList::Entry> edge) {
        if (edge.size() == 1) return;
        if (edge.size() == 2 && opposite(edge[0].halfEdge, edge[1].halfEdge))
            return pair(edge[0].halfEdge, edge[1].halfEdge);
        // Sheets back to back, say: those belong together that show the same vertices
        bool left = edge.size() > kMostOnEdge;
        for (std::size_t i = 0; i < edge.size() && edge.size() <= kMostOnEdge; ++i) {
            const std::uint32_t a = edge[i].halfEdge;
            for (std::size_t k = i + 1; k < edge.size() && mesh_.twins[a] == kNoTwin; ++k) {
                const std::uint32_t b = edge[k].halfEdge;
                if (mesh_.twins[b] == kNoTwin && opposite(a, b) && sameWedges(a, b)) pair(a, b);
            }
            left = left || mesh_.twins[a] == kNoTwin;
        }
        if (!left) return;
        placeFlags_[placeAt(edge[0].halfEdge)] |= kFixed | kUntouched;
        placeFlags_[edge[0].other] |= kFixed | kUntouched;
        placeFlags_[placeAt(next(edge[0].halfEdge))] |= kFixed | kUntouched;
    }

    /// Each fan of faces around a place gets a point of its own.
    void splitPlaces() {
        std::vector<std::uint32_t> pointOf(mesh_.twins.size(), kNone);
        std::vector<std::uint8_t> fans(primitive_.vertices.size(), 0);  // up to 2
        std::vector<std::uint32_t> placeOf;
        std::vector<bool> open;
        for (std::uint32_t h = 0; h < pointOf.size(); ++h) {
            if (pointOf[h] != kNone) continue;
            const auto point = static_cast<std::uint32_t>(placeOf.size());
            const std::uint32_t place = placeAt(h);
            std::uint8_t flags = 0;
            std::uint32_t at = h;
            const auto visit = [&] {
                pointOf[at] = point;
                if (wedgeAt(at) != wedgeAt(h)) flags |= kSeam;
            };
            do {  // clockwise
                visit();
                at = mesh_.twins[at] == kNoTwin ? kNone : next(mesh_.twins[at]);
            } while (at != kNone && at != h);
            open.push_back(at == kNone);
            if (at == kNone)
                for (at = mesh_.twins[previous(h)]; at != kNoTwin; at = mesh_.twins[previous(at)]) visit();
            placeOf.push_back(place);
            mesh_.flags.push_back(flags);
            mesh_.points.push_back(primitive_.vertices[place].position);
            fans[place] = static_cast<std::uint8_t>(std::min(2, fans[place] + 1));
        }
        for (std::size_t p = 0; p < placeOf.size(); ++p) {
            mesh_.flags[p] |= placeFlags_[placeOf[p]];
            // Borders that touch in one vertex go on touching
            if (open[p] && fans[placeOf[p]] > 1) mesh_.flags[p] |= kFixed;
        }
        for (std::uint32_t h = 0; h < pointOf.size(); ++h) mesh_.faces[h / 3].point[h % 3] = pointOf[h];
    }

    const Primitive& primitive_;
    const std::function<bool()>& stopped_;
    WeldedMesh mesh_;
    std::vector<std::uint8_t> placeFlags_;
};

}  // namespace

WeldedMesh weld(const Primitive& primitive, std::span<const std::uint8_t> fixed, const std::function<bool()>& stopped) {
    return Welder(primitive, stopped).weld(fixed);
}

}  // namespace dioptre
