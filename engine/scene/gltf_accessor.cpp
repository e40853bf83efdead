#include "scene/gltf_accessor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "scene/gltf_uri.hpp"

namespace dioptre::gltf {
namespace {

std::optional<ComponentType> componentType(std::uint64_t code) {
    if (code < 5120 || code > 5126 || code == 5124) return std::nullopt;  // 5124, INT, is not in glTF
    return static_cast<ComponentType>(code);
}

ComponentType readComponentType(const Element& owner) {
    const std::uint64_t code = owner.requiredWhole("componentType");
    const auto type = componentType(code);
    if (!type) owner.fail("componentType", fmt::format("is {}, must be 5120 to 5123, 5125 or 5126", code));
    return *type;
}

struct Shape {
    std::uint64_t columns = 1, rows = 1;
};

std::optional<Shape> shapeOf(std::string_view type) {
    if (type == "SCALAR") return Shape{1, 1};
    if (type == "VEC2") return Shape{1, 2};
    if (type == "VEC3") return Shape{1, 3};
    if (type == "VEC4") return Shape{1, 4};
    if (type == "MAT2") return Shape{2, 2};
    if (type == "MAT3") return Shape{3, 3};
    if (type == "MAT4") return Shape{4, 4};
    return std::nullopt;
}

template <typename In, typename Out>
Out converted(In value, bool normalized) {
    if constexpr (std::is_floating_point_v<In> || std::is_integral_v<Out>) {
        return static_cast<Out>(value);
    } else {
        // glTF 2.0, 3.6.2.2: f = max(c / 127, -1) and the like.
        constexpr auto kLargest = static_cast<Out>(std::numeric_limits<In>::max());
        const auto plain = static_cast<Out>(value);
        return normalized ? std::max(plain / kLargest, Out(-1)) : plain;
    }
}

struct Source {
    const std::uint8_t* data;
    std::uint64_t count, stride, components;
    bool normalized;
};

template <typename Out>
struct Target {
    Out* first;
    std::size_t step;
    std::span<const std::uint32_t> places = {};  // element i goes to the place places[i], or i without any
};

template <typename In, std::size_t kComponents, typename Out>
void copyElements(const Source& from, const Target<Out>& to) {
    for (std::uint64_t i = 0; i < from.count; ++i) {
        Out* out = to.first + (to.places.empty() ? i : to.places[i]) * to.step;
        const std::uint8_t* data = from.data + i * from.stride;
        for (std::size_t c = 0; c < (kComponents ? kComponents : from.components); ++c) {
            In value;
            std::memcpy(&value, data + c * sizeof(In), sizeof(In));
            out[c] = converted<In, Out>(value, from.normalized);
        }
    }
}

// The common counts as constants, so that the compiler unrolls them.
template <typename In, typename Out>
void copyTyped(const Source& from, const Target<Out>& to) {
    switch (from.components) {
        case 1:
            if constexpr (std::is_same_v<In, Out>) {
                if (from.stride == sizeof(In) && to.step == 1 && to.places.empty()) {
                    std::memcpy(to.first, from.data, static_cast<std::size_t>(from.count) * sizeof(In));
                    return;
                }
            }
            return copyElements<In, 1>(from, to);
        case 2:
            return copyElements<In, 2>(from, to);
        case 3:
            return copyElements<In, 3>(from, to);
        case 4:
            return copyElements<In, 4>(from, to);
        default:
            return copyElements<In, 0>(from, to);
    }
}

template <typename Out>
void copy(ComponentType type, const Source& from, const Target<Out>& to) {
    switch (type) {
        case ComponentType::byte:
            return copyTyped<std::int8_t>(from, to);
        case ComponentType::unsignedByte:
            return copyTyped<std::uint8_t>(from, to);
        case ComponentType::shortInt:
            return copyTyped<std::int16_t>(from, to);
        case ComponentType::unsignedShort:
            return copyTyped<std::uint16_t>(from, to);
        case ComponentType::unsignedInt:
            return copyTyped<std::uint32_t>(from, to);
        case ComponentType::floating: {
            if constexpr (std::is_floating_point_v<Out>) copyTyped<float>(from, to);
            return;  // indices are never floats: checked by who uses them
        }
    }
}

}  // namespace

std::size_t sizeOf(ComponentType type) {
    switch (type) {
        case ComponentType::byte:
        case ComponentType::unsignedByte:
            return 1;
        case ComponentType::shortInt:
        case ComponentType::unsignedShort:
            return 2;
        default:
            return 4;
    }
}

std::string_view nameOf(ComponentType type) {
    switch (type) {
        case ComponentType::byte:
            return "BYTE";
        case ComponentType::unsignedByte:
            return "UNSIGNED_BYTE";
        case ComponentType::shortInt:
            return "SHORT";
        case ComponentType::unsignedShort:
            return "UNSIGNED_SHORT";
        case ComponentType::unsignedInt:
            return "UNSIGNED_INT";
        default:
            return "FLOAT";
    }
}

Accessors::Accessors(const Element& root, std::optional<std::span<const std::uint8_t>> binaryChunk)
    : context_(root.context()) {
    readBuffers(root.list("buffers"), binaryChunk);
    readViews(root.list("bufferViews"));
    readAccessors(root.list("accessors"));
}

void Accessors::readBuffers(const List& buffers, std::optional<std::span<const std::uint8_t>> binaryChunk) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const Element buffer = buffers[i];
        const std::uint64_t length = buffer.requiredWhole("byteLength");
        std::span<const std::uint8_t> data;
        if (!buffer.has("uri") && i == 0 && binaryChunk) {
            data = *binaryChunk;
        } else if (!buffer.has("uri")) {
            buffer.fail("uri", "is missing, and there is no GLB binary chunk for it");
        } else {
            data = ownBuffers_.emplace_back(readUri(buffer));
        }
        if (data.size() < length)
            buffer.fail("byteLength", fmt::format("is {}, but its data has {} bytes", length, data.size()));
        buffers_.push_back(data.first(static_cast<std::size_t>(length)));
    }
}

void Accessors::readViews(const List& views) {
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Element element = views[i];
        View view;
        view.buffer = element.requiredIndex("buffer", buffers_.size(), "buffers");
        view.byteOffset = element.whole("byteOffset", 0);
        view.byteLength = element.requiredWhole("byteLength");
        view.stride = element.whole("byteStride", 0);
        if (view.stride != 0 && (view.stride < 4 || view.stride > 252))
            element.fail("byteStride", fmt::format("is {}, must be 4 to 252", view.stride));
        const std::uint64_t end = view.byteOffset + view.byteLength, size = buffers_[view.buffer].size();
        if (end > size)
            element.fail(fmt::format("reaches {} bytes past buffer {} ({} bytes)", end - size, view.buffer, size));
        views_.push_back(view);
    }
}

void Accessors::readAccessors(const List& accessors) {
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const Element element = accessors[i];
        Accessor accessor;
        accessor.view = element.index("bufferView", views_.size(), "bufferViews");
        accessor.byteOffset = element.whole("byteOffset", 0);
        accessor.count = element.requiredWhole("count");
        if (accessor.count == 0) element.fail("count", "is 0, must be at least 1");
        accessor.component = readComponentType(element);
        accessor.normalized = element.flag("normalized", false);
        accessor.type = element.text("type").value_or("");
        const auto shape = shapeOf(accessor.type);
        if (!shape)
            element.fail("type", fmt::format("is \"{}\", must be SCALAR, VEC2 to VEC4 or MAT2 to MAT4",
                                             printable(accessor.type)));
        accessor.components = shape->columns * shape->rows;
        // Matrix columns start at multiples of 4 bytes (glTF 2.0, 3.6.2.4).
        std::uint64_t columnBytes = shape->rows * sizeOf(accessor.component);
        if (shape->columns > 1) columnBytes = (columnBytes + 3) / 4 * 4;
        accessor.elementBytes = shape->columns * columnBytes;
        accessor.min = element.numbers("min", accessor.components);
        accessor.max = element.numbers("max", accessor.components);
        if (const auto sparse = element.find("sparse")) {
            const Element indices = sparse->object("indices"), values = sparse->object("values");
            Sparse& s = accessor.sparse.emplace();
            s.count = sparse->requiredWhole("count");
            if (s.count == 0 || s.count > accessor.count)
                sparse->fail("count", fmt::format("is {}, must be 1 to {}", s.count, accessor.count));
            s.indexView = indices.requiredIndex("bufferView", views_.size(), "bufferViews");
            s.indexOffset = indices.whole("byteOffset", 0);
            s.indexComponent = readComponentType(indices);
            if (s.indexComponent != ComponentType::unsignedByte && s.indexComponent != ComponentType::unsignedShort &&
                s.indexComponent != ComponentType::unsignedInt)
                indices.fail("componentType", fmt::format("is {}, must be unsigned", nameOf(s.indexComponent)));
            s.valueView = values.requiredIndex("bufferView", views_.size(), "bufferViews");
            s.valueOffset = values.whole("byteOffset", 0);
        }
        accessors_.push_back(std::move(accessor));
    }
}

std::span<const std::uint8_t> Accessors::viewBytes(std::size_t view) const {
    const View& v = views_[view];
    return buffers_[v.buffer].subspan(static_cast<std::size_t>(v.byteOffset), static_cast<std::size_t>(v.byteLength));
}

std::string Accessors::viewProblem(std::size_t view, std::uint64_t offset, std::uint64_t length,
                                   ComponentType type) const {
    const View& v = views_[view];
    if (const std::uint64_t end = offset + length; end > v.byteLength)
        return fmt::format("reads {} bytes past bufferView {} ({} bytes)", end - v.byteLength, view, v.byteLength);
    const std::uint64_t start = v.byteOffset + offset;
    if (start % sizeOf(type) != 0)
        return fmt::format("starts at byte {}, not a multiple of its components' {} bytes", start, sizeOf(type));
    return {};
}

// No sum or product here overflows: whole numbers are at most 2^53, strides at most 252.
std::string Accessors::problemOf(const Accessor& a) const {
    if (a.view) {
        const std::uint64_t stride = views_[*a.view].stride;
        if (stride != 0 && stride < a.elementBytes)
            return fmt::format("has elements of {} bytes, but bufferView {} a stride of {}", a.elementBytes, *a.view,
                               stride);
        if (stride % sizeOf(a.component) != 0)
            return fmt::format("has components of {} bytes, but bufferView {} a stride of {}", sizeOf(a.component),
                               *a.view, stride);
        const std::uint64_t length = (a.count - 1) * (stride ? stride : a.elementBytes) + a.elementBytes;
        if (auto problem = viewProblem(*a.view, a.byteOffset, length, a.component); !problem.empty()) return problem;
    }
    if (a.sparse) {
        const Sparse& s = *a.sparse;
        auto problem = viewProblem(s.indexView, s.indexOffset, s.count * sizeOf(s.indexComponent), s.indexComponent);
        if (!problem.empty()) return "sparse.indices " + problem;
        problem = viewProblem(s.valueView, s.valueOffset, s.count * a.elementBytes, a.component);
        if (!problem.empty()) return "sparse.values " + problem;
    }
    return {};
}

const Accessor& Accessors::use(std::size_t accessor, std::string_view where) const {
    const std::string problem = problemOf(accessors_[accessor]);
    if (!problem.empty()) context_.fail(where, fmt::format("accessor {} {}", accessor, problem));
    return accessors_[accessor];
}

void Accessors::checkAll() const {
    for (std::size_t i = 0; i < accessors_.size(); ++i)
        if (const std::string problem = problemOf(accessors_[i]); !problem.empty())
            context_.fail(fmt::format("accessors[{}]", i), problem);
}

std::vector<std::uint32_t> Accessors::sparseIndices(const Accessor& a, std::size_t number,
                                                    std::string_view where) const {
    const Sparse& s = *a.sparse;
    std::vector<std::uint32_t> places(static_cast<std::size_t>(s.count));
    const std::uint8_t* data = viewBytes(s.indexView).data() + s.indexOffset;
    copy(s.indexComponent, {data, s.count, sizeOf(s.indexComponent), 1, false},
         Target<std::uint32_t>{places.data(), 1});
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] >= a.count)
            context_.fail(where, fmt::format("accessor {} sparse index {} is {}, but it has {} elements", number, i,
                                             places[i], a.count));
        if (i > 0 && places[i] <= places[i - 1])
            context_.fail(where, fmt::format("accessor {} sparse index {} is {} after {}, they must increase", number,
                                             i, places[i], places[i - 1]));
    }
    return places;
}

template <typename Out>
void Accessors::read(std::size_t number, std::string_view where, Out* first, std::size_t step) const {
    const Accessor& a = use(number, where);
    if (a.view) {
        const std::uint64_t stride = views_[*a.view].stride ? views_[*a.view].stride : a.elementBytes;
        copy(a.component, {viewBytes(*a.view).data() + a.byteOffset, a.count, stride, a.components, a.normalized},
             Target<Out>{first, step});
    } else {
        for (std::uint64_t i = 0; i < a.count; ++i) std::fill_n(first + i * step, a.components, Out(0));
    }
    if (a.sparse) {
        const std::vector<std::uint32_t> places = sparseIndices(a, number, where);
        const std::uint8_t* data = viewBytes(a.sparse->valueView).data() + a.sparse->valueOffset;
        copy(a.component, {data, a.sparse->count, a.elementBytes, a.components, a.normalized},
             Target<Out>{first, step, places});
    }
}

void Accessors::readFloats(std::size_t accessor, std::string_view where, float* first, std::size_t step) const {
    read(accessor, where, first, step);
}

std::vector<std::uint32_t> Accessors::integers(std::size_t accessor, std::string_view where) const {
    std::vector<std::uint32_t> out(static_cast<std::size_t>(use(accessor, where).count));
    read(accessor, where, out.data(), 1);
    return out;
}

}  // namespace dioptre::gltf
