#include "scene/gltf_file.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>

namespace dioptre::gltf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t littleEndian32(const std::uint8_t* bytes) {
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
           static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

// Depth and number of values are bounded, and their memory charged, before the parser builds anything.
void checkJsonSize(std::span<const std::uint8_t> text, Context& context) {
    int depth = 0;
    std::uint64_t values = 1;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t c = text[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '[' || c == '{') {
            ++values;
            if (++depth > context.limits.maxJsonDepth)
                context.fail("", fmt::format("JSON: nested deeper than {} at byte {}", context.limits.maxJsonDepth, i));
        } else if (c == ']' || c == '}') {
            --depth;
        } else if (c == ',') {
            ++values;
        }
    }
    if (values > context.limits.maxJsonValues)
        context.fail("", fmt::format("JSON: about {} values, the limit is {}", values, context.limits.maxJsonValues));
    constexpr std::uint64_t kValueBytes = 100;  // with its key, in the maps and lists that hold it
    context.charge(values * kValueBytes, "JSON");
}

Json parseJson(std::span<const std::uint8_t> text, Context& context) {
    checkJsonSize(text, context);
    try {
        return Json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::exception& error) {
        std::string_view what = error.what();  // "[json.exception.parse_error.101] parse error at line 1, ..."
        if (const auto end = what.find("] "); end != std::string_view::npos) what.remove_prefix(end + 2);
        context.fail("", fmt::format("JSON: {}", printable(what)));
    }
}

// People drag in what they have: what a file is, if it is no scene but known by its first bytes.
std::string_view otherFormat(std::string_view start) {
    struct Format {
        std::string_view magic, name;
    };
    constexpr Format kFormats[] = {{"\x89PNG\r\n", "a PNG picture"},
                                   {"\xFF\xD8\xFF", "a JPEG picture"},
                                   {"v/1\x01", "an OpenEXR picture"},
                                   {"PF\n", "a PFM picture"},
                                   {"GIF8", "a GIF picture"},
                                   {"RIFF", "a WebP picture or another RIFF file"},
                                   {"\xABKTX", "a KTX texture"},
                                   {"Kaydara FBX", "an FBX model"},
                                   {"BLENDER", "a Blender file"},
                                   {"ply\n", "a PLY model"},
                                   {"%PDF", "a PDF file"},
                                   {"PK\x03\x04", "a ZIP archive"},
                                   {"\x1F\x8B", "a gzip archive"}};
    for (const Format& format : kFormats)
        if (start.starts_with(format.magic)) return format.name;
    return {};
}

void takeGlbApart(Document& document, Context& context) {
    const Bytes& file = document.file;
    if (file.size() < kGlbHeaderBytes + kChunkHeaderBytes)
        context.fail("GLB header", fmt::format("the file has {} bytes, a GLB at least {}", file.size(),
                                               kGlbHeaderBytes + kChunkHeaderBytes));
    if (const auto version = littleEndian32(&file[4]); version != 2)
        context.fail("GLB header", fmt::format("version {}, only 2 is known", version));
    const std::size_t length = littleEndian32(&file[8]);
    if (length > file.size() || length < kGlbHeaderBytes + kChunkHeaderBytes)
        context.fail("GLB header", fmt::format("length {}, but the file has {} bytes", length, file.size()));
    if (length < file.size())
        context.warn("GLB header", fmt::format("{} bytes after the end are ignored", file.size() - length));

    std::size_t at = kGlbHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        const std::string where = fmt::format("GLB chunk {}", chunk);
        if (length - at < kChunkHeaderBytes)
            context.fail(where, fmt::format("{} bytes left, its header takes {}", length - at, kChunkHeaderBytes));
        const std::size_t bytes = littleEndian32(&file[at]);
        const std::uint32_t type = littleEndian32(&file[at + 4]);
        at += kChunkHeaderBytes;
        if (bytes > length - at) context.fail(where, fmt::format("{} bytes, but only {} are left", bytes, length - at));
        const std::span<const std::uint8_t> data(file.data() + at, bytes);
        if (chunk == 0) {
            if (type != kJsonChunk) context.fail(where, fmt::format("type {:#010x}, the first must be JSON", type));
            document.json = parseJson(data, context);
        } else if (chunk == 1 && type == kBinaryChunk) {
            document.binaryChunk = data;
        }
        at += bytes;
    }
}

}  // namespace

Bytes readFile(const fs::path& path, Context& context, std::string_view where) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    // The path, where the message does not begin with it.
    const bool named = where.empty() && !path.has_parent_path();
    const std::string shown = named ? "" : fmt::format(" ({})", printable(path.string()));
    if (status.type() == fs::file_type::not_found) context.fail(where, "no such file" + shown);
    if (error) context.fail(where, fmt::format("cannot be read: {}{}", error.message(), shown));
    if (status.type() == fs::file_type::directory) context.fail(where, "is a directory" + shown);
    if (status.type() != fs::file_type::regular) context.fail(where, "is not a plain file" + shown);
    const std::uintmax_t size = fs::file_size(path, error);
    std::ifstream stream(path, std::ios::binary);
    if (error || !stream) context.fail(where, "cannot be opened" + shown);
    if (size == 0) context.fail(where, "is empty" + shown);
    if (size > context.limits.maxFileBytes)
        context.fail(where, fmt::format("{} bytes, the limit is {}", size, context.limits.maxFileBytes));
    context.charge(size, where);
    Bytes bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size)
        context.fail(where, fmt::format("only {} of {} bytes could be read{}", stream.gcount(), size, shown));
    return bytes;
}

Document openDocument(const fs::path& path, Context& context) {
    Document document;
    document.file = readFile(path, context, "");
    const std::string_view all(reinterpret_cast<const char*>(document.file.data()), document.file.size());
    const std::string_view start = all.substr(0, kGlbMagic.size());
    if (start == kGlbMagic) {
        takeGlbApart(document, context);
        return document;
    }
    if (const auto other = otherFormat(all); !other.empty())
        context.fail("", fmt::format("is {}, not a glTF scene", other));
    if (path.extension() == ".glb")
        context.fail("GLB header", fmt::format("starts with \"{}\", must start with \"glTF\"", printable(start)));
    document.json = parseJson(document.file, context);
    document.file = Bytes();  // its charge stays, for the parsed JSON
    return document;
}

}  // namespace dioptre::gltf
