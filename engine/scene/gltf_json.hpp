// A walk over parsed JSON that knows where it stands: what is read is checked, and a complaint names its element.
// Internal to the glTF loader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/gltf_loader.hpp"

namespace dioptre::gltf {

using Json = nlohmann::json;

/// Leaves bytes as they are where a vector would clear them: a file of 100 MB is about to overwrite them anyway.
struct UnclearedAllocator : std::allocator<std::uint8_t> {
    template <class Other>
    struct rebind {
        using other = UnclearedAllocator;
    };
    void construct(std::uint8_t*) {}
    template <class... Arguments>
    void construct(std::uint8_t* at, Arguments&&... arguments) {
        std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
};
using Bytes = std::vector<std::uint8_t, UnclearedAllocator>;

/// Text from a file, fit for a one-line message: UTF-8, all else and control characters escaped, cut after 120 bytes.
std::string printable(std::string_view text);

/// What one loading shares: where it reads, what it may use, what it has to say.
class Context {
  public:
    Context(const std::filesystem::path& path, const LoadLimits& limits);

    const LoadLimits limits;
    const std::filesystem::path folder;  // of the scene file

    /// Throws InputError "file: where: what"; `where` may be empty.
    [[noreturn]] void fail(std::string_view where, std::string_view what) const;
    /// Says it once, names the first element and counts the others.
    void warn(std::string_view where, std::string_view what);
    std::vector<std::string> warnings() const;

    /// Asks for memory before it is allocated; fails, naming `where`, beyond LoadLimits::maxTotalBytes.
    void charge(std::uint64_t bytes, std::string_view where);
    void release(std::uint64_t bytes) { usedBytes_ -= bytes; }
    std::uint64_t chargeable() const { return limits.maxTotalBytes - usedBytes_; }

  private:
    struct Warning {
        std::string where, what;
        std::size_t count = 0;
    };
    std::string file_;
    std::vector<Warning> warnings_;
    std::map<std::string, std::size_t, std::less<>> warningOf_;  // what -> place in warnings_
    std::size_t unsaid_ = 0;
    std::uint64_t usedBytes_ = 0;
};

class List;

/// A JSON object and its path, such as `meshes[3].primitives[0]`. Refers to the parsed JSON, which must outlive it.
class Element {
  public:
    Element(const Json& object, std::string path, Context& context);

    Context& context() const { return *context_; }
    const std::string& path() const { return path_; }
    std::string pathOf(std::string_view key) const;
    [[noreturn]] void fail(std::string_view what) const { context_->fail(path_, what); }
    [[noreturn]] void fail(std::string_view key, std::string_view what) const { context_->fail(pathOf(key), what); }
    void warn(std::string_view what) const { context_->warn(path_, what); }
    void warn(std::string_view key, std::string_view what) const { context_->warn(pathOf(key), what); }

    bool has(std::string_view key) const { return json_->contains(key); }
    const Json& json() const { return *json_; }
    std::optional<Element> find(std::string_view key) const;  // an object or nothing
    Element object(std::string_view key) const;               // an object that must be there
    List list(std::string_view key) const;                    // an array; empty if not there
    /// `extensions.NAME`, an object or nothing.
    std::optional<Element> extension(std::string_view name) const;

    std::optional<std::string> text(std::string_view key) const;
    bool flag(std::string_view key, bool fallback) const;
    std::optional<float> number(std::string_view key) const;  // finite as a float
    float number(std::string_view key, float fallback) const { return number(key).value_or(fallback); }
    std::optional<std::uint64_t> whole(std::string_view key) const;  // 0 .. 2^53
    std::uint64_t whole(std::string_view key, std::uint64_t fallback) const { return whole(key).value_or(fallback); }
    std::uint64_t requiredWhole(std::string_view key) const;
    /// An index below `count`; `noun` is the plural: "is 7, the file has 3 accessors".
    std::optional<std::size_t> index(std::string_view key, std::size_t count, std::string_view noun) const;
    std::size_t requiredIndex(std::string_view key, std::size_t count, std::string_view noun) const;
    /// Finite numbers, exactly `count` of them; empty if not there.
    std::vector<float> numbers(std::string_view key, std::size_t count) const;

  private:
    const Json* value(std::string_view key) const;

    const Json* json_;
    std::string path_;
    Context* context_;
};

/// A JSON array and its path.
class List {
  public:
    List(const Json* array, std::string path, Context& context)
        : array_(array), path_(std::move(path)), context_(&context) {}

    std::size_t size() const { return array_ ? array_->size() : 0; }
    bool empty() const { return size() == 0; }
    Element operator[](std::size_t i) const;  // must be an object
    std::size_t index(std::size_t i, std::size_t count, std::string_view noun) const;
    std::string text(std::size_t i) const;
    std::string pathOf(std::size_t i) const;
    [[noreturn]] void fail(std::size_t i, std::string_view what) const { context_->fail(pathOf(i), what); }

  private:
    const Json* array_;
    std::string path_;
    Context* context_;
};

}  // namespace dioptre::gltf
