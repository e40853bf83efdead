#include "scene/gltf_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "scene/vertex_frame.hpp"

namespace dioptre::gltf {
namespace {

constexpr std::uint64_t kPoints = 0, kLines = 1, kLineLoop = 2, kLineStrip = 3, kTriangles = 4, kStrip = 5, kFan = 6;

bool declares(const Element& root, std::string_view extension) {
    const List used = root.list("extensionsUsed");
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used.text(i) == extension) return true;
    return false;
}

std::uint32_t restartValue(ComponentType type) {
    switch (type) {
        case ComponentType::unsignedByte:
            return 0xFF;
        case ComponentType::unsignedShort:
            return 0xFFFF;
        default:
            return 0xFFFFFFFF;
    }
}

Topology topologyOf(std::uint64_t mode) {
    if (mode == kPoints) return Topology::points;
    return mode < kTriangles ? Topology::lines : Topology::triangles;
}

std::string_view nounOf(Topology topology) {
    return topology == Topology::points ? "point" : topology == Topology::lines ? "line" : "triangle";
}

// Of the points, lines or triangles that so many corners make, how many indices.
std::size_t indexCount(std::uint64_t mode, std::size_t corners) {
    switch (mode) {
        case kPoints:
            return corners;
        case kLines:
            return corners / 2 * 2;
        case kLineLoop:
            return corners < 2 ? 0 : corners * 2;
        case kLineStrip:
            return corners < 2 ? 0 : (corners - 1) * 2;
        case kTriangles:
            return corners / 3 * 3;
        default:
            return corners < 3 ? 0 : (corners - 2) * 3;
    }
}

// glTF 2.0, 3.7.2.1: the corners of line or triangle i in a loop, strip or fan, wound as the first.
std::vector<std::uint32_t> asList(std::uint64_t mode, std::vector<std::uint32_t> corners) {
    const std::size_t count = indexCount(mode, corners.size());
    if (mode == kPoints || mode == kLines || mode == kTriangles) {
        corners.resize(count);
        return corners;
    }
    std::vector<std::uint32_t> out;
    out.reserve(count);
    for (std::size_t i = 0; out.size() < count; ++i) {
        if (mode == kLineLoop || mode == kLineStrip)
            out.insert(out.end(), {corners[i], corners[(i + 1) % corners.size()]});
        else if (mode == kStrip)
            out.insert(out.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
        else
            out.insert(out.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return out;
}

// Numbers of a vertex, wherever they stand in it.
struct VertexPart {
    float* first;  // of the first vertex
    std::size_t step, count, components;

    float* of(std::size_t vertex) const { return first + vertex * step; }
};

void checkFinite(const VertexPart& part, const Accessor& accessor, const Element& owner, std::string_view key) {
    if (accessor.component != ComponentType::floating) return;
    for (std::size_t i = 0; i < part.count; ++i)
        for (std::size_t c = 0; c < part.components; ++c)
            if (!std::isfinite(part.of(i)[c]))
                owner.fail(key, fmt::format("element {} is {}, must be finite", i, part.of(i)[c]));
}

// The declared extent, in the units of the data read.
void checkDeclaredBounds(const Accessor& accessor, const Bounds& bounds, const Element& owner, std::string_view key) {
    if (accessor.min.empty() || accessor.max.empty()) return;
    float scale = 1.0f, lowest = std::numeric_limits<float>::lowest();
    if (accessor.normalized && accessor.component != ComponentType::floating) {
        const bool isSigned =
            accessor.component == ComponentType::byte || accessor.component == ComponentType::shortInt;
        const int bits = static_cast<int>(sizeOf(accessor.component)) * 8 - (isSigned ? 1 : 0);
        lowest = -1.0f;
        scale = 1.0f / (std::exp2(static_cast<float>(bits)) - 1.0f);
    }
    for (int i = 0; i < 3; ++i) {
        const float low = std::max(accessor.min[static_cast<std::size_t>(i)] * scale, lowest);
        const float high = accessor.max[static_cast<std::size_t>(i)] * scale;
        // Text with six digits is not off.
        const float tolerance = 1e-5f * std::max(std::abs(bounds.min[i]), std::abs(bounds.max[i]));
        const float lowOff = std::abs(low - bounds.min[i]), highOff = std::abs(high - bounds.max[i]);
        if (!(lowOff <= tolerance && highOff <= tolerance))
            return owner.warn(key, "min or max is not that of the data");
    }
}

}  // namespace

struct MeshReader::Plan {
    std::uint64_t mode = kTriangles;
    std::size_t material = 0;
    MaterialNeeds needs;
    std::optional<std::size_t> indices, position, normal, tangent, color;  // accessors
    std::array<std::optional<std::size_t>, 2> uv;
    std::array<std::string, 2> uvName;  // "TEXCOORD_0"; empty where the material reads one set
    std::size_t vertexCount = 0, cornerCount = 0;
    bool drawn = false;

    Topology topology() const { return topologyOf(mode); }
    bool hasExtras() const { return color || uv[1]; }
    std::size_t indexCount() const { return gltf::indexCount(mode, cornerCount); }
    std::uint64_t vertexBytes() const { return sizeof(Vertex) + (hasExtras() ? sizeof(VertexExtra) : 0); }
};

MeshReader::MeshReader(const Element& root, const Accessors& accessors, const Materials& materials)
    : meshes_(root.list("meshes")),
      accessors_(accessors),
      materials_(materials),
      quantized_(declares(root, "KHR_mesh_quantization")) {
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        const List primitives = meshes_[m].list("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p) warnOfOmissions(primitives[p], plan(primitives[p]));
    }
}

void MeshReader::checkAttribute(const Element& attributes, const std::string& semantic, const Accessor& a) const {
    const bool isUv = semantic.starts_with("TEXCOORD_"), isColor = semantic.starts_with("COLOR_");
    const std::string_view type = isUv ? "VEC2" : semantic == "TANGENT" ? "VEC4" : "VEC3";
    const bool small = sizeOf(a.component) < 4;
    const bool isSigned = a.component == ComponentType::byte || a.component == ComponentType::shortInt;
    const bool plain =
        a.component == ComponentType::floating || ((isUv || isColor) && small && !isSigned && a.normalized);
    const bool quantized = small && !isColor && (isUv || semantic == "POSITION" || (isSigned && a.normalized));
    if (isColor && a.type != "VEC3" && a.type != "VEC4")
        attributes.fail(semantic, fmt::format("is {}, must be VEC3 or VEC4", a.type));
    if (!isColor && a.type != type) attributes.fail(semantic, fmt::format("is {}, must be {}", a.type, type));
    if (plain || (quantized && quantized_)) return;
    const std::string_view normalized = a.normalized ? "normalized " : "";
    if (quantized)
        attributes.fail(semantic, fmt::format("is {}{}, which needs KHR_mesh_quantization in extensionsUsed",
                                              normalized, nameOf(a.component)));
    attributes.fail(semantic, fmt::format("is {}{}, must be FLOAT{}", normalized, nameOf(a.component),
                                          isUv || isColor ? ", normalized UNSIGNED_BYTE or UNSIGNED_SHORT" : ""));
}

MeshReader::Plan MeshReader::plan(const Element& primitive) const {
    Plan plan;
    plan.mode = primitive.whole("mode", kTriangles);
    if (plan.mode > kFan) primitive.fail("mode", fmt::format("is {}, must be 0 to 6", plan.mode));
    const std::size_t fileMaterials = materials_.materials.size() - 1;
    plan.material = primitive.index("material", fileMaterials, "materials").value_or(fileMaterials);
    plan.needs = materials_.needs[plan.material];
    const std::vector<std::uint64_t>& sets = plan.needs.uvSets;
    plan.uvName[0] = fmt::format("TEXCOORD_{}", sets.empty() ? 0 : sets[0]);
    if (sets.size() > 1) plan.uvName[1] = fmt::format("TEXCOORD_{}", sets[1]);
    planAttributes(primitive.object("attributes"), plan);
    planIndices(primitive, plan);
    checkDeformation(primitive, accessors_, plan.vertexCount, quantized_);
    plan.drawn = plan.position && plan.indexCount() > 0;
    return plan;
}

void MeshReader::planAttributes(const Element& attributes, Plan& plan) const {
    for (const auto& [semantic, value] : attributes.json().items()) {
        const std::size_t number = attributes.requiredIndex(semantic, accessors_.size(), "accessors");
        const Accessor& accessor = accessors_.use(number, attributes.pathOf(semantic));
        if (plan.vertexCount == 0) plan.vertexCount = static_cast<std::size_t>(accessor.count);
        if (accessor.count != plan.vertexCount)
            attributes.fail(semantic,
                            fmt::format("has {} elements, another attribute {}", accessor.count, plan.vertexCount));
        if (semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT" ||
            semantic.starts_with("TEXCOORD_") || semantic.starts_with("COLOR_"))
            checkAttribute(attributes, semantic, accessor);
        if (semantic == "POSITION") plan.position = number;
        if (semantic == "NORMAL") plan.normal = number;
        if (semantic == "TANGENT") plan.tangent = number;
        if (semantic == "COLOR_0") plan.color = number;
        for (std::size_t set = 0; set < 2; ++set)
            if (semantic == plan.uvName[set]) plan.uv[set] = number;
    }
}

void MeshReader::planIndices(const Element& primitive, Plan& plan) const {
    plan.cornerCount = plan.vertexCount;
    plan.indices = primitive.index("indices", accessors_.size(), "accessors");
    if (!plan.indices) return;
    const Accessor& accessor = accessors_.use(*plan.indices, primitive.pathOf("indices"));
    const bool isUnsigned = accessor.component == ComponentType::unsignedByte ||
                            accessor.component == ComponentType::unsignedShort ||
                            accessor.component == ComponentType::unsignedInt;
    if (accessor.type != "SCALAR" || !isUnsigned || accessor.normalized)
        primitive.fail("indices",
                       fmt::format("is {}{} {}, must be unsigned SCALAR", accessor.normalized ? "normalized " : "",
                                   nameOf(accessor.component), accessor.type));
    plan.cornerCount = static_cast<std::size_t>(accessor.count);
}

void MeshReader::warnOfOmissions(const Element& primitive, const Plan& plan) const {
    const Element attributes = primitive.object("attributes");
    for (const auto& [semantic, value] : attributes.json().items())
        if (semantic.starts_with("COLOR_") && semantic != "COLOR_0")
            attributes.warn(semantic, "a second vertex colour is ignored");
    if (!plan.position) primitive.warn("has no POSITION: not drawn");
    const std::string_view noun = nounOf(plan.topology());
    if (plan.indexCount() == 0) primitive.warn(fmt::format("has no whole {}: not drawn", noun));
    if (plan.drawn && (plan.mode == kTriangles || plan.mode == kLines) && plan.cornerCount != plan.indexCount())
        primitive.warn(fmt::format("the last {} is incomplete and left out", noun));
    for (std::size_t set = 0; plan.drawn && set < plan.needs.uvSets.size(); ++set)
        if (!plan.uv[set]) attributes.warn(plan.uvName[set], "is missing: textures are read at 0, 0");
}

Mesh MeshReader::read(std::size_t i, const DeformationNeeds& needs) const {
    const Element element = meshes_[i];
    Mesh mesh;
    mesh.name = element.text("name").value_or("");
    const List primitives = element.list("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p)
        if (auto primitive = readPrimitive(primitives[p], needs)) mesh.primitives.push_back(std::move(*primitive));
    return mesh;
}

std::optional<Primitive> MeshReader::readPrimitive(const Element& element, const DeformationNeeds& needs) const {
    const Plan plan = this->plan(element);
    if (!plan.drawn) return std::nullopt;
    Context& context = element.context();
    const Element attributes = element.object("attributes");
    if (plan.vertexCount > std::numeric_limits<std::uint32_t>::max())
        attributes.fail("POSITION", fmt::format("has {} elements, the limit is 2^32 - 1", plan.vertexCount));

    // All that is allocated below, before it is. What passes: an attribute being read or the sums of computeTangents,
    // and the corners of strips.
    constexpr std::uint64_t kPassingBytes = 6 * sizeof(double);
    const std::uint64_t indices = plan.indexCount();
    const std::uint64_t kept = plan.vertexCount * plan.vertexBytes() + indices * sizeof(std::uint32_t);
    const std::uint64_t passing = plan.vertexCount * kPassingBytes + plan.cornerCount * sizeof(std::uint32_t);
    context.charge(kept + passing, element.path());

    Primitive primitive;
    primitive.material = static_cast<int>(plan.material);
    primitive.topology = plan.topology();
    // glTF 2.0, 3.9.5: points and lines without normals are not lit
    primitive.lit = plan.normal || primitive.topology == Topology::triangles;
    const bool flat = !plan.normal && primitive.topology == Topology::triangles;
    readIndices(plan, element, primitive);
    readVertices(plan, attributes, primitive);
    if (plan.hasExtras()) readExtras(plan, attributes, primitive);
    const bool fileTangents = plan.normal && plan.tangent && plan.needs.tangent;
    auto deformation =
        readDeformation(element, accessors_, needs, {plan.vertexCount, plan.normal.has_value(), fileTangents});
    if (plan.normal) readNormals(plan, attributes, primitive);
    if (flat) {
        context.charge(indices * (plan.vertexBytes() + kPassingBytes), element.path());
        if (deformation) {
            const std::uint64_t shared = deformation->bytes();
            context.charge(shared / plan.vertexCount * indices, element.path());
            *deformation = unshared(*deformation, primitive.indices);
            context.release(shared);
        }
        makeFlat(primitive);
        context.release(plan.vertexCount * plan.vertexBytes());
    }
    readTangents(plan, attributes, primitive);
    if (deformation) deformation->extent = findExtent(*deformation, primitive);
    primitive.deformation = std::move(deformation);
    if (flat) context.release(indices * kPassingBytes);
    context.release(passing);
    return primitive;
}

void MeshReader::readIndices(const Plan& plan, const Element& element, Primitive& out) const {
    std::vector<std::uint32_t> corners;
    if (plan.indices) {
        corners = accessors_.integers(*plan.indices, element.pathOf("indices"));
        const std::uint32_t restart = restartValue(accessors_.use(*plan.indices, "").component);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (corners[i] == restart)
                element.fail("indices", fmt::format("index {} is {}, the primitive restart value", i, restart));
            if (corners[i] >= plan.vertexCount)
                element.fail("indices",
                             fmt::format("index {} is {}, but there are {} vertices", i, corners[i], plan.vertexCount));
        }
    } else {
        corners.resize(plan.vertexCount);
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    out.indices = asList(plan.mode, std::move(corners));
}

template <typename Holder>
void MeshReader::readAttribute(std::size_t accessor, const Element& attributes, std::string_view key,
                               std::vector<Holder>& vertices, std::size_t offset) const {
    const VertexPart part{reinterpret_cast<float*>(reinterpret_cast<std::uint8_t*>(vertices.data()) + offset),
                          sizeof(Holder) / sizeof(float), vertices.size(), accessors_.use(accessor, "").components};
    accessors_.readFloats(accessor, attributes.pathOf(key), part.first, part.step);
    checkFinite(part, accessors_.use(accessor, ""), attributes, key);
}

void MeshReader::readVertices(const Plan& plan, const Element& attributes, Primitive& out) const {
    out.vertices.resize(plan.vertexCount);
    readAttribute(*plan.position, attributes, "POSITION", out.vertices, offsetof(Vertex, position));
    for (const Vertex& vertex : out.vertices) out.bounds.add(vertex.position);
    checkDeclaredBounds(accessors_.use(*plan.position, ""), out.bounds, attributes, "POSITION");
    if (plan.uv[0]) readAttribute(*plan.uv[0], attributes, plan.uvName[0], out.vertices, offsetof(Vertex, uv));
}

void MeshReader::readExtras(const Plan& plan, const Element& attributes, Primitive& out) const {
    out.extras.resize(plan.vertexCount);
    if (plan.uv[1]) readAttribute(*plan.uv[1], attributes, plan.uvName[1], out.extras, offsetof(VertexExtra, uv));
    if (!plan.color) return;
    std::vector<glm::vec4> colors(plan.vertexCount, glm::vec4(1.0f));
    readAttribute(*plan.color, attributes, "COLOR_0", colors, 0);
    // glTF 2.0, 3.7.2.1: vertex colours are clamped
    for (std::size_t i = 0; i < colors.size(); ++i)
        out.extras[i].color = glm::u16vec4(glm::clamp(colors[i], 0.0f, 1.0f) * 65535.0f + 0.5f);
}

void MeshReader::readNormals(const Plan& plan, const Element& attributes, Primitive& out) const {
    readAttribute(*plan.normal, attributes, "NORMAL", out.vertices, offsetof(Vertex, normal));
    std::vector<bool> missing;
    for (std::size_t i = 0; i < plan.vertexCount; ++i) {
        // In double precision, where no finite float's square overflows or vanishes.
        const glm::dvec3 normal(out.vertices[i].normal);
        const double length = glm::length(normal);
        if (length > 0.0) {
            out.vertices[i].normal = glm::vec3(normal / length);
        } else {
            missing.resize(plan.vertexCount);
            missing[i] = true;
        }
    }
    if (missing.empty()) return;
    attributes.warn("NORMAL", "zero normals are replaced by those of the faces");
    fillNormals(out, missing);
}

void MeshReader::readTangents(const Plan& plan, const Element& attributes, Primitive& out) const {
    if (!plan.needs.tangent) return;
    if (!plan.tangent || !plan.normal) {
        if (out.topology == Topology::triangles)
            return computeTangents(out, materials_.materials[plan.material].normalTexture);
        // glTF 2.0, 3.9.5: points and lines without tangents have no normal map, nor does a tangent of no length
        for (Vertex& vertex : out.vertices) vertex.tangent = glm::vec4(0.0f);
        return;
    }
    readAttribute(*plan.tangent, attributes, "TANGENT", out.vertices, offsetof(Vertex, tangent));
    for (Vertex& vertex : out.vertices) {
        const glm::dvec3 tangent(vertex.tangent);
        const double length = glm::length(tangent);
        if (!(length > 0.0)) attributes.warn("TANGENT", "zero tangents are replaced");
        const glm::vec3 unit = length > 0.0 ? glm::vec3(tangent / length) : anyOrthogonal(vertex.normal);
        vertex.tangent = glm::vec4(unit, vertex.tangent.w < 0.0f ? -1.0f : 1.0f);
    }
}

}  // namespace dioptre::gltf
