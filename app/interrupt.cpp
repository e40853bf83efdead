#include "interrupt.hpp"

#include <csignal>

#include "core/file.hpp"

namespace dioptre {

namespace {

volatile std::sig_atomic_t watched = 0, caught = 0;

void onSignal(int signal) {
    if (watched && !caught) {
        caught = 1;
        return;
    }
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
