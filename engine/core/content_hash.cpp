#include "core/content_hash.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace dioptre {

void ContentHash::addBytes(const void* data, std::size_t size) {
    // FNV-1a's step on eight bytes at a time, with the high half folded back: its multiplication moves bits only up.
    const auto step = [this](std::uint64_t word) {
        value_ = (value_ ^ word) * 0x9e3779b97f4a7c15ULL;
        value_ ^= value_ >> 32;
    };
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::size_t at = 0;
    for (; at + 8 <= size; at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + at, 8);
        step(word);
    }
    std::uint64_t rest = 0;
    if (at < size) std::memcpy(&rest, bytes + at, size - at);
    step(rest);
    step(size);
}

void ContentHash::addText(std::string_view text) {
    addBytes(text.data(), text.size());
}
void ContentHash::add(double value) {
    add(std::bit_cast<std::uint64_t>(value));
}
void ContentHash::add(std::uint64_t value) {
    addBytes(&value, sizeof value);
}
std::string ContentHash::hex() const {
    return fmt::format("{:016x}", value_);
}

}  // namespace dioptre
