#include "render/draw_list.hpp"

#include <algorithm>
#include <cmath>

namespace dioptre {

ViewBox boxInView(const glm::dmat4& viewFromMesh, const Bounds& bounds) {
    const glm::dvec3 half = glm::dvec3(bounds.size()) * 0.5;
    const glm::dmat3 r(viewFromMesh);
    return {glm::dvec3(viewFromMesh * glm::dvec4(glm::dvec3(bounds.centre()), 1.0)),
            glm::abs(r[0]) * half.x + glm::abs(r[1]) * half.y + glm::abs(r[2]) * half.z};
}

bool mayBeSeen(const View& view, const Lens* lens, const ViewBox& box) {
    const Frustum& f = view.frustum;
    // A point of the lens moves what it sees sideways by up to E |Df d - 1|. The frustum is in tangents at unit
    // distance, looking along -z.
    double blur = 0.0;
    if (lens)
        for (const double d : {box.nearest(), box.farthest()})
            blur = std::max(blur, lens->apertureRadius.value * std::abs(lens->focus.value * d - 1.0));
    const glm::dvec3 half = box.half + glm::dvec3(blur, blur, 0.0);
    const glm::dvec3 inward[] = {{1.0, 0.0, f.left}, {-1.0, 0.0, -f.right}, {0.0, 1.0, f.bottom}, {0.0, -1.0, -f.top}};
    for (const glm::dvec3& n : inward)
        if (glm::dot(n, box.centre) + glm::dot(glm::abs(n), half) < 0.0) return false;
    return box.farthest() >= view.near.value;
}

double levelOfError(std::span<const float> errors, double allowed) {
    for (std::size_t i = 1; i < errors.size(); ++i) {
        const double finer = static_cast<double>(errors[i - 1]), coarser = static_cast<double>(errors[i]);
        if (coarser > allowed) return static_cast<double>(i - 1) + std::max(0.0, allowed - finer) / (coarser - finer);
    }
    return static_cast<double>(errors.size() - 1);
}

double levelWithin(const View& view, const DrawList::Seen& seen, double pixels) {
    if (!(pixels > 0.0)) return 0.0;
    const double pixelsPerMetre =
        seen.scale * focalLengthPixels(view).x / std::max(view.near.value, seen.box.nearest());
    return levelOfError(seen.errors, pixels / pixelsPerMetre);
}

}  // namespace dioptre
