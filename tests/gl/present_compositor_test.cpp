// Two eyes' pictures to one: sizes, places, anaglyph, tone mapping; linear to the end.
#include <functional>
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"
#include "present/compositor.hpp"

namespace dioptre {
namespace {

using namespace test;

class CompositorGLTest : public GlTest {
  protected:
    using Color = std::function<glm::vec3(int, int)>;  // of a pixel from the top left

    static Texture picture(int width, int height, const Color& color) {
        Texture texture({GL_RGBA16F, width, height}, "test picture");
        texture.setLinear(false);
        std::vector<float> pixels;
        for (int y = height - 1; y >= 0; --y)  // the GL's first row is the lowest
            for (int x = 0; x < width; ++x) {
                const glm::vec3 c = color(x, y);
                pixels.insert(pixels.end(), {c.r, c.g, c.b, 1.0f});
            }
        glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
        return texture;
    }
    /// `larger`: pixels shown for each of the eyes', along either side.
    Image compose(const Texture& left, const Texture& right, DisplayChoice display, bool swap = false,
                  ToneMapChoice tonemap = ToneMapChoice::none, int larger = 1) {
        PassLog log;
        const PictureSize shown{left.width() * larger, left.height() * larger};
        return readPicture(compositor_.compose({left, right, shown, display, swap, tonemap}, log));
    }
    /// One colour for both eyes, tone mapped.
    glm::dvec3 toneMapped(glm::vec3 color) {
        const Texture eye = picture(2, 2, [&](int, int) { return color; });
        return pixelAt(compose(eye, eye, DisplayChoice::mono, false, ToneMapChoice::neutral), 0, 0);
    }

    // 8x4, all pixels different: x and y in the left one's red and green, the right one's are 16 more.
    const Texture left_ = picture(8, 4, [](int x, int y) { return glm::vec3(x, y, 1.0f); });
    const Texture right_ = picture(8, 4, [](int x, int y) { return glm::vec3(x + 16, y + 16, 2.0f); });

  private:
    Compositor compositor_;
};

/// Compares all pixels of a picture with what they should be.
void expectPixels(const Image& image, const std::function<glm::dvec3(int, int)>& wanted, double tolerance,
                  const char* what) {
    int wrong = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 difference = glm::abs(pixelAt(image, x, y) - wanted(x, y));
            const bool off = !(std::max({difference.x, difference.y, difference.z}) <= tolerance);
            if (off && wrong++ == 0) {
                const glm::dvec3 got = pixelAt(image, x, y);
                ADD_FAILURE() << what << ", pixel (" << x << ", " << y << "): " << got.x << " " << got.y << " "
                              << got.z;
            }
        }
    EXPECT_EQ(wrong, 0) << what;
}

glm::dvec3 leftPixel(double x, double y) {
    return {x, y, 1.0};
}
glm::dvec3 rightPixel(double x, double y) {
    return {x + 16.0, y + 16.0, 2.0};
}

TEST_F(CompositorGLTest, Sizes) {
    const PictureSize eye{321, 77};
    EXPECT_EQ(composedSize(DisplayChoice::mono, eye), eye);
    EXPECT_EQ(composedSize(DisplayChoice::sideBySide, eye), (PictureSize{642, 77}));
    EXPECT_EQ(composedSize(DisplayChoice::sideBySideHalf, eye), eye);
    EXPECT_EQ(composedSize(DisplayChoice::topBottom, eye), (PictureSize{321, 154}));
    EXPECT_EQ(composedSize(DisplayChoice::anaglyph, eye), eye);
    for (const PictureSize size : {PictureSize{8, 4}, {7, 5}, {1, 1}}) {
        const Texture left = picture(size.width, size.height, [](int, int) { return glm::vec3(0.25f); });
        for (const DisplayChoice display :
             {DisplayChoice::mono, DisplayChoice::sideBySide, DisplayChoice::sideBySideHalf, DisplayChoice::topBottom,
              DisplayChoice::anaglyph}) {
            const Image image = compose(left, left, display);
            EXPECT_EQ((PictureSize{image.width, image.height}), composedSize(display, size));
            // Any arrangement of one colour is that colour.
            expectPixels(
                image, [](int, int) { return glm::dvec3(0.25); }, 1e-5, "one colour");
        }
    }
}

TEST_F(CompositorGLTest, MonoIsTheLeftPicture) {
    expectPixels(
        compose(left_, right_, DisplayChoice::mono), [](int x, int y) { return leftPixel(x, y); }, 0.0, "mono");
    expectPixels(
        compose(left_, right_, DisplayChoice::mono, true), [](int x, int y) { return leftPixel(x, y); }, 0.0,
        "mono, swapped");
}

TEST_F(CompositorGLTest, FullPicturesStandNextToEachOtherUntouched) {
    const auto beside = [](int x, int y) { return x < 8 ? leftPixel(x, y) : rightPixel(x - 8, y); };
    expectPixels(compose(left_, right_, DisplayChoice::sideBySide), beside, 0.0, "side by side");
    const auto below = [](int x, int y) { return y < 4 ? leftPixel(x, y) : rightPixel(x, y - 4); };
    expectPixels(compose(left_, right_, DisplayChoice::topBottom), below, 0.0, "top-bottom, left on top");
}

TEST_F(CompositorGLTest, OddSizesStandNextToEachOtherUntouchedToo) {
    const int w = 37, h = 29;
    const Texture left = picture(w, h, [](int x, int y) { return glm::vec3(x, y, 1.0f); });
    const Texture right = picture(w, h, [](int x, int y) { return glm::vec3(x + 16, y + 16, 2.0f); });
    const auto beside = [&](int x, int y) { return x < w ? leftPixel(x, y) : rightPixel(x - w, y); };
    expectPixels(compose(left, right, DisplayChoice::sideBySide), beside, 0.0, "side by side");
    const auto below = [&](int x, int y) { return y < h ? leftPixel(x, y) : rightPixel(x, y - h); };
    expectPixels(compose(left, right, DisplayChoice::topBottom), below, 0.0, "top-bottom");
}

TEST_F(CompositorGLTest, HalfPicturesAverageTwoPixels) {
    const auto squeezed = [](int x, int y) {
        return x < 4 ? leftPixel(2 * x + 0.5, y) : rightPixel(2 * (x - 4) + 0.5, y);
    };
    expectPixels(compose(left_, right_, DisplayChoice::sideBySideHalf), squeezed, 1e-5, "side by side, half");
}

TEST_F(CompositorGLTest, SmallerPicturesAreEnlarged) {
    // At a place in the larger picture of 16x8, pixels; beyond the outer pixels' centres nothing changes.
    const auto source = [](double x, int last) { return std::clamp(0.5 * (x + 0.5) - 0.5, 0.0, 1.0 * last); };
    const auto left = [&](double x, double y) { return leftPixel(source(x, 7), source(y, 3)); };
    const auto right = [&](double x, double y) { return rightPixel(source(x, 7), source(y, 3)); };
    const auto larger = [&](DisplayChoice display) {
        return compose(left_, right_, display, false, ToneMapChoice::none, 2);
    };
    constexpr double kFiltered = 0.02;  // weights have eight bits
    expectPixels(larger(DisplayChoice::mono), left, kFiltered, "mono");
    const auto beside = [&](int x, int y) { return x < 16 ? left(x, y) : right(x - 16, y); };
    expectPixels(larger(DisplayChoice::sideBySide), beside, kFiltered, "side by side");
    const auto below = [&](int x, int y) { return y < 8 ? left(x, y) : right(x, y - 8); };
    expectPixels(larger(DisplayChoice::topBottom), below, kFiltered, "top-bottom");
    const auto squeezed = [&](int x, int y) { return x < 8 ? left(2 * x + 0.5, y) : right(2 * (x - 8) + 0.5, y); };
    expectPixels(larger(DisplayChoice::sideBySideHalf), squeezed, kFiltered, "half");
}

TEST_F(CompositorGLTest, SwappedEyesChangePlaces) {
    const auto swapped = [](int x, int y) { return x < 8 ? rightPixel(x, y) : leftPixel(x - 8, y); };
    expectPixels(compose(left_, right_, DisplayChoice::sideBySide, true), swapped, 0.0, "side by side");
    const auto squeezed = [](int x, int y) {
        return x < 4 ? rightPixel(2 * x + 0.5, y) : leftPixel(2 * (x - 4) + 0.5, y);
    };
    expectPixels(compose(left_, right_, DisplayChoice::sideBySideHalf, true), squeezed, 1e-5, "half");
    const auto below = [](int x, int y) { return y < 4 ? rightPixel(x, y) : leftPixel(x, y - 4); };
    expectPixels(compose(left_, right_, DisplayChoice::topBottom, true), below, 0.0, "top-bottom");
}

TEST_F(CompositorGLTest, AnaglyphByDubois) {
    const auto of = [&](glm::vec3 l, glm::vec3 r, bool swap = false) {
        const Texture left = picture(2, 2, [&](int, int) { return l; }),
                      right = picture(2, 2, [&](int, int) { return r; });
        return pixelAt(compose(left, right, DisplayChoice::anaglyph, swap), 1, 1);
    };
    for (const float grey : {0.0f, 0.18f, 0.5f, 1.0f}) {
        const glm::dvec3 seen = of(glm::vec3(grey), glm::vec3(grey));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], static_cast<double>(grey), 0.001) << "grey " << grey;
    }
    // His red-cyan matrices, rows of the result (Dubois 2001; in sum with the other eye's, nothing is cut at 0 here).
    const glm::dvec3 whiteLeft = of(glm::vec3(1.0f), glm::vec3(0.0f)),
                     whiteRight = of(glm::vec3(0.0f), glm::vec3(1.0f));
    EXPECT_NEAR(whiteLeft.x, 0.4561 + 0.500484 + 0.176381, 0.001);
    EXPECT_EQ(whiteLeft.y, 0.0);  // -0.094
    EXPECT_EQ(whiteLeft.z, 0.0);
    EXPECT_EQ(whiteRight.x, 0.0);
    EXPECT_NEAR(whiteRight.y, 0.378476 + 0.73364 - 0.0184503, 0.001);
    EXPECT_NEAR(whiteRight.z, -0.0721527 - 0.112961 + 1.2264, 0.001);
    const glm::dvec3 mixed = of({0.8f, 0.2f, 0.1f}, {0.1f, 0.6f, 0.9f});
    EXPECT_NEAR(mixed.x,
                0.4561 * 0.8 + 0.500484 * 0.2 + 0.176381 * 0.1 - 0.0434706 * 0.1 - 0.0879388 * 0.6 - 0.00155529 * 0.9,
                0.001);
    EXPECT_NEAR(mixed.y,
                -0.0400822 * 0.8 - 0.0378246 * 0.2 - 0.0157589 * 0.1 + 0.378476 * 0.1 + 0.73364 * 0.6 - 0.0184503 * 0.9,
                0.001);
    EXPECT_NEAR(mixed.z,
                -0.0152161 * 0.8 - 0.0205971 * 0.2 - 0.00546856 * 0.1 - 0.0721527 * 0.1 - 0.112961 * 0.6 + 1.2264 * 0.9,
                0.001);
    EXPECT_EQ(of(glm::vec3(1.0f), glm::vec3(0.0f), true), whiteRight);
}

TEST_F(CompositorGLTest, NeutralToneMapKeepsMidtonesAndCapsHighlights) {
    // Khronos: nothing but a black offset of at most 0.04 below 0.76; a pure colour has no offset at all.
    for (const float grey : {0.0f, 0.02f, 0.08f, 0.18f, 0.4f, 0.7f}) {
        const double x = static_cast<double>(grey), offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
        const glm::dvec3 seen = toneMapped(glm::vec3(grey));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], x - offset, 0.001) << "grey " << grey;
    }
    for (int c = 0; c < 3; ++c) {
        glm::vec3 pure(0.0f);
        pure[c] = 0.7f;
        EXPECT_NEAR(toneMapped(pure)[c], 0.7, 0.001);
    }
    double previous = 0.0;
    for (const float bright : {0.5f, 0.7f, 0.8f, 0.9f, 1.0f, 2.0f, 8.0f, 100.0f, 65504.0f}) {
        const glm::dvec3 seen = toneMapped(glm::vec3(bright));
        EXPECT_GT(seen.x, previous) << "grey " << bright;
        EXPECT_LE(seen.x, 1.0) << "grey " << bright;
        previous = seen.x;
        const glm::dvec3 red = toneMapped({bright, 0.1f * bright, 0.1f * bright});
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(red[c] >= 0.0 && red[c] <= 1.0) << "red " << bright << ", channel " << c << ": " << red[c];
        }
    }
    EXPECT_GT(previous, 0.99);
}

TEST_F(CompositorGLTest, NothingIsEncodedOrCut) {
    for (const float value : {0.0f, 0.001f, 0.25f, 0.5f, 3.0f, 20000.0f}) {
        const Texture eye = picture(2, 2, [&](int, int) { return glm::vec3(value); });
        const Image image = compose(eye, eye, DisplayChoice::sideBySide);
        EXPECT_NEAR(static_cast<double>(image.at(0, 0)), static_cast<double>(value),
                    static_cast<double>(value) / 1024.0);
    }
}

TEST(FittedTest, PicturesKeepTheirShapeInTheMiddleOfTheWindow) {
    const auto expect = [](const Placement& place, int x, int y, int width, int height) {
        EXPECT_EQ(place.x, x);
        EXPECT_EQ(place.y, y);
        EXPECT_EQ(place.width, width);
        EXPECT_EQ(place.height, height);
    };
    expect(fitted({320, 120}, {320, 120}), 0, 0, 320, 120);
    expect(fitted({320, 120}, {640, 480}), 0, 120, 640, 240);
    expect(fitted({320, 120}, {640, 120}), 160, 0, 320, 120);
    expect(fitted({320, 120}, {160, 120}), 0, 30, 160, 60);
    expect(fitted({1000, 1}, {10, 10}), 0, 4, 10, 1);
}

}  // namespace
}  // namespace dioptre
