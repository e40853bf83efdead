// PSNR, and SSIM of
// Wang, Bovik, Sheikh, Simoncelli 2004: Image Quality Assessment: From Error Visibility to Structural Similarity.
#include "metrics/metrics.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/color.hpp"
#include "core/error.hpp"

namespace dioptre {

namespace {

using Plane = std::vector<float>;  // width * height values
using Planes = std::array<Plane, 3>;

constexpr std::size_t kWindow = 11;
constexpr double kSigma = 1.5;
constexpr float kC1 = 0.01F * 0.01F;  // (K1 L)^2, peak L = 1
constexpr float kC2 = 0.03F * 0.03F;  // (K2 L)^2

// sRGB of values in 0..1 by linear interpolation between 512 points per octave: 10 times as fast as std::pow, wrong by
// less than 2e-7 (the curvature of x^(1/2.4) gives 0.24 / 512^2 / 8 of the value, and float rounds).
class SrgbTable {
  public:
    SrgbTable() {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const auto bits = kFirstBits + (static_cast<std::uint32_t>(i) << kFractionBits);
            values_[i] = static_cast<float>(srgbFromLinear(static_cast<double>(std::bit_cast<float>(bits))));
        }
    }

    float operator()(float linear) const {
        const float x = clampUnit(linear);
        if (x <= 0.0031308F) return 12.92F * x;
        const std::uint32_t offset = std::bit_cast<std::uint32_t>(x) - kFirstBits;
        const std::uint32_t i = offset >> kFractionBits;
        const float t = static_cast<float>(offset & ((1U << kFractionBits) - 1U)) * 0x1p-14F;
        return values_[i] + t * (values_[i + 1] - values_[i]);
    }

  private:
    static constexpr int kFractionBits = 14;  // of the 23 of a float: 9 are left to choose among 512 points
    static constexpr std::uint32_t kFirstBits = std::bit_cast<std::uint32_t>(0x1p-9F);
    std::array<float, 9 * 512 + 2> values_;  // 2^-9 (below the linear toe's end) to 1, and one beyond
};

// What a display shows, one plane per channel.
Planes displayed(const Image& image) {
    static const SrgbTable srgb;
    Planes planes;
    for (Plane& plane : planes) plane.resize(image.pixels.size() / 3);
    for (std::size_t i = 0; i < planes[0].size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) planes[c][i] = srgb(image.pixels[3 * i + c]);
    return planes;
}

double psnrOf(const Planes& a, const Planes& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < a[c].size(); ++i) {
            const double difference = static_cast<double>(a[c][i]) - static_cast<double>(b[c][i]);
            sum += difference * difference;
        }
    }
    const double mse = sum / (3.0 * static_cast<double>(a[0].size()));
    return mse > 0.0 ? -10.0 * std::log10(mse) : std::numeric_limits<double>::infinity();
}

std::array<float, kWindow> gaussianWindow() {
    std::array<double, kWindow> weights{};
    double sum = 0.0;
    constexpr std::size_t kMiddle = kWindow / 2;
    for (std::size_t i = 0; i < kWindow; ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(kMiddle);
        weights[i] = std::exp(-x * x / (2.0 * kSigma * kSigma));
        sum += weights[i];
    }
    std::array<float, kWindow> window{};
    for (std::size_t i = 0; i < kWindow; ++i) window[i] = static_cast<float>(weights[i] / sum);
    return window;
}

// Wang et al. 2004, eq. 13, averaged over one channel:
//   SSIM = (2 ma mb + C1)(2 sab + C2) / ((ma^2 + mb^2 + C1)(saa + sbb + C2)),
// m the window's mean, s its (co)variance. With d = a - b and t = a + b - 1 (centred, values in -1..1):
//   2 ma mb = ma^2 + mb^2 - md^2,  2 sab = saa + sbb - sdd,
//   ma^2 + mb^2 = ((mt + 1)^2 + md^2) / 2,  saa + sbb = (stt + sdd) / 2, so
//   SSIM = (1 - md^2 / (((mt + 1)^2 + md^2) / 2 + C1)) (1 - sdd / ((stt + sdd) / 2 + C2)):
// four filters (t, d, t^2, d^2) in place of five, and no difference of nearly equal products where a is close to b,
// which is what makes float enough.
class SsimFilter {
  public:
    SsimFilter(std::size_t width, std::size_t height) : width_(width), height_(height), across_(width - kWindow + 1) {
        for (auto& row : row_) row.resize(width);
        for (auto& rows : filtered_) rows.resize(kWindow * across_);
        for (auto& sum : sums_) sum.resize(across_);
    }

    double mean(const Plane& a, const Plane& b) {
        double total = 0.0;
        for (std::size_t y = 0; y < height_; ++y) {
            filterAlong(&a[y * width_], &b[y * width_], y % kWindow);
            if (y + 1 >= kWindow) total += rowSum(y + 1 - kWindow);
        }
        return total / (static_cast<double>(across_) * static_cast<double>(height_ - kWindow + 1));
    }

  private:
    // One row of the four quantities, filtered along it into place `slot` of the ring of the last 11 rows.
    void filterAlong(const float* a, const float* b, std::size_t slot) {
        for (std::size_t x = 0; x < width_; ++x) {
            const float t = a[x] + b[x] - 1.0F, d = a[x] - b[x];
            row_[0][x] = t;
            row_[1][x] = d;
            row_[2][x] = t * t;
            row_[3][x] = d * d;
        }
        for (std::size_t k = 0; k < row_.size(); ++k) {
            const float* in = row_[k].data();
            float* out = &filtered_[k][slot * across_];
            for (std::size_t x = 0; x < across_; ++x) {
                float sum = window_[kWindow / 2] * in[x + kWindow / 2];
                for (std::size_t i = 0; i < kWindow / 2; ++i) sum += window_[i] * (in[x + i] + in[x + kWindow - 1 - i]);
                out[x] = sum;
            }
        }
    }

    // SSIM summed over the windows whose first row is `top`.
    double rowSum(std::size_t top) {
        for (std::size_t k = 0; k < sums_.size(); ++k) {
            std::array<const float*, kWindow> in{};
            for (std::size_t i = 0; i < kWindow; ++i) in[i] = &filtered_[k][(top + i) % kWindow * across_];
            float* out = sums_[k].data();
            for (std::size_t x = 0; x < across_; ++x) {
                float sum = window_[kWindow / 2] * in[kWindow / 2][x];
                for (std::size_t i = 0; i < kWindow / 2; ++i) sum += window_[i] * (in[i][x] + in[kWindow - 1 - i][x]);
                out[x] = sum;
            }
        }
        float* values = sums_[0].data();
        for (std::size_t x = 0; x < across_; ++x) {
            const float mt = sums_[0][x], md = sums_[1][x];
            const float stt = std::max(sums_[2][x] - mt * mt, 0.0F), sdd = std::max(sums_[3][x] - md * md, 0.0F);
            const float luminance = 1.0F - md * md / (0.5F * ((mt + 1.0F) * (mt + 1.0F) + md * md) + kC1);
            const float structure = 1.0F - sdd / (0.5F * (stt + sdd) + kC2);
            values[x] = luminance * structure;
        }
        double sum = 0.0;
        for (std::size_t x = 0; x < across_; ++x) sum += static_cast<double>(values[x]);
        return sum;
    }

    std::size_t width_, height_, across_;  // windows side by side
    std::array<float, kWindow> window_ = gaussianWindow();
    std::array<Plane, 4> row_, filtered_, sums_;  // t, d, t^2, d^2
};

double ssimOf(const Planes& a, const Planes& b, int width, int height) {
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    if (w < kWindow || h < kWindow)
        throw InputError("SSIM: pictures of " + std::to_string(width) + "x" + std::to_string(height) +
                         " are too small, its window needs 11x11");
    SsimFilter filter(w, h);
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) sum += filter.mean(a[c], b[c]);
    return sum / 3.0;
}

}  // namespace

void requireComparable(const Image& a, const Image& b) {
    const auto sizeText = [](const Image& image) {
        return std::to_string(image.width) + "x" + std::to_string(image.height) + " with " +
               std::to_string(image.channels) + (image.channels == 1 ? " channel" : " channels");
    };
    if (a.width != b.width || a.height != b.height || a.channels != b.channels)
        throw InputError("pictures of different sizes cannot be compared: " + sizeText(a) + " and " + sizeText(b));
    if (a.channels != 3 || a.width < 1 || a.height < 1)
        throw InputError("pictures of " + sizeText(a) + " cannot be compared, 3 channels are needed");
    for (const Image* image : {&a, &b})
        if (const std::size_t bad = countNotFinite(*image); bad > 0)
            throw InputError("pictures cannot be compared: " + std::to_string(bad) + " values are not finite");
}

Comparison compareImages(const Image& a, const Image& b, double pixelsPerDegree) {
    requireComparable(a, b);
    const Planes shownA = displayed(a), shownB = displayed(b);
    return {psnrOf(shownA, shownB), ssimOf(shownA, shownB, a.width, a.height), flip(a, b, pixelsPerDegree)};
}

double psnr(const Image& a, const Image& b) {
    requireComparable(a, b);
    return psnrOf(displayed(a), displayed(b));
}

double ssim(const Image& a, const Image& b) {
    requireComparable(a, b);
    return ssimOf(displayed(a), displayed(b), a.width, a.height);
}

}  // namespace dioptre
