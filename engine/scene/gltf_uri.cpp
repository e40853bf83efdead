#include "scene/gltf_uri.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scene/gltf_file.hpp"

namespace dioptre::gltf {
namespace {

namespace fs = std::filesystem;

// RFC 3986, 3.1: a letter, then letters, digits, "+", "-", "." up to a colon.
std::string_view schemeOf(std::string_view uri) {
    const auto colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0 || !std::isalpha(static_cast<unsigned char>(uri[0]))) return {};
    const std::string_view scheme = uri.substr(0, colon);
    const bool legal = std::all_of(scheme.begin(), scheme.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
    return legal ? scheme : std::string_view{};
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percentDecoded(std::string_view text, const Element& owner) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0) owner.fail("uri", fmt::format("\"%\" without two hex digits at byte {}", i));
        out += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return out;
}

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;  // the URL-safe alphabet as well
    if (c == '/' || c == '_') return 63;
    return -1;
}

Bytes decodedBase64(std::string_view text, const Element& owner) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) owner.fail("uri", fmt::format("base64 data cut short ({} digits)", text.size()));
    Bytes out;
    out.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = base64Digit(text[i]);
        if (digit < 0)
            owner.fail("uri",
                       fmt::format("\"{}\" is no base64 digit (byte {} of the data)", printable(text.substr(i, 1)), i));
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            out.push_back(static_cast<std::uint8_t>(bits >> bitCount & 0xFF));
        }
    }
    return out;
}

// RFC 2397: data:[media type][;parameters][;base64],data
Bytes decodedData(std::string_view uri, const Element& owner) {
    const auto comma = uri.find(',');
    if (comma == std::string_view::npos) owner.fail("uri", "a data URI without a comma");
    const std::string_view header = uri.substr(0, comma), data = uri.substr(comma + 1);
    owner.context().charge(data.size(), owner.pathOf("uri"));
    Bytes bytes;
    if (header.ends_with(";base64") && data.find('%') == std::string_view::npos) {
        bytes = decodedBase64(data, owner);
    } else {
        const std::string plain = percentDecoded(data, owner);
        bytes = header.ends_with(";base64") ? decodedBase64(plain, owner) : Bytes(plain.begin(), plain.end());
    }
    owner.context().release(data.size() - bytes.size());
    return bytes;
}

// Once as written, so that the message can say why, and once with links resolved, which is what counts.
fs::path pathInsideFolder(std::string_view uri, const Element& owner) {
    const auto scheme = schemeOf(uri);
    if (!scheme.empty())
        owner.fail("uri", fmt::format("scheme \"{}:\" of \"{}\" is refused, only data: and files inside the scene's "
                                      "folder are read",
                                      printable(scheme), printable(uri)));
    const std::string decoded = percentDecoded(uri, owner);
    const std::string shown = printable(decoded);
    if (decoded.empty()) owner.fail("uri", "is empty");
    if (decoded.find('\0') != std::string::npos) owner.fail("uri", fmt::format("\"{}\" contains a zero byte", shown));
    const fs::path relative(decoded);
    if (relative.is_absolute()) owner.fail("uri", fmt::format("\"{}\" is an absolute path, which is refused", shown));
    const fs::path plain = relative.lexically_normal();
    if (!plain.empty() && *plain.begin() == "..")
        owner.fail("uri", fmt::format("\"{}\" leads out of the scene's folder", shown));

    std::error_code error;
    const fs::path& sceneFolder = owner.context().folder;
    const fs::path folder = fs::canonical(sceneFolder.empty() ? fs::path(".") : sceneFolder, error);
    if (error) owner.fail("uri", fmt::format("the scene's folder cannot be read: {}", error.message()));
    const fs::path target = fs::weakly_canonical(folder / relative, error);
    if (error) owner.fail("uri", fmt::format("\"{}\" cannot be read: {}", shown, error.message()));
    const auto [inFolder, inTarget] = std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
    if (inFolder != folder.end()) owner.fail("uri", fmt::format("\"{}\" links out of the scene's folder", shown));
    return target;
}

}  // namespace

Bytes readUri(const Element& owner) {
    if (!owner.has("uri")) owner.fail("uri", "is missing");
    const Json& value = owner.json()["uri"];
    if (!value.is_string()) owner.text("uri");  // says so
    const auto& uri = value.get_ref<const std::string&>();
    if (schemeOf(uri) == "data") return decodedData(uri, owner);
    return readFile(pathInsideFolder(uri, owner), owner.context(), owner.pathOf("uri"));
}

}  // namespace dioptre::gltf
