// Milliseconds of the metrics for two pictures of 1024x768.
//
//   bench_metrics
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "bench_common.hpp"
#include "metrics/metrics.hpp"
#include "optics/lens_samples.hpp"

int main() {
    using namespace dioptre;
    Image a(1024, 768), b(1024, 768);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        a.pixels[i] = static_cast<float>(halton(static_cast<int>(i % 100000) + 1, 3));
        b.pixels[i] = 0.9f * a.pixels[i] + 0.1f * static_cast<float>(halton(static_cast<int>(i % 70000) + 1, 5));
    }
    const auto timed = [&](const char* name, auto metric) {
        std::vector<double> times;
        double value = 0.0;
        for (int i = 0; i < 9; ++i) {
            const double start = nowMilliseconds();
            value = metric(a, b);
            times.push_back(nowMilliseconds() - start);
        }
        std::fputs(fmt::format("| {} | {:.1f} | {:.5f} |\n", name, median(times), value).c_str(), stdout);
    };
    std::fputs("| metric | ms | value |\n|---|---|---|\n", stdout);
    timed("PSNR", [](const Image& x, const Image& y) { return psnr(x, y); });
    timed("SSIM", [](const Image& x, const Image& y) { return ssim(x, y); });
    timed("FLIP", [](const Image& x, const Image& y) { return flip(x, y); });
}
