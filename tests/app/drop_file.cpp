// dioptre_drop_file WINDOW FILE: drops a file onto a window as a file manager does (XDND, version 5, freedesktop.org).
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

class Source {
  public:
    Source(Window target, std::string list) : target_(target), list_(std::move(list)) {
        if (!display_) return;
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
        send("XdndEnter", 5L << 24, static_cast<long>(atom("text/uri-list")), 0, 0);
        send("XdndPosition", 0, 0, CurrentTime, static_cast<long>(atom("XdndActionCopy")));
    }

    ~Source() {
        if (display_) XCloseDisplay(display_);
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    /// Answers the target until it has taken the file; false if it does not.
    bool run() {
        constexpr int kMilliseconds = 5000;
        if (!display_) return false;
        for (;;) {
            pollfd ready{ConnectionNumber(display_), POLLIN, 0};
            if (XPending(display_) == 0 && ::poll(&ready, 1, kMilliseconds) <= 0) return false;
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) answer(event.xselectionrequest);
            if (event.type != ClientMessage) continue;
            if (event.xclient.message_type == atom("XdndStatus")) send("XdndDrop", 0, CurrentTime, 0, 0);
            // Bit 0 says whether it was taken; GLFW 3.3 puts the number of bytes there.
            if (event.xclient.message_type == atom("XdndFinished")) return event.xclient.data.l[1] != 0;
        }
    }

  private:
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void send(const char* message, long a, long b, long c, long d) {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        const long data[] = {static_cast<long>(window_), a, b, c, d};
        std::copy(std::begin(data), std::end(data), event.xclient.data.l);
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    void answer(const XSelectionRequestEvent& request) {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(list_.data()), static_cast<int>(list_.size()));
        XEvent event{};
        event.xselection = {
            SelectionNotify,  0,           True, display_, request.requestor, request.selection, request.target,
            request.property, request.time};
        XSendEvent(display_, request.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    Display* display_ = XOpenDisplay(nullptr);
    Window window_ = display_ ? XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0) : 0;
    Window target_;
    std::string list_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: dioptre_drop_file WINDOW FILE\n", stderr);
        return 2;
    }
    const std::string uri = "file://" + std::filesystem::absolute(argv[2]).string() + "\r\n";
    return Source(std::strtoul(argv[1], nullptr, 0), uri).run() ? 0 : 1;
}
