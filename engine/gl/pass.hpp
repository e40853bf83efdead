// Every pass runs in a scope that names it for a frame capture, counts it, and times it when asked to.
#pragma once

#include <string_view>
#include <vector>

#include "gl/api.hpp"

namespace dioptre {

/// What ran in a frame. With `timed`, each scope waits for the GL before and after, so that the milliseconds are true
/// (timer queries are not, on software renderers) and the frame is slower for it.
struct PassLog {
    struct Entry {
        std::string_view name;  // a literal
        double milliseconds = 0.0;
    };
    /// A pass that this view does not require.
    struct Skipped {
        std::string_view name, why;  // literals
    };
    bool timed = false;
    std::vector<Entry> entries;
    std::vector<Skipped> skipped;

    int count(std::string_view name) const;
    void skip(std::string_view name, std::string_view why) { skipped.push_back({name, why}); }
    /// Ready for the next frame.
    void clear();
};

class PassScope {
  public:
    /// `name` must be a literal: the log keeps it.
    PassScope(PassLog& log, std::string_view name);
    ~PassScope();
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

  private:
    PassLog& log_;
    std::size_t index_;
    double start_ = 0.0;
};

/// Monotonic, in milliseconds.
double nowMilliseconds();

}  // namespace dioptre
