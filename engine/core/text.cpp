#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dioptre {

namespace {

constexpr std::size_t kQuotedBytes = 60;

bool isContinuationByte(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

template <class T>
std::optional<T> parseWhole(std::string_view text) {
    // from_chars takes no plus sign, people do.
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
    return value;
}

// Edit distance with swaps of neighbours (optimal string alignment), three rows of the table at a time.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before.swap(above);
        above.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

std::string quote(std::string_view text) {
    std::string out = "'";
    std::size_t length = std::min(text.size(), kQuotedBytes);
    while (length > 0 && length < text.size() && isContinuationByte(text[length])) --length;
    for (const char c : text.substr(0, length)) out += (c >= 0 && c < ' ') || c == 0x7F ? '?' : c;
    if (length < text.size()) out += "...";
    return out + "'";
}

std::optional<double> parseNumber(std::string_view text) {
    return parseWhole<double>(text);
}

std::optional<int> parseInteger(std::string_view text) {
    return parseWhole<int>(text);
}

std::string printNumber(double value) {
    std::array<char, 32> buffer{};  // the longest double takes 24
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), error == std::errc{} ? end : buffer.data());
}

std::string_view nearestName(std::string_view text, std::span<const std::string_view> names) {
    constexpr std::size_t kLongestName = 64;  // nothing that long is a misspelling; keeps the table small
    if (text.size() > kLongestName) return {};
    std::string_view best;
    std::size_t bestDistance = std::max<std::size_t>(1, text.size() / 3) + 1;  // one letter in three may be wrong
    for (const std::string_view name : names) {
        std::size_t distance = editDistance(text, name);
        // The unit left out: "ipd" for "ipd-mm".
        if (const auto dash = name.rfind('-'); dash != std::string_view::npos)
            distance = std::min(distance, editDistance(text, name.substr(0, dash)) + 1);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = name;
        }
    }
    return best;
}

}  // namespace dioptre
