// dioptre compare: PSNR, SSIM and FLIP of two picture files.
#include <fmt/format.h>

#include <cstdio>

#include "commands.hpp"
#include "core/image.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {

void runCompare(const Command& command) {
    const Comparison result = compareImages(readImage(command.compareA), readImage(command.compareB));
    std::fputs(fmt::format("PSNR {:.2f} dB  SSIM {:.5f}  FLIP {:.5f}\n", result.psnr, result.ssim, result.flip).c_str(),
               stdout);
}

}  // namespace dioptre
