// What views see of the scene, and the commands that draw it.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "render/gpu_scene.hpp"
#include "render/scene_upload.hpp"
#include "shaders/shared/scene_types.h"

namespace dioptre {

namespace {

/// A bound of how much a map stretches any direction, exact without shear: by Gershgorin's circles no eigenvalue of
/// transpose(M) M is beyond its greatest sum of a row.
double mostStretch(const glm::dmat3& m) {
    const glm::dmat3 squared = glm::transpose(m) * m;
    double most = 0.0;
    for (glm::length_t i = 0; i < 3; ++i)
        most = std::max(most, std::abs(squared[i].x) + std::abs(squared[i].y) + std::abs(squared[i].z));
    return std::sqrt(most);
}

/// From the space of one pose to that of another that looks the same way: what is added to a place.
glm::dvec3 shiftBetween(const Pose& from, const Pose& to) {
    assert(from.orientation == to.orientation);
    return glm::conjugate(to.orientation) * (from.position - to.position);
}

ViewBox shifted(ViewBox box, const glm::dvec3& shift) {
    box.centre += shift;
    return box;
}

}  // namespace

ViewContents GpuScene::contents(const View& view) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    ViewContents seen;
    for (const Item& item : items_) {
        const ViewBox box = boxInView(viewFrom * item.worldFromMesh, item.bounds);
        if (!mayBeSeen(view, nullptr, box)) continue;
        const double near = std::max(view.near.value, box.nearest());
        const double far = std::max(near, box.farthest());
        seen.nearest = seen.anything ? std::max(seen.nearest, 1.0 / near) : 1.0 / near;
        seen.farthest = seen.anything ? std::min(seen.farthest, 1.0 / far) : 1.0 / far;
        seen.anything = true;
        seen.blended = seen.blended || item.state.blended;
    }
    return seen;
}

std::vector<std::uint64_t> GpuScene::triangles(const View& view, std::span<const double> detailPx) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    std::vector<std::uint64_t> sums(detailPx.size(), 0);
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const glm::dmat4 viewFromMesh = viewFrom * items_[i].worldFromMesh;
        const ViewBox box = boxInView(viewFromMesh, items_[i].bounds);
        if (!mayBeSeen(view, nullptr, box)) continue;
        const DrawList::Seen seen = seenItem(i, box, viewFromMesh);
        if (seen.triangles == 0) continue;
        const std::vector<IndexRange>& levels = levels_[items_[i].primitive].indices;
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += levels[static_cast<std::size_t>(levelWithin(view, seen, detailPx[k]))].count / 3;
    }
    return sums;
}

DrawList::Seen GpuScene::seenItem(std::size_t index, const ViewBox& box, const glm::dmat4& viewFromMesh) const {
    const Item& item = items_[index];
    const Levels& levels = levels_[item.primitive];
    const bool triangles = item.state.topology == Topology::triangles;
    return {static_cast<std::uint32_t>(index),
            box,
            item.state.blended,
            triangles ? levels.indices.front().count / 3 : 0,
            std::span(levels.errors).first(item.bent < 0 ? levels.errors.size() : 1),
            mostStretch(glm::dmat3(viewFromMesh))};
}

Sight GpuScene::inSight(std::span<const View> eyes, const Lens& lens) const {
    Sight sight{eyes.front().pose, {}};
    const glm::dmat4 viewFrom = viewFromWorld(sight.pose);
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const glm::dmat4 viewFromMesh = viewFrom * items_[i].worldFromMesh;
        const ViewBox box = boxInView(viewFromMesh, items_[i].bounds);
        const bool seen = std::any_of(eyes.begin(), eyes.end(), [&](const View& eye) {
            return mayBeSeen(eye, &lens, shifted(box, shiftBetween(sight.pose, eye.pose)));
        });
        if (seen) sight.items.push_back({seenItem(i, box, viewFromMesh), viewFromMesh});
    }
    return sight;
}

void GpuScene::see(DrawList& list, const View& view, const Lens* lens, const Sight* sight) const {
    const glm::dmat4 viewFrom = viewFromWorld(view.pose);
    // The matrices are made eye-relative in double precision.
    std::vector<glm::mat4> instances(items_.size());
    list.seen_.clear();
    list.blended_.clear();
    list.runs_.clear();
    list.blendedRuns_.clear();
    const auto add = [&](const DrawList::Seen& seen, const glm::dmat4& viewFromMesh) {
        instances[seen.item] = glm::mat4(viewFromMesh);
        list.seen_.push_back(seen);
    };
    if (sight) {
        const glm::dvec3 shift = shiftBetween(sight->pose, view.pose);
        for (Sight::Item item : sight->items) {
            item.seen.box = shifted(item.seen.box, shift);
            if (!mayBeSeen(view, lens, item.seen.box)) continue;
            item.viewFromMesh[3] += glm::dvec4(shift, 0.0);
            add(item.seen, item.viewFromMesh);
        }
    } else {
        for (std::size_t i = 0; i < items_.size(); ++i) {
            const glm::dmat4 viewFromMesh = viewFrom * items_[i].worldFromMesh;
            const ViewBox box = boxInView(viewFromMesh, items_[i].bounds);
            if (mayBeSeen(view, lens, box)) add(seenItem(i, box, viewFromMesh), viewFromMesh);
        }
    }
    sortFrontToBack(list);
    for (std::size_t i = 0; i < list.seen_.size(); ++i)
        if (list.seen_[i].blended) list.blended_.push_back(i);
    std::sort(list.blended_.begin(), list.blended_.end(), [&](std::size_t a, std::size_t b) {
        const DrawList::Seen &seenA = list.seen_[a], &seenB = list.seen_[b];
        if (seenA.box.centre.z != seenB.box.centre.z) return seenA.box.centre.z < seenB.box.centre.z;
        return seenA.item < seenB.item;
    });
    if (list.seen_.empty()) return;
    const auto fill = [](Buffer& buffer, const auto& data, const char* label) {
        const std::size_t bytes = data.size() * sizeof(data[0]);
        if (buffer.bytes() != bytes) buffer = Buffer(bytes, nullptr, true, label);
        buffer.update(data.data(), bytes);
    };
    fill(list.instances_, instances, "instances");
    std::vector<gpu::LightData> lights;
    lights.reserve(lights_.size());
    for (const Light& light : lights_) lights.push_back(lightInView(light, viewFrom));
    fill(list.lights_, lights, "lights");
    list.up_ = glm::vec3(viewFrom[1]);
}

// What is near hides the rest before it is shaded; within what one call draws, and call by call. Blended surfaces stay
// last.
void GpuScene::sortFrontToBack(DrawList& list) const {
    // Of the items of equal state; poses change which these are.
    std::map<State, double> nearest;
    for (const DrawList::Seen& seen : list.seen_) {
        const double distance = -seen.box.centre.z;
        const auto [entry, first] = nearest.emplace(items_[seen.item].state, distance);
        if (!first) entry->second = std::min(entry->second, distance);
    }
    struct Place {
        bool blended;
        double call;  // the nearest of its call
        State state;
        double distance;
        std::uint32_t item;

        auto operator<=>(const Place&) const = default;
    };
    const auto place = [&](const DrawList::Seen& seen) {
        const State& state = items_[seen.item].state;
        return Place{state.blended, nearest.at(state), state, -seen.box.centre.z, seen.item};
    };
    std::vector<std::pair<Place, DrawList::Seen>> sorted;
    sorted.reserve(list.seen_.size());
    for (const DrawList::Seen& seen : list.seen_) sorted.emplace_back(place(seen), seen);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return (a.first <=> b.first) < 0; });
    std::transform(sorted.begin(), sorted.end(), list.seen_.begin(), [](const auto& entry) { return entry.second; });
}

void GpuScene::arrange(DrawList& list, int matrices, std::span<const std::int8_t> levels) const {
    list.runs_.clear();
    list.blendedRuns_.clear();
    list.arranged_.clear();
    const auto levelOf = [&](std::size_t i) { return levels.empty() ? std::int8_t{0} : levels[i]; };
    for (std::size_t i = 0; i < list.seen_.size(); ++i)
        if (levelOf(i) >= 0) append(list, list.runs_, list.seen_[i], matrices, levelOf(i), Faces::asMaterial);
    // A blended item is drawn as what is opaque of it, then its back and its front.
    for (const std::size_t i : list.blended_) {
        if (levelOf(i) < 0) continue;
        const DrawList::Seen& seen = list.seen_[i];
        const State& state = items_[seen.item].state;
        const bool twice = materials_[state.material].doubleSided && state.topology == Topology::triangles;
        if (twice) append(list, list.blendedRuns_, seen, matrices, levelOf(i), Faces::back);
        append(list, list.blendedRuns_, seen, matrices, levelOf(i), twice ? Faces::front : Faces::asMaterial);
    }
    if (list.arranged_.empty()) return;
    const std::size_t bytes = list.arranged_.size() * sizeof(DrawList::Command);
    // Room for all items, so that another arrangement of the same ones needs no other buffer.
    const std::size_t room = (list.seen_.size() + 2 * list.blended_.size()) * sizeof(DrawList::Command);
    if (list.commands_.bytes() < room) list.commands_ = Buffer(room, nullptr, true, "draw commands");
    list.commands_.update(list.arranged_.data(), bytes);
}

void GpuScene::append(DrawList& list, std::vector<Run>& runs, const DrawList::Seen& seen, int matrices, int level,
                      Faces faces) const {
    const Item& item = items_[seen.item];
    if (runs.empty() || runs.back().state != item.state || runs.back().faces != faces)
        runs.push_back({item.state, faces, list.arranged_.size()});
    const IndexRange& range = levels_[item.primitive].indices[static_cast<std::size_t>(level)];
    Run& run = runs.back();
    ++run.commandCount;
    if (item.state.topology == Topology::triangles)
        run.triangles += range.count / 3 * static_cast<std::uint64_t>(matrices);
    list.arranged_.push_back({range.count, static_cast<GLuint>(matrices), range.first,
                              static_cast<GLint>(item.baseVertex), static_cast<GLuint>(seen.item)});
}

}  // namespace dioptre
