#include "scene/lod_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/content_hash.hpp"
#include "core/error.hpp"
#include "core/file.hpp"

namespace dioptre {

namespace fs = std::filesystem;

namespace {

// To be raised with every change of the format, or of what simplify() makes.
constexpr std::uint32_t kVersion = 2;
constexpr std::string_view kMagic = "DIOPTLOD";
constexpr std::uint32_t kMostLevels = 64;  // halvings of any number there is

struct Header {
    char magic[8];
    std::uint32_t version, levels;
    std::uint64_t vertices, triangles;
};
struct LevelHeader {
    std::uint64_t indices;
    float error, seconds;
};
static_assert(sizeof(Header) == 32 && sizeof(LevelHeader) == 16);  // no gaps: they are written as they are

std::uint64_t checksumOf(std::string_view bytes) {
    ContentHash hash;
    hash.addBytes(bytes.data(), bytes.size());
    return hash.value();
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

class Reader {
  public:
    Reader(const fs::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

    [[noreturn]] void fail(std::string_view problem) const {
        throw InputError(fmt::format("{}: {}", file_.string(), problem));
    }
    template <class T>
    T take() {
        T value;
        if (bytes_.size() < sizeof(T)) fail("is cut short");
        std::memcpy(&value, bytes_.data(), sizeof(T));
        bytes_.remove_prefix(sizeof(T));
        return value;
    }
    std::vector<std::uint32_t> takeIndices(std::size_t count) {
        if (bytes_.size() / sizeof(std::uint32_t) < count) fail("is cut short");
        std::vector<std::uint32_t> indices(count);
        std::memcpy(indices.data(), bytes_.data(), count * sizeof(std::uint32_t));
        bytes_.remove_prefix(count * sizeof(std::uint32_t));
        return indices;
    }
    bool done() const { return bytes_.empty(); }

  private:
    const fs::path& file_;
    std::string_view bytes_;
};

LodLevel takeLevel(Reader& reader, const Primitive& primitive, std::size_t triangles) {
    const auto header = reader.take<LevelHeader>();
    if (header.indices == 0 || header.indices % 3 != 0 || header.indices / 3 >= triangles)
        reader.fail(fmt::format("a level of {} indices after one of {} triangles", header.indices, triangles));
    if (!(header.error >= 0.0f) || !std::isfinite(header.error)) reader.fail("a level's error is no distance");
    LodLevel level{reader.takeIndices(header.indices), header.error,
                   std::isfinite(header.seconds) ? header.seconds : 0.0f};
    const std::uint32_t most = *std::max_element(level.indices.begin(), level.indices.end());
    if (most >= primitive.vertices.size())
        reader.fail(fmt::format("index {} of {} vertices", most, primitive.vertices.size()));
    return level;
}

}  // namespace

std::string lodKey(const Primitive& primitive, std::span<const std::uint8_t> fixed) {
    ContentHash hash;
    const auto addVector = [&](const auto& v) { hash.addBytes(v.data(), v.size() * sizeof v[0]); };
    hash.add(std::uint64_t{kVersion});
    addVector(primitive.vertices);
    addVector(primitive.extras);
    addVector(primitive.indices);
    addVector(fixed);
    // The sizes, too, so that indices fit even where hashes are equal by chance
    return fmt::format("{}-{}-{}", hash.hex(), primitive.vertices.size(), primitive.triangleCount());
}

std::string lodBytes(const Primitive& primitive, std::span<const LodLevel> levels) {
    std::string bytes;
    Header header{
        {}, kVersion, static_cast<std::uint32_t>(levels.size()), primitive.vertices.size(), primitive.triangleCount()};
    std::copy(kMagic.begin(), kMagic.end(), header.magic);
    append(bytes, header);
    for (const LodLevel& level : levels) {
        append(bytes, LevelHeader{level.indices.size(), level.error, level.seconds});
        bytes.append(reinterpret_cast<const char*>(level.indices.data()), level.indices.size() * sizeof(std::uint32_t));
    }
    append(bytes, checksumOf(bytes));
    return bytes;
}

std::optional<std::vector<LodLevel>> readLods(const fs::path& file, const Primitive& primitive) {
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    if (!fs::exists(status)) return std::nullopt;
    // A pipe might never say anything.
    if (!fs::is_regular_file(status)) throw InputError(file.string() + ": is no file");
    // Each level has fewer than the one before, and none more than three of four of its triangles: at most three times
    // the source
    const std::size_t most = primitive.indices.size() * 4 * sizeof(std::uint32_t) + 65536;
    const std::string bytes = readFile(file, most);
    Reader whole(file, bytes);
    if (bytes.size() < sizeof(std::uint64_t)) whole.fail("is cut short");
    const std::string_view content(bytes.data(), bytes.size() - sizeof(std::uint64_t));
    Reader reader(file, content);
    const auto header = reader.take<Header>();
    if (std::string_view(header.magic, sizeof header.magic) != kMagic) reader.fail("is no file of levels");
    if (header.version != kVersion) reader.fail(fmt::format("is of version {}, not {}", header.version, kVersion));
    if (checksumOf(content) != Reader(file, std::string_view(bytes).substr(content.size())).take<std::uint64_t>())
        reader.fail("its checksum is wrong");
    if (header.vertices != primitive.vertices.size() || header.triangles != primitive.triangleCount())
        reader.fail("is of another mesh");
    if (header.levels > kMostLevels) reader.fail(fmt::format("has {} levels", header.levels));
    std::vector<LodLevel> levels;
    std::size_t triangles = primitive.triangleCount();
    for (std::uint32_t i = 0; i < header.levels; ++i) {
        levels.push_back(takeLevel(reader, primitive, triangles));
        triangles = levels.back().indices.size() / 3;
    }
    if (!reader.done()) reader.fail("goes on after its last level");
    return levels;
}

}  // namespace dioptre
