// dioptre_grab_window WINDOW FILE.png: what a window shows on the screen.
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "core/color.hpp"
#include "core/image.hpp"

namespace {

dioptre::Image grabbed(Display* display, Window window) {
    XWindowAttributes attributes{};
    if (!XGetWindowAttributes(display, window, &attributes)) return {};
    dioptre::Image image(attributes.width, attributes.height);
    XImage* pixels = XGetImage(display, window, 0, 0, static_cast<unsigned>(attributes.width),
                               static_cast<unsigned>(attributes.height), AllPlanes, ZPixmap);
    if (!pixels) return {};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const unsigned long level = (XGetPixel(pixels, x, y) >> (16 - 8 * c)) & 0xFF;
                image.at(x, y, c) = dioptre::linearFromSrgb(static_cast<float>(level) / 255.0f);
            }
    XDestroyImage(pixels);
    return image;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: dioptre_grab_window WINDOW FILE.png\n", stderr);
        return 2;
    }
    Display* display = XOpenDisplay(nullptr);
    if (!display) return 1;
    try {
        const dioptre::Image image = grabbed(display, std::strtoul(argv[1], nullptr, 0));
        if (image.width == 0) return 1;
        dioptre::writeImage(argv[2], image);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
