#include "gl/pass.hpp"

#include <algorithm>
#include <chrono>

namespace dioptre {

double nowMilliseconds() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int PassLog::count(std::string_view name) const {
    return static_cast<int>(
        std::count_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; }));
}

void PassLog::clear() {
    entries.clear();
    skipped.clear();
}

PassScope::PassScope(PassLog& log, std::string_view name) : log_(log), index_(log.entries.size()) {
    log_.entries.push_back({name, 0.0});
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
    if (log_.timed) {
        glFinish();
        start_ = nowMilliseconds();
    }
}

PassScope::~PassScope() {
    if (log_.timed) {
        glFinish();
        log_.entries[index_].milliseconds = nowMilliseconds() - start_;
    }
    glPopDebugGroup();
}

}  // namespace dioptre
