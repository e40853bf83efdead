#include "scene/gltf_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace dioptre::gltf {
namespace {

std::string_view nameOf(AnimatedProperty property) {
    switch (property) {
        case AnimatedProperty::translation:
            return "translation";
        case AnimatedProperty::rotation:
            return "rotation";
        case AnimatedProperty::scale:
            return "scale";
        case AnimatedProperty::weights:
            return "weights";
    }
    return "";
}

// None: one that an extension defines.
std::optional<AnimatedProperty> readPath(const Element& target) {
    const std::string path = target.text("path").value_or("");
    for (const auto property : {AnimatedProperty::translation, AnimatedProperty::rotation, AnimatedProperty::scale,
                                AnimatedProperty::weights})
        if (path == nameOf(property)) return property;
    if (path == "pointer") return std::nullopt;
    target.fail("path", fmt::format("is \"{}\", must be translation, rotation, scale or weights", printable(path)));
}

Interpolation readInterpolation(const Element& sampler) {
    const std::string name = sampler.text("interpolation").value_or("LINEAR");
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    sampler.fail("interpolation", fmt::format("is \"{}\", must be STEP, LINEAR or CUBICSPLINE", printable(name)));
}

std::string shown(const Accessor& a) {
    return fmt::format("{}{} {}", a.normalized ? "normalized " : "", nameOf(a.component), a.type);
}

/// One animation.
class Reader {
  public:
    Reader(const Element& animation, const Accessors& accessors, const std::vector<std::size_t>& targetCounts)
        : element_(animation),
          samplers_(animation.list("samplers")),
          nodes_(targetCounts),
          accessors_(accessors),
          curveOf_(samplers_.size()) {}

    Animation read(const List& fileNodes) {
        Animation animation;
        animation.name = element_.text("name").value_or("");
        for (std::size_t i = 0; i < samplers_.size(); ++i) checkSampler(samplers_[i]);
        const List channels = element_.list("channels");
        for (std::size_t i = 0; i < channels.size(); ++i) readChannel(channels[i], fileNodes, animation);
        return animation;
    }

  private:
    const Accessor& accessorOf(const Element& sampler, std::string_view key) const {
        return accessors_.use(sampler.requiredIndex(key, accessors_.size(), "accessors"), sampler.pathOf(key));
    }

    void checkSampler(const Element& sampler) const {
        readInterpolation(sampler);
        const Accessor& input = accessorOf(sampler, "input");
        if (input.type != "SCALAR" || input.component != ComponentType::floating)
            sampler.fail("input", fmt::format("is {}, must be FLOAT SCALAR", shown(input)));
        accessorOf(sampler, "output");
    }

    void readChannel(const Element& channel, const List& fileNodes, Animation& animation) {
        const std::size_t sampler = channel.requiredIndex("sampler", samplers_.size(), "samplers");
        const Element target = channel.object("target");
        const auto property = readPath(target);
        const auto node = target.index("node", nodes_.size(), "nodes");
        if (!property || !node) return target.warn("aims at no node: ignored");
        if (!aims_.emplace(*node, *property).second)
            target.fail("path", fmt::format("node {} has its {} driven by another channel of this animation", *node,
                                            nameOf(*property)));
        if (*property == AnimatedProperty::weights && nodes_[*node] == 0)
            target.fail("path", fmt::format("is \"weights\", but the mesh of node {} has no targets", *node));
        if (*property != AnimatedProperty::weights && fileNodes[*node].has("matrix"))
            target.fail("node", fmt::format("node {} has a matrix, its {} cannot be driven", *node, nameOf(*property)));
        const std::size_t components = *property == AnimatedProperty::weights    ? nodes_[*node]
                                       : *property == AnimatedProperty::rotation ? 4
                                                                                 : 3;
        animation.channels.push_back({*node, curve(sampler, *property, components, animation), *property});
    }

    // A sampler that drives several nodes is read once; it must fit each of them.
    std::size_t curve(std::size_t number, AnimatedProperty property, std::size_t components, Animation& animation) {
        const Element sampler = samplers_[number];
        const Accessor& input = accessorOf(sampler, "input");
        const Accessor& output = accessorOf(sampler, "output");
        checkOutput(sampler, output, property);
        const Interpolation interpolation = readInterpolation(sampler);
        const std::uint64_t perKey = (interpolation == Interpolation::cubicSpline ? 3 : 1) *
                                     (property == AnimatedProperty::weights ? components : 1);
        if (output.count / perKey != input.count || output.count % perKey != 0)
            sampler.fail("output", fmt::format("has {} elements, but {} for each of {} keys are needed", output.count,
                                               perKey, input.count));
        if (!curveOf_[number]) {
            curveOf_[number] = animation.curves.size();
            animation.curves.push_back(readCurve(sampler, interpolation, components));
            if (property == AnimatedProperty::rotation) checkRotations(sampler, animation.curves.back());
        }
        return *curveOf_[number];
    }

    static void checkOutput(const Element& sampler, const Accessor& output, AnimatedProperty property) {
        const bool plainOnly = property == AnimatedProperty::translation || property == AnimatedProperty::scale;
        const std::string_view type = plainOnly ? "VEC3" : property == AnimatedProperty::rotation ? "VEC4" : "SCALAR";
        const bool normalized = output.normalized && output.component != ComponentType::unsignedInt && !plainOnly;
        if (output.type != type || (output.component != ComponentType::floating && !normalized))
            sampler.fail("output", fmt::format("is {}, for {} it must be FLOAT {}{}", shown(output), nameOf(property),
                                               type, plainOnly ? "" : " or normalized integers"));
    }

    Curve readCurve(const Element& sampler, Interpolation interpolation, std::size_t components) const {
        const std::size_t input = sampler.requiredIndex("input", accessors_.size(), "accessors"),
                          output = sampler.requiredIndex("output", accessors_.size(), "accessors");
        const std::size_t keys = static_cast<std::size_t>(accessors_.use(input, "").count);
        const std::size_t values = keys * components * (interpolation == Interpolation::cubicSpline ? 3 : 1);
        element_.context().charge((keys + values) * sizeof(float), sampler.path());
        Curve curve{interpolation, components, std::vector<float>(keys), std::vector<float>(values)};
        accessors_.readFloats(input, sampler.pathOf("input"), curve.times.data(), 1);
        const std::size_t perElement = static_cast<std::size_t>(accessors_.use(output, "").components);
        accessors_.readFloats(output, sampler.pathOf("output"), curve.values.data(), perElement);
        for (std::size_t i = 0; i < keys; ++i) {
            const float time = curve.times[i];
            if (!(time >= 0.0f && std::isfinite(time)))
                sampler.fail("input", fmt::format("key {} is {} s, must be finite and not negative", i, time));
            if (i > 0 && !(time > curve.times[i - 1]))
                sampler.fail("input", fmt::format("key {} is {} s after {} s, times must increase", i, time,
                                                  curve.times[i - 1]));
        }
        for (std::size_t i = 0; i < values; ++i)
            if (!std::isfinite(curve.values[i]))
                sampler.fail("output",
                             fmt::format("element {} is {}, must be finite", i / perElement, curve.values[i]));
        return curve;
    }

    static void checkRotations(const Element& sampler, const Curve& curve) {
        // Of normalised bytes: half a step of each of the four components.
        constexpr double kTolerance = 0.01;
        const bool spline = curve.interpolation == Interpolation::cubicSpline;
        for (std::size_t key = 0; key < curve.times.size(); ++key) {
            const std::size_t element = spline ? key * 3 + 1 : key;
            const float* q = &curve.values[element * 4];
            const double length = glm::length(glm::dvec4(q[0], q[1], q[2], q[3]));
            if (!(length > 0.0))
                sampler.fail("output", fmt::format("element {} is 0 0 0 0, must be a unit quaternion", element));
            if (std::abs(length - 1.0) > kTolerance)
                return sampler.warn("output", "has rotations that are not of unit length: normalised");
        }
    }

    Element element_;
    List samplers_;
    const std::vector<std::size_t>& nodes_;  // how many targets each has
    const Accessors& accessors_;
    std::vector<std::optional<std::size_t>> curveOf_;  // of each sampler
    std::set<std::pair<std::size_t, AnimatedProperty>> aims_;
};

}  // namespace

std::vector<Animation> readAnimations(const Element& root, const Accessors& accessors,
                                      const std::vector<std::size_t>& targetCounts) {
    std::vector<Animation> animations;
    std::set<std::pair<std::size_t, AnimatedProperty>> driven;
    const List list = root.list("animations"), nodes = root.list("nodes");
    for (std::size_t i = 0; i < list.size(); ++i) {
        Animation animation = Reader(list[i], accessors, targetCounts).read(nodes);
        if (animation.channels.empty()) continue;
        for (const Channel& channel : animation.channels)
            if (!driven.emplace(channel.node, channel.property).second)
                list[i].warn("drives what another animation drives, too: the later one is drawn");
        animations.push_back(std::move(animation));
    }
    return animations;
}

}  // namespace dioptre::gltf
