// What blur must not do: light that is in focus stays where it is, an even picture stays even, edges ramp.
#include <array>
#include <string>

#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class LeakGLTest : public GlTest {};

constexpr double kLeast = 1.0 / 255.0;  // the least that 8 bits show
const glm::vec3 kWhite(1.0f), kBlack(0.0f);

/// An in-focus square at 1 m before a ground at 4 m whose CoC has that radius.
struct SquareBeforeGround {
    Shot shot;
    PixelRect square{72.37, 48.21, 120.37, 96.21};  // pixels cut by the edge too

    SquareBeforeGround(double groundRadius, int msaa) {
        shot.msaa = msaa;
        shot.lens = lensFor(shot.view, groundRadius, 1.0, 0.25);
    }
    Scene scene(glm::vec3 squareColor, glm::vec3 groundColor) const {
        SceneBuilder b;
        b.wall(4.0, b.unlit(groundColor));
        b.quad(shot.view, square, 1.0, b.unlit(squareColor));
        return b.scene();
    }
};

// Rays through a pixel meet on the focal plane: a ground pixel beside the square never sees it. Two pixels are granted
// to the halving of the picture's size.
TEST_F(LeakGLTest, SharpSquareDoesNotLightTheBlurredGround) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    Worst overall;
    for (const double radius : {2.0, 4.0, 8.0, 16.0, 40.0})
        for (const int msaa : {0, 4}) {
            const SquareBeforeGround set(radius, msaa);
            const Image with = draw(*technique, GpuScene(set.scene(kWhite, kBlack)), set.shot);
            const Image without = draw(*technique, GpuScene(set.scene(kBlack, kBlack)), set.shot);
            const Worst worst =
                worstDifference(with, without, [&](int x, int y) { return set.square.distance(x, y) > 2.0; });
            EXPECT_LE(worst.linear, 2.0 * kLeast)
                << "ground CoC radius " << radius << ", msaa " << msaa << ", " << worst;
            EXPECT_LE(worst.encoded, 2.0 * kLeast)
                << "ground CoC radius " << radius << ", msaa " << msaa << ", " << worst;
            overall.linear = std::max(overall.linear, worst.linear);
            overall.encoded = std::max(overall.encoded, worst.encoded);
        }
    RecordProperty("worst_linear_255ths", std::to_string(overall.linear * 255.0));
    RecordProperty("worst_encoded_255ths", std::to_string(overall.encoded * 255.0));
}

// Nor does a lamp, before whatever ground.
TEST_F(LeakGLTest, SharpLampDoesNotLightTheBlurredGround) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    for (const double radius : {2.0, 8.0, 40.0})
        for (const float ground : {0.0f, 0.2f}) {
            const SquareBeforeGround set(radius, 4);
            const Image with = draw(*technique, GpuScene(set.scene(glm::vec3(50.0f), glm::vec3(ground))), set.shot);
            const Worst worst = worstDifference(with, constantImage(192, 144, glm::vec3(ground)),
                                                [&](int x, int y) { return set.square.distance(x, y) > 2.0; });
            EXPECT_LE(worst.encoded, 2.0 * kLeast)
                << "ground CoC radius " << radius << ", radiance " << ground << ", " << worst;
        }
}

// A square a little out of focus reaches as far as its own circle of confusion, not as the ground's. Half a pixel
// counts as sharp; at one the layers mix: what leaks then is held to a strip of 0.15 px around it.
TEST_F(LeakGLTest, NearlySharpSquareReachesOnlyAsFarAsItsOwnBlur) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    double widest = 0.0;
    for (const double groundRadius : {8.0, 16.0, 40.0})
        for (const double own : {-1.0, -0.5, 0.5, 1.0}) {
            SquareBeforeGround set(groundRadius, 4);
            // The square stays at 1 m; focus goes to where it has that radius and the ground keeps its.
            const double perDioptre = (groundRadius - own) / 0.75;
            set.shot.lens = lensFor(set.shot.view, groundRadius, 1.0 + own / perDioptre, 0.25);
            const Image picture = draw(*technique, GpuScene(set.scene(kWhite, kBlack)), set.shot);
            const double reach = std::abs(own) + 2.0;
            double light = 0.0, worst = 0.0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    if (set.square.distance(x, y) <= reach) continue;
                    light += static_cast<double>(picture.at(x, y));
                    worst = std::max(worst, static_cast<double>(picture.at(x, y)));
                }
            const double strip = light / (4.0 * 48.0);
            EXPECT_LE(worst, std::abs(own) < 1.0 ? 2.0 * kLeast : 1.0)
                << "ground CoC radius " << groundRadius << ", the square's " << own << ": " << worst * 255.0 << "/255";
            EXPECT_LE(strip, 0.15) << "ground CoC radius " << groundRadius << ", the square's " << own << ", at most "
                                   << worst * 255.0 << "/255";
            widest = std::max(widest, strip);
        }
    RecordProperty("widest_strip_px", std::to_string(widest));
}

// The other way round: the ground's light does not creep into the square either.
TEST_F(LeakGLTest, BlurredGroundDoesNotLightTheSharpSquare) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    for (const double radius : {2.0, 4.0, 8.0, 16.0, 40.0})
        for (const int msaa : {0, 4}) {
            const SquareBeforeGround set(radius, msaa);
            const Image picture = draw(*technique, GpuScene(set.scene(kBlack, kWhite)), set.shot);
            const PixelRect inner{set.square.x0 + 2, set.square.y0 + 2, set.square.x1 - 2, set.square.y1 - 2};
            const Worst worst = worstDifference(picture, constantImage(192, 144, kBlack),
                                                [&](int x, int y) { return inner.distance(x, y) == 0.0; });
            EXPECT_LE(worst.encoded, 2.0 * kLeast)
                << "ground CoC radius " << radius << ", msaa " << msaa << ", " << worst;
        }
}

class ConstantGLTest : public GlTest {
  protected:
    void expectConstant(const GpuScene& scene, const Shot& shot, glm::vec3 color, const std::string& what) {
        const Image picture = draw(*technique_, scene, shot);
        const Worst worst = worstDifference(picture, constantImage(picture.width, picture.height, color));
        const double bright = static_cast<double>(std::max({1.0f, color.r, color.g, color.b}));
        EXPECT_LE(worst.linear, kLeast * bright) << what << ", " << worst;
        largest_ = std::max(largest_, worst.linear / bright);
    }
    void TearDown() override {
        RecordProperty("worst_255ths", std::to_string(largest_ * 255.0));
        technique_.reset();
        GlTest::TearDown();
    }

  private:
    std::unique_ptr<Technique> technique_ = makeTechnique(TechniqueChoice::mipmap);
    double largest_ = 0.0;
};

constexpr double kRadii[] = {0.0, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 6.0, 12.0, 25.0, 50.0, 100.0};
const glm::vec3 kEvenColors[] = {glm::vec3(0.18f), glm::vec3(4.0f), glm::vec3(3.0f, 0.5f, 8.0f)};

TEST_F(ConstantGLTest, OneWall) {
    for (const glm::vec3 color : kEvenColors) {
        SceneBuilder b;
        b.wall(1.0, b.unlit(color));
        const GpuScene scene(b.scene());
        for (const double radius : kRadii)
            for (const double focus : {0.25, 3.0}) {  // the wall before focus and behind it
                Shot shot;
                shot.lens = lensFor(shot.view, radius, focus, 1.0);
                expectConstant(scene, shot, color,
                               "CoC radius " + std::to_string(radius) + ", focus " + std::to_string(focus) +
                                   " D, red " + std::to_string(color.r));
            }
    }
}

TEST_F(ConstantGLTest, SeveralThingsAtSeveralDepths) {
    const Shot plain;
    for (const glm::vec3 color : kEvenColors) {
        SceneBuilder b;
        const int m = b.unlit(color);
        b.wall(8.0, m);
        b.quad(plain.view, {20.3, 30.2, 90.7, 100.6}, 3.0, m).quad(plain.view, {60.1, 10.9, 150.2, 80.4}, 1.5, m);
        b.quad(plain.view, {110.6, 60.2, 118.3, 140.0}, 0.8, m).quad(plain.view, {-9.0, 90.5, 70.0, 150.0}, 0.4, m);
        b.sphere({0.1, 0.05, -1.0}, 0.12, m);
        const GpuScene scene(b.scene());
        for (const double radius : {1.0, 3.0, 8.0, 25.0, 60.0, 100.0})
            for (const double focus : {0.0, 0.3333, 0.6667, 1.25, 2.5})
                for (const int msaa : {0, 4}) {
                    Shot shot;
                    shot.msaa = msaa;
                    // Radius of the largest blur there is.
                    shot.lens = lensFor(shot.view, radius, focus, focus > 1.25 ? 0.125 : 2.5);
                    expectConstant(scene, shot, color,
                                   "largest CoC radius " + std::to_string(radius) + ", focus " + std::to_string(focus) +
                                       " D, msaa " + std::to_string(msaa) + ", red " + std::to_string(color.r));
                }
    }
}

/// The left half at 0.5 m before a ground at 1 m (in focus) or 4 m; `slant` metres of the edge per metre up.
struct Ramp {
    double diameter = 8.0;
    bool blurredGround = false;
    double slant = 0.0;
    bool whiteEdge = true;
    int msaa = 0;
};

std::ostream& operator<<(std::ostream& out, const Ramp& r) {
    return out << "foreground CoC diameter " << r.diameter << (r.blurredGround ? ", blurred" : ", sharp")
               << " ground, slant " << r.slant << (r.whiteEdge ? ", white on black" : ", black on white") << ", msaa "
               << r.msaa;
}

Image drawRamp(Technique& technique, const Ramp& r) {
    Shot shot;
    shot.view = testView(288, 96);
    shot.msaa = r.msaa;
    shot.lens = lensFor(shot.view, 0.5 * r.diameter, 1.0, 2.0);
    SceneBuilder b;
    b.wall(r.blurredGround ? 4.0 : 1.0, b.unlit(r.whiteEdge ? kBlack : kWhite));
    const double z = -0.5, top = 2.0;
    b.quad({glm::dvec3(-4.0, -top, z), glm::dvec3(-r.slant * top, -top, z), glm::dvec3(r.slant * top, top, z),
            glm::dvec3(-4.0, top, z)},
           b.unlit(r.whiteEdge ? kWhite : kBlack));
    return draw(technique, GpuScene(b.scene()), shot);
}

/// Along all rows, of a contrast of 1: the largest step the right way, the largest one back and where that is.
struct Steps {
    double along = 0.0, back = 0.0;
    int x = 0, y = 0;
};

Steps stepsOf(const Image& picture, bool falling) {
    Steps steps;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 1; x < picture.width; ++x) {
            const double up = static_cast<double>(picture.at(x, y) - picture.at(x - 1, y));
            const double d = falling ? -up : up;
            steps.along = std::max(steps.along, d);
            if (-d > steps.back) steps.back = -d, steps.x = x, steps.y = y;
        }
    return steps;
}

TEST_F(LeakGLTest, ForegroundEdgesRamp) {
    const auto technique = makeTechnique(TechniqueChoice::mipmap);
    double largestStep = 0.0, largestReturn = 0.0;
    for (const double diameter : {8.0, 16.0, 40.0, 100.0})
        for (const bool blurredGround : {false, true})
            for (const double slant : {0.0, 0.577})
                for (const bool whiteEdge : {true, false})
                    for (const int msaa : {0, 4}) {
                        const Ramp ramp{diameter, blurredGround, slant, whiteEdge, msaa};
                        const Image picture = drawRamp(*technique, ramp);
                        const Steps steps = stepsOf(picture, whiteEdge);
                        EXPECT_LE(steps.along, 0.25) << ramp;
                        // Not 0: half floats have 1/2048, and what 8 bits cannot show is no edge.
                        EXPECT_LE(steps.back, kLeast) << ramp << ": goes back by " << steps.back * 255.0 << "/255 at ("
                                                      << steps.x << ", " << steps.y << ")";
                        const int middle = picture.height / 2;
                        const double from = static_cast<double>(picture.at(8, middle));
                        const double to = static_cast<double>(picture.at(picture.width - 9, middle));
                        EXPECT_NEAR(from, whiteEdge ? 1.0 : 0.0, 2.0 * kLeast) << ramp;
                        EXPECT_NEAR(to, whiteEdge ? 0.0 : 1.0, 2.0 * kLeast) << ramp;
                        largestStep = std::max(largestStep, steps.along);
                        largestReturn = std::max(largestReturn, steps.back);
                    }
    RecordProperty("largest_step", std::to_string(largestStep));
    RecordProperty("largest_return_255ths", std::to_string(largestReturn * 255.0));
}

}  // namespace
}  // namespace dioptre
