// What two eyes see is found once for both; of that each draws what it sees.
#include <gtest/gtest.h>

#include "focus/stereo_rig.hpp"
#include "gl_fixture.hpp"
#include "metrics/metrics.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class SightGLTest : public GlTest {
  protected:
    const View head_ = testView();
    const View left_ = eyeView(Eye::left, head_, Metres(0.063)), right_ = eyeView(Eye::right, head_, Metres(0.063));
    const View eyes_[2] = {left_, right_};
};

// All are half a metre away, where an eye sees them so far `apart`, px, from where the head does.
TEST_F(SightGLTest, HoldsWhatAnyPointOfAnyEyesLensSees) {
    const auto sightOf = [&](double x0, double x1, const Lens& lens) {
        SceneBuilder b;
        b.quad(head_, {x0, 40.0, x1, 60.0}, 0.5, b.unlit(glm::vec3(1.0f)));
        return GpuScene(b.scene()).inSight(eyes_, lens).items.size();
    };
    const Lens sharp{Metres(0.0), Metres(0.017), Dioptres(0.5)};
    const double apart = 0.0315 * focalLengthPixels(head_).x / 0.5;
    EXPECT_EQ(sightOf(50.0, 60.0, sharp), 1u) << "both see it";
    EXPECT_EQ(sightOf(-apart + 0.5, -apart + 5.0, sharp), 1u) << "the left eye alone sees it";
    EXPECT_EQ(sightOf(-apart - 5.0, -apart - 0.5, sharp), 0u) << "neither sees it";
    EXPECT_EQ(sightOf(192.0 + apart - 5.0, 192.0 + apart - 0.5, sharp), 1u) << "the right eye alone sees it";
    EXPECT_EQ(sightOf(192.0 + apart + 0.5, 192.0 + apart + 5.0, sharp), 0u) << "neither sees it";
    const Lens wide = lensFor(head_, 4.0, 0.5, 2.0);
    EXPECT_EQ(sightOf(-apart - 3.5, -apart - 0.5, wide), 1u) << "the rim of the left eye's lens sees it";
    EXPECT_EQ(sightOf(-apart - 8.0, -apart - 4.5, wide), 0u) << "nor does that";
}

TEST_F(SightGLTest, NobodySeesThatItIsShared) {
    SceneBuilder b;
    b.wall(6.0, b.textured(checkerImage(16)), 12.0);
    for (int i = 0; i < 24; ++i) {
        const double x = -60.0 + 13.0 * i, d = 0.4 + 0.3 * ((i * 5) % 7);
        b.quad(head_, {x, 30.0, x + 9.0, 110.0}, d, b.unlit({0.04f * static_cast<float>(i), 0.6f, 0.2f}));
    }
    const GpuScene scene(b.scene());
    const Lens lens = lensFor(head_, 5.0, 0.5, 2.0);
    const Sight sight = scene.inSight(eyes_, lens);
    PassLog log;
    for (const TechniqueChoice choice : kTechniques)
        for (const View& eye : eyes_) {
            EyeFrame frame{scene, eye, lens, 1.0f, 0, {}, log, 8};
            const Image alone = readPicture(makeTechnique(choice)->draw(frame));
            frame.sight = &sight;
            // Matrices are rounded otherwise, by less than a millionth of a pixel.
            EXPECT_GT(compareImages(readPicture(makeTechnique(choice)->draw(frame)), alone).psnr, 80.0)
                << techniqueName(choice);
        }
    // And nothing else is looked at.
    const Sight none{left_.pose, {}};
    EyeFrame frame{scene, left_, lens, 1.0f, 0, {}, log};
    frame.sight = &none;
    const Image nothing = readPicture(makeTechnique(TechniqueChoice::reference)->draw(frame));
    EXPECT_EQ(worstDifference(nothing, constantImage(192, 144, glm::vec3(0.0f))).linear, 0.0);
}

}  // namespace
}  // namespace dioptre
