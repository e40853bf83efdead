#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "frame/frame_maker.hpp"

namespace dioptre {

namespace {

constexpr double kFramedYfov = 0.8;  // radians, about 46 degrees

const Camera& findCamera(const Scene& scene, const std::string& nameOrIndex) {
    for (const Camera& camera : scene.cameras)
        if (camera.name == nameOrIndex) return camera;
    const auto index = parseInteger(nameOrIndex);
    if (index && *index >= 0 && static_cast<std::size_t>(*index) < scene.cameras.size())
        return scene.cameras[static_cast<std::size_t>(*index)];
    std::string known;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        known += fmt::format("{}{} {}", i ? ", " : "", i, quote(scene.cameras[i].name));
    throw InputError(fmt::format("--camera: {} is not in {}; it has {}", quote(nameOrIndex), scene.name,
                                 known.empty() ? "no camera" : known));
}

}  // namespace

Pose poseOf(const Camera& camera) {
    const glm::dmat4 m(camera.worldFromCamera);
    return {glm::dvec3(m[3]), glm::normalize(glm::quat_cast(glm::dmat3(m)))};
}

const Camera* startCamera(const Scene& scene, const ViewSettings& settings) {
    if (settings.pose || (scene.cameras.empty() && settings.camera.empty())) return nullptr;
    return settings.camera.empty() ? &scene.cameras.front() : &findCamera(scene, settings.camera);
}

View framedView(const Bounds& bounds, PictureSize size) {
    View view;
    view.width = size.width;
    view.height = size.height;
    const double aspect = static_cast<double>(size.width) / size.height;
    view.frustum = symmetricFrustum(Radians(kFramedYfov), aspect);
    if (bounds.empty()) return view;
    // The bounding sphere just inside the narrower field, seen from the front and a little above.
    const double radius = std::max(0.5 * glm::length(glm::dvec3(bounds.size())), 1e-6);
    const double half = std::atan(std::min(view.frustum.right, view.frustum.top));
    const double away = radius / std::sin(half);
    view.pose.orientation = glm::angleAxis(-0.2, glm::dvec3(1.0, 0.0, 0.0));
    view.pose.position = glm::dvec3(bounds.centre()) + view.pose.orientation * glm::dvec3(0.0, 0.0, away);
    view.near = Metres(std::max((away - radius) * 0.05, away * 1e-4));
    return view;
}

View startView(const Scene& scene, const ViewSettings& settings) {
    View view = framedView(scene.bounds, settings.size);
    if (!scene.cameras.empty() || !settings.camera.empty()) {
        const Camera& camera = settings.camera.empty() ? scene.cameras.front() : findCamera(scene, settings.camera);
        const double aspect = static_cast<double>(settings.size.width) / settings.size.height;
        view.frustum = symmetricFrustum(Radians(camera.yfovRadians), aspect);
        view.near = Metres(camera.nearMetres);
        view.pose = poseOf(camera);
    }
    if (settings.pose) {
        view.pose = poseOf(*settings.pose);
        // The framing's near plane is that of its own place.
        if (scene.cameras.empty()) view.near = View{}.near;
    }
    return view;
}

}  // namespace dioptre
