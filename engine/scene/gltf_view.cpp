#include "scene/gltf_view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dioptre::gltf {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float requiredPositive(const Element& owner, std::string_view key) {
    const auto value = owner.number(key);
    if (!value) owner.fail(key, "is missing");
    if (!(*value > 0.0f)) owner.fail(key, fmt::format("is {}, must be above 0", *value));
    return *value;
}

void readCones(const Element& spot, Light& light) {
    const float inner = spot.number("innerConeAngle", 0.0f), outer = spot.number("outerConeAngle", kPi / 4.0f);
    constexpr float kRounding = 1e-5f;  // a right angle printed in decimals
    if (!(outer > 0.0f && outer <= kPi / 2.0f + kRounding))
        spot.fail("outerConeAngle", fmt::format("is {} rad, must be above 0 and at most pi/2", outer));
    if (!(inner >= 0.0f && inner <= outer))
        spot.fail("innerConeAngle", fmt::format("is {} rad, must be 0 to outerConeAngle ({})", inner, outer));
    light.innerConeCos = std::cos(inner);
    light.outerConeCos = std::max(std::cos(outer), 0.0f);
}

}  // namespace

std::vector<std::optional<Camera>> readCameras(const Element& root) {
    std::vector<std::optional<Camera>> cameras;
    const List list = root.list("cameras");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Element element = list[i];
        const std::string type = element.text("type").value_or("");
        if (type == "orthographic") {
            element.warn("orthographic cameras are ignored");
            cameras.emplace_back();
            continue;
        }
        if (type != "perspective")
            element.fail("type", fmt::format("is \"{}\", must be perspective or orthographic", printable(type)));
        const Element perspective = element.object("perspective");
        Camera camera;
        camera.name = element.text("name").value_or("");
        camera.yfovRadians = requiredPositive(perspective, "yfov");
        if (camera.yfovRadians >= kPi)
            perspective.fail("yfov", fmt::format("is {} rad, must be below pi", camera.yfovRadians));
        camera.nearMetres = requiredPositive(perspective, "znear");
        if (const auto zfar = perspective.number("zfar"); zfar && *zfar <= camera.nearMetres)
            perspective.fail("zfar", fmt::format("is {}, must be above znear ({})", *zfar, camera.nearMetres));
        if (perspective.has("aspectRatio")) requiredPositive(perspective, "aspectRatio");
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

std::vector<Light> readLights(const Element& root) {
    std::vector<Light> lights;
    const auto extension = root.extension("KHR_lights_punctual");
    if (!extension) return lights;
    const List list = extension->list("lights");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Element element = list[i];
        Light light;
        light.name = element.text("name").value_or("");
        const std::string type = element.text("type").value_or("");
        if (type == "directional")
            light.kind = LightKind::directional;
        else if (type == "point")
            light.kind = LightKind::point;
        else if (type == "spot")
            light.kind = LightKind::spot;
        else
            element.fail("type", fmt::format("is \"{}\", must be directional, point or spot", printable(type)));
        const float intensity = element.number("intensity", 1.0f);
        if (intensity < 0.0f) element.fail("intensity", fmt::format("is {}, must not be negative", intensity));
        const std::vector<float> color = element.numbers("color", 3);
        for (int c = 0; c < 3; ++c) {
            const float channel = color.empty() ? 1.0f : color[static_cast<std::size_t>(c)];
            if (channel < 0.0f) element.fail("color", fmt::format("has {}, must not be negative", channel));
            light.color[c] = channel * intensity;
            if (!std::isfinite(light.color[c]))
                element.fail("intensity", fmt::format("is {}, too much for a float", intensity));
        }
        if (element.has("range")) light.range = requiredPositive(element, "range");
        if (light.kind == LightKind::spot) readCones(element.object("spot"), light);
        lights.push_back(std::move(light));
    }
    return lights;
}

}  // namespace dioptre::gltf
