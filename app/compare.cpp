// dioptre compare: PSNR, SSIM and FLIP of two picture files, and where they differ.
#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "core/image.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

void runCompare(const Command& command) {
    const Image reference = readImage(command.compareA), other = readImage(command.compareB);
    const Comparison result = compareImages(reference, other);
    if (!command.out.empty()) {
        const Image errors = flipMap(reference, other);
        writeImage(command.out, command.out.extension() == ".png" ? errorColours(errors) : errors);
    }
    std::fputs(fmt::format("PSNR {:.2f} dB  SSIM {:.5f}  FLIP {:.5f}\n", result.psnr, result.ssim, result.flip).c_str(),
               stdout);
}

}  // namespace dioptre
