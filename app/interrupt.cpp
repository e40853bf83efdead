#include "interrupt.hpp"

#include <csignal>
#include <ctime>

#include "core/file.hpp"

namespace dioptre {

namespace {

volatile std::sig_atomic_t watched = 0, caught = 0;
timespec caughtAt{};

// timeout(1) and others signal the process and then its group: the same wish twice.
constexpr double kSameWishSeconds = 0.1;

bool repeatsItself() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec - caughtAt.tv_sec) +
               static_cast<double>(now.tv_nsec - caughtAt.tv_nsec) * 1e-9 <
           kSameWishSeconds;
}

void onSignal(int signal) {
    if (watched && !caught) {
        ::clock_gettime(CLOCK_MONOTONIC, &caughtAt);
        caught = 1;
        return;
    }
    if (caught && repeatsItself()) return;
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
    return caught != 0;
}

}  // namespace dioptre
