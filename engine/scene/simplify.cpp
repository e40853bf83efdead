// Garland, Heckbert 1997, "Surface simplification using quadric error metrics": a vertex's quadric is the sum of its
// faces' squared distances from a point, each times the face's area; moving v0 onto v1 costs Q0(v1) + Q1(v1).
// Jeong et al. 2013, "Real-time defocus rendering with level of detail and sub-sample blur": a chain of levels,
// each with half the triangles of the one before.
//
// The one place that names OpenMesh: connectivity, the test that a collapse keeps a surface a surface, and quadrics are
// its own. Not its decimater, which asks for the legality of each possible collapse before its cost: here the cheap
// question comes first, and legality is asked only of what is next in the queue.
#include "scene/simplify.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// After it: it does not include what it needs
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>
#include <optional>

#include "scene/collapse_queue.hpp"
#include "scene/fan.hpp"
#include "scene/ring.hpp"
#include "scene/weld.hpp"

namespace dioptre {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

// A level that keeps more of the one before is not worth its memory.
constexpr double kMostKept = 0.75;
// Of an edge's length: what flat regions are ordered by, so that short edges go first there and no slivers come up. Far
// below what can be seen.
constexpr double kFlatness = 1e-5;
// Of coordinates and lengths: a few roundings of a float
constexpr double kRounding = 3e-7;
// Between two faces' normals: a rim so sharp that their planes alone would let it shrink.
constexpr double kSharpCosine = -0.5;
constexpr float kLeastCapGrowth = 1.2f;  // between rounds, see Chain::decimate
constexpr std::size_t kSample = 512;     // vertices
// Times the cost of the next in the queue: a vertex whose cheapest way is barred takes the next one, up to this cost,
// rather than wait in the queue for its turn, which would double the time. Half as far off costs a quarter.
constexpr float kMuchMore = 4.0f;
// Ways to move a vertex that would make too large an error: the next ones, of higher cost, hardly make less.
constexpr int kMostExcesses = 2;
constexpr float kNever = std::numeric_limits<float>::max();
// Of the diagonal of the bounds: no point is farther from their middle, so one point there would do as well.
constexpr double kMostError = 0.5;

double processorSeconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

VertexHandle vertex(std::uint32_t point) {
    return VertexHandle(static_cast<int>(point));
}
std::uint32_t indexOf(const OpenMesh::BaseHandle& handle) {
    return static_cast<std::uint32_t>(handle.idx());
}

/// OpenMesh's connectivity from twins: its own add_face() searches for each of them.
void connect(Mesh& mesh, const WeldedMesh& welded) {
    const auto& twins = welded.twins;
    std::vector<int> handle(twins.size());
    int edges = 0;
    for (std::uint32_t h = 0; h < twins.size(); ++h) {
        if (twins[h] != kNoTwin && twins[h] < h)
            handle[h] = handle[twins[h]] + 1;
        else
            handle[h] = 2 * edges++;
    }
    mesh.resize(welded.points.size(), static_cast<std::size_t>(edges), welded.faces.size());
    std::vector<HalfedgeHandle> borderOf(welded.points.size());  // that leaves the point
    for (std::uint32_t h = 0; h < twins.size(); ++h) {
        const WeldedFace& face = welded.faces[h / 3];
        const std::uint32_t from = face.point[h % 3], to = face.point[(h + 1) % 3];
        const HalfedgeHandle here(handle[h]), after(handle[h % 3 == 2 ? h - 2 : h + 1]);
        mesh.set_vertex_handle(here, vertex(to));
        mesh.set_face_handle(here, FaceHandle(static_cast<int>(h / 3)));
        mesh.set_next_halfedge_handle(here, after);
        mesh.set_halfedge_handle(FaceHandle(static_cast<int>(h / 3)), here);
        if (!mesh.halfedge_handle(vertex(from)).is_valid()) mesh.set_halfedge_handle(vertex(from), here);
        if (twins[h] != kNoTwin) continue;
        const HalfedgeHandle border(handle[h] + 1);
        mesh.set_vertex_handle(border, vertex(from));
        borderOf[to] = border;
    }
    for (std::uint32_t h = 0; h < twins.size(); ++h) {
        if (twins[h] != kNoTwin) continue;
        const std::uint32_t from = welded.faces[h / 3].point[h % 3];
        mesh.set_next_halfedge_handle(HalfedgeHandle(handle[h] + 1), borderOf[from]);
    }
    for (std::uint32_t p = 0; p < welded.points.size(); ++p) {
        mesh.set_point(vertex(p), {welded.points[p].x, welded.points[p].y, welded.points[p].z});
        if (borderOf[p].is_valid()) mesh.set_halfedge_handle(vertex(p), borderOf[p]);  // as OpenMesh wants it
    }
}

double valueAt(const Quadric& quadric, const glm::dvec3& p) {
    // Rounding takes it below 0 where all is flat
    return std::max(0.0, quadric(OpenMesh::Vec3d(p.x, p.y, p.z)));
}

double distanceFromSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = glm::dot(along, along);
    const double t = length > 0.0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

class Chain {
  public:
    explicit Chain(const SimplifyRequest& request)
        : request_(request),
          welded_(weld(request.primitive, request.fixed, request.stopped)),
          queue_(welded_.points.size()),
          alive_(welded_.faces.size()) {
        if (request.stopped()) return;
        connect(mesh_, welded_);
        if (request.stopped()) return;
        origin_ = glm::dvec3(request.primitive.bounds.empty() ? glm::vec3(0.0f) : request.primitive.bounds.centre());
        for (const glm::vec3& p : welded_.points)
            for (int k = 0; k < 3; ++k) reach_ = std::max(reach_, std::abs(static_cast<double>(p[k])));
        const Bounds& bounds = request.primitive.bounds;
        const double diagonal = glm::distance(glm::dvec3(bounds.min), glm::dvec3(bounds.max));
        mostError_ = static_cast<float>(std::min(kMostError * diagonal, double{kNever}));
        error_.assign(welded_.faces.size(), 0.0f);
        addQuadrics();
        welded_.twins = {};
        needs_.assign(welded_.points.size(), 0.0f);
        points_.resize(welded_.points.size());
        std::iota(points_.begin(), points_.end(), 0u);
    }

    void run(double started) {
        if (alive_ == 0 || request_.stopped()) return;
        startCap();
        std::size_t before = request_.primitive.triangleCount();
        for (std::size_t target = before / 2; before > kFewestTriangles && !request_.stopped(); target /= 2) {
            decimate(target);
            if (request_.stopped() || static_cast<double>(alive_) > kMostKept * static_cast<double>(before) ||
                alive_ == 0)
                return;
            LodLevel level = currentLevel();
            const double now = processorSeconds();
            level.seconds = static_cast<float>(now - started);
            started = now;
            before = alive_;
            request_.made(std::move(level));
        }
    }

  private:
    using FaceErrors = std::array<float, kMostNeighbours>;

    glm::dvec3 at(std::uint32_t point) const { return glm::dvec3(welded_.points[point]) - origin_; }

    bool isGone(std::uint32_t point) const { return mesh_.status(vertex(point)).deleted(); }

    void addQuadrics();
    void addRim(std::uint32_t halfEdge, const std::vector<glm::vec3>& normals);
    void decimate(std::size_t target);
    bool raiseCap(std::size_t vertices);
    void startCap();
    void enqueue(std::uint32_t point);
    double cost(std::uint32_t from, std::uint32_t onto) const;
    std::optional<Ring> ringOf(std::uint32_t point) const;
    bool tryNext();
    bool mayTouch(const Ring& ring, const WedgeMove& move) const;
    FaceErrors errorsAfter(const Ring& ring, const FanChange& change, double shift) const;
    double seamShift(const Ring& ring, const WedgeMove& move) const;
    bool facesSource(const Ring& ring, const WedgeMove& move) const;
    HalfedgeHandle halfedgeTo(const Ring& ring) const;
    bool staysManifold(const Ring& ring, HalfedgeHandle along);
    std::size_t neighbours(std::uint32_t point, std::size_t limit) const;
    void collapse(const Ring& ring, const WedgeMove& move, const FaceErrors& errors, HalfedgeHandle along);
    LodLevel currentLevel() const;

    const SimplifyRequest& request_;
    WeldedMesh welded_;
    Mesh mesh_;
    CollapseQueue queue_;
    std::size_t alive_;  // faces
    glm::dvec3 origin_{0.0};
    double reach_ = 0.0;  // of coordinates
    std::vector<Quadric> quadrics_;
    std::vector<float> own_;    // of each point: its quadric there
    std::vector<float> error_;  // of each face, see FanChange::errors
    float cap_ = 0.0f;          // no face's error gets larger for now
    float mostError_ = 0.0f;    // the largest that cap_ may be
    std::vector<float> needs_;  // of each point: the least cap that may let it go; kNever before its neighbours change
    std::vector<std::uint32_t> points_;  // that are left
};

void Chain::addQuadrics() {
    quadrics_.assign(welded_.points.size(), Quadric());
    own_.assign(welded_.points.size(), 0.0f);
    std::vector<glm::vec3> normals(welded_.faces.size());
    for (std::size_t f = 0; f < welded_.faces.size(); ++f) {
        const auto& p = welded_.faces[f].point;
        const glm::dvec3 a = at(p[0]), vector = glm::cross(at(p[1]) - a, at(p[2]) - a);
        const double length = glm::length(vector);
        if (!(length > 0.0)) continue;
        const glm::dvec3 n = vector / length;
        normals[f] = glm::vec3(n);
        const Quadric plane = Quadric(n.x, n.y, n.z, -glm::dot(n, a)) * (0.5 * length);
        for (const std::uint32_t point : p) quadrics_[point] += plane;
    }
    for (std::uint32_t h = 0; h < welded_.twins.size(); ++h)
        if (welded_.twins[h] != kNoTwin && welded_.twins[h] > h) addRim(h, normals);
}

/// Planes through a sharp edge, across its faces.
void Chain::addRim(std::uint32_t halfEdge, const std::vector<glm::vec3>& normals) {
    const glm::vec3 &left = normals[halfEdge / 3], &right = normals[welded_.twins[halfEdge] / 3];
    if (glm::dot(left, right) > kSharpCosine) return;
    const auto& p = welded_.faces[halfEdge / 3].point;
    const std::uint32_t from = p[halfEdge % 3], to = p[(halfEdge + 1) % 3];
    const glm::dvec3 a = at(from), along = at(to) - a, across = glm::cross(along, glm::dvec3(left));
    const double length = glm::length(across);
    if (!(length > 0.0)) return;
    const glm::dvec3 n = across / length;
    const Quadric plane = Quadric(n.x, n.y, n.z, -glm::dot(n, a)) * glm::dot(along, along);
    for (const std::uint32_t point : {from, to}) quadrics_[point] += plane;
}

double Chain::cost(std::uint32_t from, std::uint32_t onto) const {
    const glm::dvec3 p = at(onto), way = p - at(from);
    const double length = kFlatness * glm::dot(way, way);
    return valueAt(quadrics_[from], p) + static_cast<double>(own_[onto]) + length * length;
}

void Chain::enqueue(std::uint32_t point) {
    const std::uint8_t flags = welded_.flags[point];
    double least = kNever;
    if (!(flags & kFixed)) {
        const bool border = mesh_.is_boundary(vertex(point));
        const HalfedgeHandle first = mesh_.halfedge_handle(vertex(point));
        HalfedgeHandle h = first;
        std::size_t count = 0;
        do {
            const std::uint32_t other = indexOf(mesh_.to_vertex_handle(h));
            // On a border or seam there are two ways to go; which it is of a seam shows when its turn comes
            const bool possible =
                border ? mesh_.is_boundary(mesh_.edge_handle(h)) : !(flags & kSeam) || (welded_.flags[other] & kSeam);
            if (possible) least = std::min(least, cost(point, other));
            h = mesh_.cw_rotated_halfedge_handle(h);
        } while (h != first && ++count < kMostNeighbours);
        if (count >= kMostNeighbours) least = kNever;
    }
    if (least < kNever)
        queue_.set(point, static_cast<float>(least));
    else
        queue_.remove(point);
}

std::optional<Ring> Chain::ringOf(std::uint32_t point) const {
    Ring ring;
    ring.centre = point;
    // Counter-clockwise; an open one has its border's half-edge, which OpenMesh keeps first, at the end of that way
    ring.open = mesh_.is_boundary(vertex(point));
    HalfedgeHandle first = mesh_.halfedge_handle(vertex(point));
    if (ring.open) first = mesh_.cw_rotated_halfedge_handle(first);
    if (ring.open)
        while (!mesh_.is_boundary(mesh_.opposite_halfedge_handle(first)))
            first = mesh_.cw_rotated_halfedge_handle(first);
    HalfedgeHandle h = first;
    do {
        if (ring.count == kMostNeighbours) return std::nullopt;
        ring.point[ring.count] = indexOf(mesh_.to_vertex_handle(h));
        ring.face[ring.count++] = indexOf(mesh_.face_handle(h));
        if (mesh_.is_boundary(h)) break;
        h = mesh_.ccw_rotated_halfedge_handle(h);
    } while (h != first);
    if (ring.count < 3) return std::nullopt;
    return ring;
}

HalfedgeHandle Chain::halfedgeTo(const Ring& ring) const {
    HalfedgeHandle h = mesh_.halfedge_handle(vertex(ring.centre));
    while (indexOf(mesh_.to_vertex_handle(h)) != ring.point[0]) h = mesh_.cw_rotated_halfedge_handle(h);
    return h;
}

/// Of a border: whether it is straight there and no other primitive's.
bool Chain::mayTouch(const Ring& ring, const WedgeMove& move) const {
    const std::uint32_t target = ring.point[0];
    if (welded_.flags[target] & kUntouched) return false;
    if (!ring.open) return true;
    const std::uint32_t previous = ring.point[move.behind];
    if ((welded_.flags[target] | welded_.flags[previous]) & kFixed) return false;
    const glm::dvec3 p = at(ring.centre), a = at(previous), b = at(target);
    return glm::dot(a - p, b - p) < 0.0 && distanceFromSegment(p, a, b) <= kRounding * (reach_ + glm::distance(a, b));
}

/// Metres by which a seam's or border's line moves aside, or what is seen along it: texture coordinates count as many
/// metres as they are long.
double Chain::seamShift(const Ring& ring, const WedgeMove& move) const {
    if (move.count == 0) return 0.0;
    const glm::dvec3 from = at(ring.point[move.behind]), to = at(ring.point[0]);
    double shift = distanceFromSegment(at(ring.centre), from, to);
    const auto& vertices = request_.primitive.vertices;
    const auto& extras = request_.primitive.extras;
    for (std::size_t s = 0; s < move.count; ++s) {
        const WedgeMove::Side& side = move.sides[s];
        const auto add = [&](const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
            const double length = glm::distance(glm::dvec2(a), glm::dvec2(b));
            const double aside = distanceFromSegment(glm::dvec3(p, 0.0), glm::dvec3(a, 0.0), glm::dvec3(b, 0.0));
            if (aside > 0.0) shift = std::max(shift, aside * glm::distance(from, to) / std::max(length, 1e-30));
        };
        add(vertices[side.before].uv, vertices[side.previous].uv, vertices[side.after].uv);
        if (!extras.empty()) add(extras[side.before].uv, extras[side.previous].uv, extras[side.after].uv);
    }
    return shift;
}

/// Whether the new faces look where the normals of their vertices point, as the old ones did.
bool Chain::facesSource(const Ring& ring, const WedgeMove& move) const {
    const auto& vertices = request_.primitive.vertices;
    const glm::dvec3 centre = at(ring.centre), target = at(ring.point[0]);
    for (std::size_t i = 1; i + 1 < ring.count; ++i) {
        const WeldedFace& face = welded_.faces[ring.face[i]];
        const glm::dvec3 a = at(ring.point[i]), b = at(ring.point[i + 1]);
        const std::uint32_t before = wedgeAt(face, ring.centre);
        const glm::vec3 others =
            vertices[wedgeAt(face, ring.point[i])].normal + vertices[wedgeAt(face, ring.point[i + 1])].normal;
        const double side = ring.mirrored ? -1.0 : 1.0;
        const auto looks = [&](const glm::dvec3& p, std::uint32_t wedge) {
            return side * glm::dot(glm::cross(a - p, b - p), glm::dvec3(others + vertices[wedge].normal));
        };
        if (!(looks(target, move.after(before)) > 0.0) && looks(centre, before) > 0.0) return false;
    }
    return true;
}

std::size_t Chain::neighbours(std::uint32_t point, std::size_t limit) const {
    const HalfedgeHandle first = mesh_.halfedge_handle(vertex(point));
    HalfedgeHandle h = first;
    std::size_t count = 0;
    do {
        ++count;
        h = mesh_.cw_rotated_halfedge_handle(h);
    } while (h != first && count < limit);
    return count;
}

bool Chain::staysManifold(const Ring& ring, HalfedgeHandle along) {
    // Before OpenMesh's test, which would go around all of them
    const std::size_t around = neighbours(ring.point[0], kMostNeighbours + 1);
    if (around > kMostNeighbours || around + ring.count > kMostNeighbours + 4) return false;
    if (!mesh_.is_collapse_ok(along)) return false;
    // With three faces around one of the two that lose one, two would remain, back to back
    const auto wouldFold = [&](std::uint32_t point) {
        return !mesh_.is_boundary(vertex(point)) && neighbours(point, 4) == 3;
    };
    return !wouldFold(ring.point[1]) && (ring.open || !wouldFold(ring.point[ring.count - 1]));
}

/// Of the new faces.
Chain::FaceErrors Chain::errorsAfter(const Ring& ring, const FanChange& change, double shift) const {
    FaceErrors before;
    for (std::size_t i = 0; i < ring.faces(); ++i) before[i] = error_[ring.face[i]] + static_cast<float>(shift);
    return change.errors(before);
}

void Chain::collapse(const Ring& ring, const WedgeMove& move, const FaceErrors& errors, HalfedgeHandle along) {
    for (std::size_t i = 1; i + 1 < ring.count; ++i) {
        WeldedFace& face = welded_.faces[ring.face[i]];
        error_[ring.face[i]] = errors[i];
        const std::size_t k = face.point[0] == ring.centre ? 0 : face.point[1] == ring.centre ? 1 : 2;
        face.point[k] = ring.point[0];
        face.wedge[k] = move.after(face.wedge[k]);
    }
    mesh_.collapse(along);
    alive_ -= ring.open ? 1 : 2;
    const std::uint32_t target = ring.point[0];
    quadrics_[target] += quadrics_[ring.centre];
    own_[target] = static_cast<float>(valueAt(quadrics_[target], at(target)));
    for (std::size_t i = 0; i < ring.count; ++i) {
        needs_[ring.point[i]] = 0.0f;
        enqueue(ring.point[i]);
    }
}

/// Removes the vertex that is next, or sets it back to where it belongs; false where it cannot go.
bool Chain::tryNext() {
    const std::uint32_t point = queue_.cheapest();
    queue_.remove(point);
    const float limit = queue_.empty() ? kNever : queue_.leastCost();
    const std::optional<Ring> ring = ringOf(point);
    if (!ring) return false;
    struct Way {
        double cost;
        std::size_t neighbour;
    };
    std::array<Way, kMostNeighbours> ways;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ring->count; ++i)
        if (!ring->open || i == 0 || i + 1 == ring->count) ways[count++] = {cost(point, ring->point[i]), i};
    std::sort(ways.begin(), ways.begin() + count, [](const Way& a, const Way& b) { return a.cost < b.cost; });
    Fan fan;
    int excesses = 0;
    needs_[point] = kNever;
    for (std::size_t w = 0; w < count; ++w) {
        const Ring turned = ring->startingAt(ways[w].neighbour);
        const auto move = wedgeMove(turned, welded_.faces);
        if (!move || !mayTouch(turned, *move)) continue;
        const double shift = seamShift(turned, *move);
        const double way = glm::distance(at(point), at(turned.point[0]));
        const double total = ways[w].cost + shift * shift * way * way;
        if (static_cast<float>(total) > kMuchMore * limit) {
            needs_[point] = 0.0f;
            queue_.set(point, static_cast<float>(total));
            return true;
        }
        fan.count = turned.count;
        fan.open = turned.open;
        for (std::size_t i = 0; i < turned.count; ++i) fan.ring[i] = at(turned.point[i]) - at(point);
        const FanChange change(fan);
        if (!change.sound() || !facesSource(turned, *move)) continue;
        const FaceErrors errors = errorsAfter(turned, change, shift);
        const float most = *std::max_element(errors.begin() + 1, errors.begin() + turned.count - 1);
        if (most > cap_) {
            needs_[point] = std::min(needs_[point], most);
            if (++excesses == kMostExcesses) break;
            continue;
        }
        const HalfedgeHandle along = halfedgeTo(turned);
        if (!staysManifold(turned, along)) continue;
        collapse(turned, *move, errors, along);
        return true;
    }
    return false;
}

/// In rounds, each with a higher cap, lest a few places take errors that the rest of the level does not need.
void Chain::decimate(std::size_t target) {
    do {
        for (const std::uint32_t p : points_)
            if (needs_[p] <= cap_) enqueue(p);
        for (std::size_t steps = 0; alive_ > target && !queue_.empty(); ++steps) {
            if (steps % 256 == 0 && request_.stopped()) return;
            tryNext();
        }
        std::erase_if(points_, [&](std::uint32_t p) { return isGone(p); });
    } while (alive_ > target && raiseCap((alive_ - target) / 2));
}

/// To what some of these vertices more, to be removed, need; false where no cap up to mostError_ helps.
bool Chain::raiseCap(std::size_t vertices) {
    std::vector<float> needs;
    for (const std::uint32_t p : points_)
        if (needs_[p] > cap_ && needs_[p] <= mostError_ && needs_[p] < kNever) needs.push_back(needs_[p]);
    if (needs.empty()) return false;
    // Some will be in each other's way, others find one once their neighbours are gone
    const auto enough = needs.begin() + static_cast<std::ptrdiff_t>(std::min(needs.size() - 1, vertices));
    std::nth_element(needs.begin(), enough, needs.end());
    cap_ = std::min(std::max(cap_ * kLeastCapGrowth, *enough), mostError_);
    return true;
}

/// A guess at the first cap, of a sample: most of a level is made with its first cap, and what is beyond is tried in
/// vain.
void Chain::startCap() {
    const std::size_t step = std::max<std::size_t>(1, points_.size() / kSample);
    cap_ = 0.0f;
    // What is flat goes even so, but not more than the first level may lose
    const std::size_t enough = alive_ - alive_ / 8;
    for (std::size_t i = 0; i < points_.size() && alive_ > enough; i += step) {
        if (!isGone(points_[i])) enqueue(points_[i]);
        if (!queue_.empty()) tryNext();
    }
    std::erase_if(points_, [&](std::uint32_t p) { return isGone(p); });
    raiseCap(kSample / 3);
}

LodLevel Chain::currentLevel() const {
    LodLevel level;
    level.indices.reserve(3 * alive_);
    float most = 0.0f;
    for (std::size_t f = 0; f < welded_.faces.size(); ++f) {
        if (mesh_.status(FaceHandle(static_cast<int>(f))).deleted()) continue;
        level.indices.insert(level.indices.end(), welded_.faces[f].wedge.begin(), welded_.faces[f].wedge.end());
        most = std::max(most, error_[f]);
    }
    // Above what rounding, here and of the coordinates' differences, could have taken off
    level.error = most > 0.0f ? most * (1.0f + 1e-4f) + static_cast<float>(1e-7 * reach_) : 0.0f;
    return level;
}

}  // namespace

void simplify(const SimplifyRequest& request) {
    const double started = processorSeconds();
    if (request.primitive.triangleCount() <= kFewestTriangles) return;
    Chain(request).run(started);
}

}  // namespace dioptre
