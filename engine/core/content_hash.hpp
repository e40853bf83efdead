// A hash by which what was made of some content is found again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dioptre {

/// 64 bits of anything; equal on every machine of the same byte order. No protection against malice.
class ContentHash {
  public:
    void addBytes(const void* data, std::size_t size);
    void addText(std::string_view text);  // with its length
    void add(double value);
    void add(std::uint64_t value);
    std::uint64_t value() const { return value_; }
    std::string hex() const;

  private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace dioptre
