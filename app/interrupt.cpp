#include "interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

#include "core/file.hpp"

namespace dioptre {

namespace {

volatile std::sig_atomic_t watched = 0;
constexpr std::int64_t kNever = -1;
std::atomic<std::int64_t> caught = kNever;  // milliseconds of a monotonic clock
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// timeout(1) and others signal the process and then its group: the same wish twice.
constexpr std::int64_t kSameWish = 100;

void onSignal(int signal) {
    timespec clock{};
    ::clock_gettime(CLOCK_MONOTONIC, &clock);
    const std::int64_t now = std::int64_t{clock.tv_sec} * 1000 + clock.tv_nsec / 1000000;
    std::int64_t first = kNever;
    if (watched && (caught.compare_exchange_strong(first, now) || now - first < kSameWish)) return;
    removeUnfinishedFile();
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // comes when this handler has returned
}

}  // namespace

void handleSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action.sa_handler = onSignal;
        action.sa_flags = SA_RESTART;
        ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

void watchInterrupts() {
    watched = 1;
}

bool interrupted() {
    return caught != kNever;
}

}  // namespace dioptre
