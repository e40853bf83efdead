// Pictures in files: round trips, sRGB, malformed input.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "core/color.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image.hpp"

namespace dioptre {
namespace {

namespace fs = std::filesystem;

class ImageTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directory(folder); }
    void TearDown() override { fs::remove_all(folder); }

    std::string error(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        try {
            readImage(folder / name);
        } catch (const InputError& e) {
            const std::string what = e.what(), start = (folder / name).string() + ": ";
            EXPECT_TRUE(what.starts_with(start)) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            return what.substr(std::min(start.size(), what.size()));
        }
        return "none";
    }

    std::string bytesOf(const std::string& name) { return readFile(folder / name, 1U << 24); }

    fs::path folder = fs::temp_directory_path() / ("dioptre-image-test-" + std::to_string(::getpid()));
};

Image gradient(int width, int height, int channels = 3) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = static_cast<float>(i) * 0.37F / static_cast<float>(image.pixels.size()) * 100.0F - 1.0F;
    return image;
}

TEST_F(ImageTest, LinearFormatsKeepEveryBit) {
    for (const char* name : {"a.pfm", "a.exr", "A.PFM", "A.EXR"}) {
        SCOPED_TRACE(name);
        for (const auto& [width, height] : {std::pair(7, 5), {1, 1}, {33, 40}, {1, 17}}) {
            const Image image = gradient(width, height);
            writeImage(folder / name, image);
            const Image back = readImage(folder / name);
            EXPECT_EQ(back.width, width);
            EXPECT_EQ(back.height, height);
            EXPECT_EQ(back.pixels, image.pixels);

            const Image grey = gradient(width, height, 1);
            writeImage(folder / name, grey);
            const Image repeated = readImage(folder / name);
            ASSERT_EQ(repeated.channels, 3);
            for (std::size_t i = 0; i < repeated.pixels.size(); ++i)
                ASSERT_EQ(repeated.pixels[i], grey.pixels[i / 3]) << i;
        }
    }
}

TEST_F(ImageTest, PngIsSrgbEncodedOnceAndClamped) {
    // Every 8-bit value survives decoding and encoding.
    Image image(256, 2);
    for (int x = 0; x < 256; ++x)
        for (int c = 0; c < 3; ++c)
            image.at(x, 0, c) = image.at(x, 1, c) = static_cast<float>(linearFromSrgb(x / 255.0));
    writeImage(folder / "a.png", image);
    EXPECT_EQ(readImage(folder / "a.png").pixels, image.pixels);

    Image odd(6, 1);
    const float values[] = {-1.0F, 0.0F, 0.21404114F, 1.0F, 70.0F, std::numeric_limits<float>::quiet_NaN()};
    const float expected[] = {0.0F, 0.0F, 0.5019608F, 1.0F, 1.0F, 0.0F};  // 0.5 is 127.5: 128
    for (int x = 0; x < 6; ++x)
        for (int c = 0; c < 3; ++c) odd.at(x, 0, c) = values[x];
    writeImage(folder / "a.png", odd);
    const Image back = readImage(folder / "a.png");
    for (int x = 0; x < 6; ++x) EXPECT_NEAR(srgbFromLinear(back.at(x, 0, 1)), expected[x], 1e-6F) << x;
}

TEST_F(ImageTest, PfmIsLittleEndianFromTheBottom) {
    Image image(1, 2);
    image.pixels = {1, 2, 3, 4, 5, 6};
    writeImage(folder / "a.pfm", image);
    const std::string header = "PF\n1 2\n-1.0\n";
    const float rows[] = {4, 5, 6, 1, 2, 3};
    EXPECT_EQ(bytesOf("a.pfm"), header + std::string(reinterpret_cast<const char*>(rows), sizeof rows));
    // Big-endian is read too.
    EXPECT_EQ(error("b.pfm", std::string("Pf\n1 1\n1.0\n\x3F\x80\0\0", 15)), "none");
    EXPECT_EQ(readImage(folder / "b.pfm").pixels, std::vector<float>({1, 1, 1}));
}

TEST_F(ImageTest, MalformedPfmIsNamed) {
    const std::string pixel(12, '\0');
    EXPECT_EQ(error("a.pfm", ""), "header ends early");
    EXPECT_EQ(error("a.pfm", "PF\n1"), "header ends early");
    EXPECT_EQ(error("a.pfm", "P6\n1 1\n255\n" + pixel), "not a PFM file: it starts with 'P6'");
    EXPECT_EQ(error("a.pfm", "PF\n1 1\n-1.0\n" + pixel.substr(1)), "holds 11 bytes of pixels, its size asks for 12");
    EXPECT_EQ(error("a.pfm", "PF\n1 1\n-1.0\n" + pixel + "x"), "holds 13 bytes of pixels, its size asks for 12");
    EXPECT_EQ(error("a.pfm", "PF\n1 one\n-1.0\n" + pixel), "size '1' by 'one'");
    EXPECT_EQ(error("a.pfm", "PF\n1 1\n0\n" + pixel), "scale '0' is not a finite number other than 0");
    EXPECT_EQ(error("a.pfm", "PF\n1 1\nnan\n" + pixel), "scale 'nan' is not a finite number other than 0");
    for (const char* size : {"-1 1", "0 1", "1 0", "99999 1", "32768 32768"})
        EXPECT_TRUE(error("a.pfm", "PF\n" + std::string(size) + "\n-1.0\n" + pixel).starts_with("size ")) << size;
    EXPECT_TRUE(error("a.pfm", "PF\n" + std::string(1000, '9') + " 1\n-1\n").starts_with("header ends early"));
    const float bad[] = {0, std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()};
    EXPECT_EQ(error("a.pfm", "PF\n1 1\n-1.0\n" + std::string(reinterpret_cast<const char*>(bad), sizeof bad)),
              "2 of 3 values are not finite");
}

TEST_F(ImageTest, TruncatedFilesAreErrorsAtEveryLength) {
    for (const std::string name : {"a.png", "a.exr", "a.pfm"}) {
        writeImage(folder / name, gradient(20, 20));
        const std::string bytes = bytesOf(name);
        // The last 4 bytes of a PNG are a checksum of its empty end mark, which stb does not look at.
        const std::size_t longest = name == "a.png" ? bytes.size() - 13 : bytes.size() - 1;
        for (std::size_t length = 0; length <= longest; length += length < 200 ? 1 : 37)
            ASSERT_NE(error("cut" + name, bytes.substr(0, length)), "none") << name << " cut to " << length;
    }
}

TEST_F(ImageTest, CorruptedFilesNeverCrash) {
    for (const std::string name : {"a.png", "a.exr"}) {
        writeImage(folder / name, gradient(20, 20));
        const std::string bytes = bytesOf(name);
        for (std::size_t i = 0; i < bytes.size(); i += i < 400 ? 1 : 29) {
            for (const char flip : {'\xFF', '\x01', '\x80'}) {
                std::string broken = bytes;
                broken[i] = static_cast<char>(broken[i] ^ flip);
                error("broken-" + name, broken);  // an error or a picture, never anything else
            }
        }
    }
}

TEST_F(ImageTest, APngThatClaimsTooMuchIsRefusedBeforeMemoryIsTaken) {
    writeImage(folder / "a.png", gradient(4, 4));
    std::string bytes = bytesOf("a.png");
    bytes[18] = 0x20;  // width 8196
    bytes[22] = 0x20;  // height 8196
    EXPECT_TRUE(error("b.png", bytes).starts_with("broken PNG file: ")) << error("b.png", bytes);
    bytes[17] = 0x20;  // width 2 million
    EXPECT_TRUE(error("b.png", bytes).starts_with("size 2105348x8196 is not within")) << error("b.png", bytes);
}

TEST_F(ImageTest, OtherFormatsInDisguiseAreNotRead) {
    EXPECT_EQ(error("a.png", "GIF89a"), "not a PNG file");
    EXPECT_TRUE(error("a.exr", "PF\n1 1\n-1\n").starts_with("broken OpenEXR file: "));
}

TEST_F(ImageTest, UnknownExtensionsAndMissingFoldersAreUsageErrors) {
    const Image image(1, 1);
    for (const char* name : {"a.jpg", "a", "a.", ".png", "no/such/a.png", ""}) {
        EXPECT_THROW(writeImage(folder / name, image), InputError) << name;
        EXPECT_THROW(requireImageName(folder / name), InputError) << name;
    }
    EXPECT_THROW(readImage(folder / "a.jpg"), InputError);
    EXPECT_THROW(readImage(folder / "missing.png"), InputError);
    EXPECT_NO_THROW(requireImageName(folder / "a.png"));
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(ColorTest, SrgbIsItsOwnInverseAndContinuous) {
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0;
        EXPECT_NEAR(linearFromSrgb(srgbFromLinear(x)), x, 1e-7) << x;
    }
    EXPECT_NEAR(srgbFromLinear(0.0031308), srgbFromLinear(0.00313081), 1e-6);
    EXPECT_EQ(srgbFromLinear(0.0), 0.0);
    EXPECT_NEAR(srgbFromLinear(1.0), 1.0, 1e-15);
    EXPECT_NEAR(srgbFromLinear(0.18), 0.4613561, 1e-6);
}

}  // namespace
}  // namespace dioptre
