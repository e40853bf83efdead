// Buffers, buffer views and accessors: checked once, then read as plain arrays. Internal to the glTF loader.
// glTF 2.0, 3.6: element i lies at bufferView.byteOffset + accessor.byteOffset + i * stride.
#pragma once

#include <span>

#include "scene/gltf_json.hpp"

namespace dioptre::gltf {

enum class ComponentType : std::uint16_t {
    byte = 5120,
    unsignedByte = 5121,
    shortInt = 5122,
    unsignedShort = 5123,
    unsignedInt = 5125,
    floating = 5126
};

std::size_t sizeOf(ComponentType type);
std::string_view nameOf(ComponentType type);  // as the specification spells it: "UNSIGNED_BYTE"

/// Elements that replace some of an accessor's.
struct Sparse {
    std::uint64_t count = 0;
    std::size_t indexView = 0, valueView = 0;
    std::uint64_t indexOffset = 0, valueOffset = 0;
    ComponentType indexComponent = ComponentType::unsignedShort;
};

struct Accessor {
    std::optional<std::size_t> view;  // zeros without one
    std::uint64_t byteOffset = 0, count = 0;
    ComponentType component = ComponentType::floating;
    std::string type;              // "VEC3"
    std::uint64_t components = 0;  // 3; of a matrix without its padding
    std::uint64_t elementBytes = 0;
    bool normalized = false;
    std::vector<float> min, max;  // as stored, not normalised
    std::optional<Sparse> sparse;
};

/// All numeric data of a file. `binaryChunk` is the GLB's and must outlive this.
class Accessors {
  public:
    Accessors(const Element& root, std::optional<std::span<const std::uint8_t>> binaryChunk);

    std::size_t size() const { return accessors_.size(); }
    std::size_t viewCount() const { return views_.size(); }
    std::span<const std::uint8_t> viewBytes(std::size_t view) const;

    /// An accessor whose data is known to lie inside its buffer; otherwise fails, naming `where`.
    const Accessor& use(std::size_t accessor, std::string_view where) const;
    /// Fails, naming the accessor, if one that nobody uses is damaged.
    void checkAll() const;

    /// Its elements' numbers to `first`, `first + step`, ...; normalised integers become -1..1 or 0..1.
    void readFloats(std::size_t accessor, std::string_view where, float* first, std::size_t step) const;
    /// For unsigned components. Charge the memory before.
    std::vector<std::uint32_t> integers(std::size_t accessor, std::string_view where) const;

  private:
    struct View {
        std::size_t buffer = 0;
        std::uint64_t byteOffset = 0, byteLength = 0, stride = 0;  // stride 0: tight
    };
    void readBuffers(const List& buffers, std::optional<std::span<const std::uint8_t>> binaryChunk);
    void readViews(const List& views);
    void readAccessors(const List& accessors);
    std::string problemOf(const Accessor& accessor) const;  // empty: none
    std::string viewProblem(std::size_t view, std::uint64_t offset, std::uint64_t length, ComponentType type) const;
    std::vector<std::uint32_t> sparseIndices(const Accessor& accessor, std::size_t number,
                                             std::string_view where) const;
    template <typename Out>
    void read(std::size_t accessor, std::string_view where, Out* first, std::size_t step) const;

    Context& context_;
    std::vector<Bytes> ownBuffers_;
    std::vector<std::span<const std::uint8_t>> buffers_;
    std::vector<View> views_;
    std::vector<Accessor> accessors_;
};

}  // namespace dioptre::gltf
