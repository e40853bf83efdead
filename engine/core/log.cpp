#include "core/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <memory>
#include <utility>

namespace dioptre {

namespace {

std::atomic<bool> progressShown{false};  // an unfinished line stands on the terminal

spdlog::logger& logger() {
    static const std::unique_ptr<spdlog::logger> instance = [] {
        auto made = std::make_unique<spdlog::logger>("dioptre", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        made->set_pattern("%v");
        made->flush_on(spdlog::level::trace);
        return made;
    }();
    return *instance;
}

void log(spdlog::level::level_enum level, std::string_view prefix, std::string_view message) {
    if (progressShown.exchange(false)) std::fputs("\r\033[K", stderr);
    std::string line(prefix);
    line += message;
    logger().log(level, spdlog::string_view_t(line.data(), line.size()));
}

}  // namespace

void logInfo(std::string_view message) {
    log(spdlog::level::info, "", message);
}
void logWarning(std::string_view message) {
    log(spdlog::level::warn, "warning: ", message);
}
void logError(std::string_view message) {
    log(spdlog::level::err, "error: ", message);
}

ProgressLine::ProgressLine(std::string label, std::size_t total)
    : label_(std::move(label)), total_(total), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (terminal_ && progressShown.exchange(false)) std::fputc('\n', stderr);
}

void ProgressLine::update(std::size_t done, std::string_view note) {
    const std::string tail = note.empty() ? "" : " " + std::string(note);
    if (terminal_) {
        std::fprintf(stderr, "\r\033[K%s %zu/%zu%s", label_.c_str(), done, total_, tail.c_str());
        progressShown = true;
        return;
    }
    const std::size_t tenths = total_ == 0 ? 10 : done * 10 / total_;
    if (tenths <= shownTenths_) return;
    shownTenths_ = tenths;
    std::fprintf(stderr, "%s %zu/%zu%s\n", label_.c_str(), done, total_, tail.c_str());
}

}  // namespace dioptre
