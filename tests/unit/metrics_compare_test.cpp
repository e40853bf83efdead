// PSNR, SSIM and FLIP against values of independent implementations (tests/data/metrics.csv), and their properties.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "core/color.hpp"
#include "core/error.hpp"
#include "metrics/metrics.hpp"

namespace dioptre {
namespace {

constexpr int kWidth = 64, kHeight = 48;

using Bytes = std::vector<int>;  // 3 * 64 * 48 values in 0..255, display-referred

int& at(Bytes& p, int x, int y, int c) {
    return p[static_cast<std::size_t>((y * kWidth + x) * 3 + c)];
}

// The pictures are described in the first lines of metrics.csv.
Bytes reference() {
    Bytes p(3 * kWidth * kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            at(p, x, y, 0) = x * 255 / 63;
            at(p, x, y, 1) = 28 + 200 * ((x / 6 + y / 5) % 2);
            at(p, x, y, 2) = y * 255 / 47;
        }
    }
    return p;
}

Bytes changed(const std::function<int(Bytes&, int, int, int)>& f, Bytes from = reference()) {
    Bytes to(from.size());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c) at(to, x, y, c) = f(from, x, y, c);
    return to;
}

int box3(Bytes& p, int x, int y, int c) {
    int sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            sum += at(p, std::clamp(x + dx, 0, kWidth - 1), std::clamp(y + dy, 0, kHeight - 1), c);
    return (sum + 4) / 9;
}

Bytes picture(const std::string& name) {
    if (name == "plus8")
        return changed([](Bytes& p, int x, int y, int c) { return std::min(at(p, x, y, c) + 8, 255); });
    if (name == "box3") return changed(box3);
    if (name == "box3x3times") return changed(box3, changed(box3, changed(box3)));
    if (name == "shift1") return changed([](Bytes& p, int x, int y, int c) { return at(p, std::max(x - 1, 0), y, c); });
    if (name == "invertG")
        return changed([](Bytes& p, int x, int y, int c) { return c == 1 ? 255 - at(p, x, y, c) : at(p, x, y, c); });
    if (name == "black") return Bytes(3 * kWidth * kHeight, 0);
    EXPECT_EQ(name, "identical");
    return reference();
}

Image linear(const Bytes& bytes) {
    Image image(kWidth, kHeight);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        image.pixels[i] = static_cast<float>(linearFromSrgb(bytes[i] / 255.0));
    return image;
}

TEST(MetricsTest, AgreeWithIndependentImplementations) {
    std::ifstream file(DIOPTRE_TEST_DATA "/metrics.csv");
    std::vector<std::string> columns;
    int rows = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#')) continue;
        std::vector<std::string> cells;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        if (columns.empty()) {
            columns = cells;
            continue;
        }
        std::map<std::string, std::string> row;
        for (std::size_t i = 0; i < cells.size(); ++i) row[columns[i]] = cells[i];
        const auto value = [&](const char* name) { return std::stod(row.at(name)); };
        SCOPED_TRACE(row["test"]);
        ++rows;

        const Image a = linear(reference()), b = linear(picture(row["test"]));
        const Comparison got = compareImages(a, b);
        if (std::isinf(value("PSNR_rgb_dB"))) {
            EXPECT_TRUE(std::isinf(got.psnr));
        } else {
            EXPECT_NEAR(got.psnr, value("PSNR_rgb_dB"), 1e-5);
        }
        EXPECT_NEAR(got.ssim, value("SSIM_mean_RGB"), 1e-5);
        EXPECT_NEAR(got.flip, value("FLIP67_mean_own"), 1e-5);
        EXPECT_NEAR(flip(a, b, 20.0), value("FLIP20_mean_own"), 1e-5);
        const Image map = flipMap(a, b), hmd = flipMap(a, b, 20.0);
        EXPECT_NEAR(*std::max_element(map.pixels.begin(), map.pixels.end()), value("FLIP67_max_own"), 1e-5);
        EXPECT_NEAR(*std::max_element(hmd.pixels.begin(), hmd.pixels.end()), value("FLIP20_max_own"), 1e-5);
        EXPECT_EQ(psnr(a, b), got.psnr);
        EXPECT_EQ(ssim(a, b), got.ssim);
    }
    EXPECT_EQ(rows, 7);
}

TEST(MetricsTest, EqualPicturesArePerfectToTheBit) {
    const Image a = linear(reference());
    const Comparison same = compareImages(a, a);
    EXPECT_EQ(same.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(same.ssim, 1.0);
    EXPECT_EQ(same.flip, 0.0);
}

TEST(MetricsTest, PsnrAndSsimAreSymmetric) {
    const Image a = linear(reference()), b = linear(picture("box3"));
    EXPECT_EQ(psnr(a, b), psnr(b, a));
    EXPECT_NEAR(ssim(a, b), ssim(b, a), 1e-9);
}

// Closed form: constant pictures u, v have SSIM (2uv + C1) / (u^2 + v^2 + C1) and PSNR -20 log10 |u - v|.
TEST(MetricsTest, ConstantPicturesFollowTheClosedForm) {
    for (const auto& [u, v] : {std::pair(0.0, 1.0), {1.0, 0.98}, {0.9, 0.1}, {0.02, 0.03}, {0.5, 0.5019607843}}) {
        SCOPED_TRACE(std::to_string(u) + " and " + std::to_string(v));
        Image a(31, 17), b(31, 17);
        std::fill(a.pixels.begin(), a.pixels.end(), static_cast<float>(linearFromSrgb(u)));
        std::fill(b.pixels.begin(), b.pixels.end(), static_cast<float>(linearFromSrgb(v)));
        EXPECT_NEAR(ssim(a, b), (2 * u * v + 1e-4) / (u * u + v * v + 1e-4), 1e-5);
        EXPECT_NEAR(psnr(a, b), -20 * std::log10(std::abs(u - v)), 1e-3);
    }
}

TEST(MetricsTest, OnlyWhatADisplayShowsCounts) {
    Image a(16, 16), b(16, 16);
    std::fill(a.pixels.begin(), a.pixels.end(), 1.0F);
    std::fill(b.pixels.begin(), b.pixels.end(), 40.0F);
    EXPECT_EQ(compareImages(a, b).ssim, 1.0);
    EXPECT_EQ(compareImages(a, b).flip, 0.0);
    std::fill(a.pixels.begin(), a.pixels.end(), 0.0F);
    std::fill(b.pixels.begin(), b.pixels.end(), -3.0F);
    EXPECT_TRUE(std::isinf(psnr(a, b)));
}

TEST(MetricsTest, EveryGreyLevelIsEncodedExactly) {
    // Against black: MSE is the square of the encoded value.
    Image black(11, 11), grey(11, 11);
    for (int level = 1; level <= 2000; ++level) {
        const double x = level / 2000.0;
        std::fill(grey.pixels.begin(), grey.pixels.end(), static_cast<float>(x));
        EXPECT_NEAR(std::pow(10.0, -psnr(black, grey) / 20.0), srgbFromLinear(x), 3e-7) << "linear " << x;
    }
}

std::string errorOf(const Image& a, const Image& b) {
    try {
        compareImages(a, b);
    } catch (const InputError& e) {
        return e.what();
    }
    return "none";
}

TEST(MetricsTest, PicturesThatCannotBeComparedAreNamed) {
    EXPECT_EQ(errorOf(Image(20, 30), Image(30, 20)),
              "pictures of different sizes cannot be compared: 20x30 with 3 channels and 30x20 with 3 channels");
    EXPECT_EQ(errorOf(Image(20, 30, 1), Image(20, 30, 1)),
              "pictures of 20x30 with 1 channel cannot be compared, 3 channels are needed");
    EXPECT_EQ(errorOf(Image(10, 40), Image(10, 40)), "SSIM: pictures of 10x40 are too small, its window needs 11x11");
    Image bad(20, 20);
    bad.pixels[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(errorOf(Image(20, 20), bad), "pictures cannot be compared: 1 values are not finite");
    EXPECT_EQ(errorOf(Image(11, 11), Image(11, 11)), "none");
    EXPECT_THROW(flip(Image(20, 20), Image(20, 20), 0.0), InputError);
}

}  // namespace
}  // namespace dioptre
