#include "scene/gltf_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace dioptre::gltf {
namespace {

constexpr std::uint64_t kLargestWhole = 1ull << 53;  // beyond it JSON numbers are not exact everywhere

// A value as a message shows it; arrays and objects only by kind, for they may be huge.
std::string shown(const Json& value) {
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    if (value.is_object()) return "an object";
    return printable(value.dump());
}

std::optional<std::uint64_t> wholeValue(const Json& value) {
    if (value.is_number_unsigned()) {
        const auto number = value.get<std::uint64_t>();
        return number <= kLargestWhole ? std::optional(number) : std::nullopt;
    }
    // "3.0" is a whole number to many exporters.
    if (!value.is_number_float()) return std::nullopt;
    const auto number = value.get<double>();
    if (!(number >= 0.0 && number <= static_cast<double>(kLargestWhole)) || number != std::floor(number))
        return std::nullopt;
    return static_cast<std::uint64_t>(number);
}

std::optional<float> finiteValue(const Json& value) {
    if (!value.is_number()) return std::nullopt;
    const auto number = static_cast<float>(value.get<double>());
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// Bytes of the UTF-8 character that the text starts with, 0 if it is none (RFC 3629, 4).
std::size_t characterLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    // Overlong forms, surrogates, beyond U+10FFFF
    const unsigned second = length > 1 ? byte(1) : 0;
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
    if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
    return length;
}

std::string indexProblem(const Json& value, std::size_t count, std::string_view noun) {
    if (!wholeValue(value)) return fmt::format("is {}, must be an index of {}", shown(value), noun);
    return fmt::format("is {}, but the file has {} {}", shown(value), count, noun);
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr std::size_t kLongest = 120;
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        if (out.size() >= kLongest) return out + "...";
        const std::size_t length = characterLength(text.substr(i));
        const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
        const bool control = length == 1 && (byte(i) < 0x20 || byte(i) == 0x7F);
        const bool c1Control = length == 2 && byte(i) == 0xC2 && byte(i + 1) < 0xA0;
        const std::size_t taken = std::max<std::size_t>(length, 1);
        if (length == 0 || control || c1Control)
            out += fmt::format("\\x{:02x}", byte(i + taken - 1));
        else
            out += text.substr(i, length);
        i += taken;
    }
    return out;
}

Context::Context(const std::filesystem::path& path, const LoadLimits& loadLimits)
    : limits(loadLimits), folder(path.parent_path()), file_(printable(path.filename().string())) {
    if (file_.empty()) file_ = printable(path.string());
}

void Context::fail(std::string_view where, std::string_view what) const {
    throw InputError(where.empty() ? fmt::format("{}: {}", file_, what)
                                   : fmt::format("{}: {}: {}", file_, where, what));
}

void Context::warn(std::string_view where, std::string_view what) {
    if (const auto known = warningOf_.find(what); known != warningOf_.end()) {
        ++warnings_[known->second].count;
    } else if (warnings_.size() < limits.maxWarnings) {
        warningOf_.emplace(what, warnings_.size());
        warnings_.push_back({std::string(where), std::string(what), 1});
    } else {
        ++unsaid_;
    }
}

std::vector<std::string> Context::warnings() const {
    std::vector<std::string> lines;
    for (const Warning& warning : warnings_) {
        std::string line = fmt::format("{}: {}", warning.where, warning.what);
        if (warning.count > 1) line += fmt::format(" (and {} more)", warning.count - 1);
        lines.push_back(std::move(line));
    }
    if (unsaid_ > 0) lines.push_back(fmt::format("{} more warnings", unsaid_));
    return lines;
}

void Context::charge(std::uint64_t bytes, std::string_view where) {
    if (bytes > limits.maxTotalBytes - usedBytes_)
        fail(where, fmt::format("needs {} bytes more, {} of at most {} bytes are in use", bytes, usedBytes_,
                                limits.maxTotalBytes));
    usedBytes_ += bytes;
}

Element::Element(const Json& object, std::string path, Context& context)
    : json_(&object), path_(std::move(path)), context_(&context) {
    if (!object.is_object()) fail(fmt::format("is {}, must be an object", shown(object)));
}

std::string Element::pathOf(std::string_view key) const {
    return path_.empty() ? printable(key) : fmt::format("{}.{}", path_, printable(key));
}

const Json* Element::value(std::string_view key) const {
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

std::optional<Element> Element::find(std::string_view key) const {
    const Json* found = value(key);
    return found ? std::optional<Element>(std::in_place, *found, pathOf(key), *context_) : std::nullopt;
}

Element Element::object(std::string_view key) const {
    const Json* found = value(key);
    if (!found) fail(key, "is missing");
    return Element(*found, pathOf(key), *context_);
}

List Element::list(std::string_view key) const {
    const Json* found = value(key);
    if (found && !found->is_array()) fail(key, fmt::format("is {}, must be an array", shown(*found)));
    return List(found, pathOf(key), *context_);
}

std::optional<Element> Element::extension(std::string_view name) const {
    const auto extensions = find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::optional<std::string> Element::text(std::string_view key) const {
    const Json* found = value(key);
    if (!found) return std::nullopt;
    if (!found->is_string()) fail(key, fmt::format("is {}, must be a text", shown(*found)));
    return found->get<std::string>();
}

bool Element::flag(std::string_view key, bool fallback) const {
    const Json* found = value(key);
    if (!found) return fallback;
    if (!found->is_boolean()) fail(key, fmt::format("is {}, must be true or false", shown(*found)));
    return found->get<bool>();
}

std::optional<float> Element::number(std::string_view key) const {
    const Json* found = value(key);
    if (!found) return std::nullopt;
    const auto number = finiteValue(*found);
    if (!number) fail(key, fmt::format("is {}, must be a finite number", shown(*found)));
    return number;
}

std::optional<std::uint64_t> Element::whole(std::string_view key) const {
    const Json* found = value(key);
    if (!found) return std::nullopt;
    const auto number = wholeValue(*found);
    if (!number) fail(key, fmt::format("is {}, must be a whole number from 0 to 2^53", shown(*found)));
    return number;
}

std::uint64_t Element::requiredWhole(std::string_view key) const {
    const auto number = whole(key);
    if (!number) fail(key, "is missing");
    return *number;
}

std::optional<std::size_t> Element::index(std::string_view key, std::size_t count, std::string_view noun) const {
    const Json* found = value(key);
    if (!found) return std::nullopt;
    const auto number = wholeValue(*found);
    if (!number || *number >= count) fail(key, indexProblem(*found, count, noun));
    return static_cast<std::size_t>(*number);
}

std::size_t Element::requiredIndex(std::string_view key, std::size_t count, std::string_view noun) const {
    const auto number = index(key, count, noun);
    if (!number) fail(key, "is missing");
    return *number;
}

std::vector<float> Element::numbers(std::string_view key, std::size_t count) const {
    const Json* found = value(key);
    if (!found) return {};
    if (!found->is_array() || found->size() != count)
        fail(key, fmt::format("is {}, must be an array of {} numbers", shown(*found), count));
    std::vector<float> result;
    for (const Json& item : *found) {
        const auto number = finiteValue(item);
        if (!number)
            fail(fmt::format("{}[{}]", key, result.size()), fmt::format("is {}, must be a finite number", shown(item)));
        result.push_back(*number);
    }
    return result;
}

Element List::operator[](std::size_t i) const {
    return Element((*array_)[i], pathOf(i), *context_);
}

std::string List::pathOf(std::size_t i) const {
    return fmt::format("{}[{}]", path_, i);
}

std::size_t List::index(std::size_t i, std::size_t count, std::string_view noun) const {
    const auto number = wholeValue((*array_)[i]);
    if (!number || *number >= count) fail(i, indexProblem((*array_)[i], count, noun));
    return static_cast<std::size_t>(*number);
}

std::string List::text(std::size_t i) const {
    const Json& item = (*array_)[i];
    if (!item.is_string()) fail(i, fmt::format("is {}, must be a text", shown(item)));
    return item.get<std::string>();
}

}  // namespace dioptre::gltf
