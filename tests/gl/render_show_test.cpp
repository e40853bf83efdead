// --show: the stages of a frame as pictures.
#include <string>

#include "core/error.hpp"
#include "gl_fixture.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

/// Near, in focus and far, each a third of the picture.
Scene threeDepths() {
    SceneBuilder b;
    const View view = testView();
    b.wall(4.0, b.textured(checkerImage(8)), 20.0);
    b.quad(view, {64.0, -9.0, 128.0, 153.0}, 1.0, b.unlit({0.2f, 0.6f, 0.3f}));
    b.quad(view, {-9.0, -9.0, 64.0, 153.0}, 0.4, b.unlit({0.9f, 0.4f, 0.1f}));
    return b.scene();
}

class ShowGLTest : public GlTest {
  protected:
    Image show(TechniqueChoice technique, ShowStage stage, int msaa = 0) {
        Shot shot;
        shot.msaa = msaa;
        shot.lens = lensFor(shot.view, 9.0, 1.0, 2.5);
        shot.show = stage;
        return draw(technique, scene_, shot);
    }
    static bool isConstant(const Image& image) {
        return worstDifference(image, constantImage(image.width, image.height, glm::vec3(pixelAt(image, 0, 0))))
                   .linear < 1.0 / 255.0;
    }

  private:
    const GpuScene scene_{threeDepths()};
};

TEST_F(ShowGLTest, VergenceIsBrightestWhereNearest) {
    for (const TechniqueChoice technique : kTechniques)
        for (const int msaa : {0, 4}) {
            const Image picture = show(technique, {ShowChoice::vergence, 0}, msaa);
            EXPECT_NEAR(pixelAt(picture, 30, 70).x, 2.5 / 3.5, 0.001) << techniqueName(technique);
            EXPECT_NEAR(pixelAt(picture, 96, 70).x, 0.5, 0.001) << techniqueName(technique);
            EXPECT_NEAR(pixelAt(picture, 160, 70).x, 0.2, 0.001) << techniqueName(technique);
        }
}

TEST_F(ShowGLTest, CircleOfConfusionIsRedBeforeAndBlueBehindFocus) {
    for (const TechniqueChoice technique : kTechniques) {
        const Image picture = show(technique, {ShowChoice::coc, 0});
        const glm::dvec3 before = pixelAt(picture, 30, 70), sharp = pixelAt(picture, 96, 70),
                         behind = pixelAt(picture, 160, 70);
        EXPECT_NEAR(before.x, 9.0 / 16.0, 0.01) << techniqueName(technique);  // 9 px, full at 16
        EXPECT_NEAR(glm::length(sharp), 0.0, 0.01) << techniqueName(technique);
        EXPECT_NEAR(behind.z, 4.5 / 16.0, 0.01) << techniqueName(technique);  // |1 - 0.25| / |1 - 2.5| D of 9 px
        EXPECT_LT(behind.x, behind.z) << techniqueName(technique);
    }
}

TEST_F(ShowGLTest, DegreeOfBlurHasNoSign) {
    for (const TechniqueChoice technique : kTechniques) {
        const Image picture = show(technique, {ShowChoice::dob, 0});
        EXPECT_NEAR(pixelAt(picture, 30, 70).x, 9.0 / 16.0, 0.01) << techniqueName(technique);
        EXPECT_NEAR(pixelAt(picture, 96, 70).x, 0.0, 0.01) << techniqueName(technique);
        EXPECT_NEAR(pixelAt(picture, 160, 70).x, 4.5 / 16.0, 0.01) << techniqueName(technique);
    }
}

TEST_F(ShowGLTest, MipmapShowsAllOfItsStages) {
    struct Named {
        const char* name;
        ShowStage stage;
    };
    const Image final = show(TechniqueChoice::mipmap, {});
    for (const Named& n : {Named{"vergence", {ShowChoice::vergence, 0}}, Named{"coc", {ShowChoice::coc, 0}},
                           Named{"dob", {ShowChoice::dob, 0}}, Named{"don", {ShowChoice::don, 0}},
                           Named{"level", {ShowChoice::level, 0}}, Named{"pyramid:0", {ShowChoice::pyramid, 0}},
                           Named{"pyramid:1", {ShowChoice::pyramid, 1}}, Named{"pyramid:2", {ShowChoice::pyramid, 2}},
                           Named{"pyramid:3", {ShowChoice::pyramid, 3}}})
        for (const int msaa : {0, 4}) {
            const Image picture = show(TechniqueChoice::mipmap, n.stage, msaa);
            EXPECT_EQ(picture.width, 192) << n.name;
            EXPECT_EQ(picture.height, 144) << n.name;
            EXPECT_EQ(countNotFinite(picture), 0u) << n.name;
            EXPECT_FALSE(isConstant(picture)) << n.name << ": one colour, " << pixelAt(picture, 0, 0).x;
            EXPECT_GT(worstDifference(picture, final).linear, 0.05) << n.name << ": is the picture itself";
        }
}

// Past its deepest level there is nothing to show: an error or the deepest one, but no garbage.
TEST_F(ShowGLTest, DeepPyramidLevelsAreFiniteOrRefused) {
    for (int level = 0; level <= 12; ++level) {
        try {
            EXPECT_EQ(countNotFinite(show(TechniqueChoice::mipmap, {ShowChoice::pyramid, level})), 0u)
                << "level " << level;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("level"), std::string::npos) << error.what();
        }
    }
}

TEST_F(ShowGLTest, PinholeRefusesStagesItDoesNotHave) {
    for (const ShowChoice stage : {ShowChoice::don, ShowChoice::level, ShowChoice::lod, ShowChoice::pyramid})
        EXPECT_THROW(show(TechniqueChoice::pinhole, {stage, 0}), InputError) << "stage " << int(stage);
    // And goes on afterwards.
    EXPECT_GT(pixelAt(show(TechniqueChoice::pinhole, {}), 30, 70).x, 0.85);
}

TEST_F(ShowGLTest, NothingInViewIsBlack) {
    const GpuScene empty{Scene{}};
    for (const TechniqueChoice technique : kTechniques)
        for (const ShowChoice stage : {ShowChoice::vergence, ShowChoice::coc, ShowChoice::dob}) {
            Shot shot;
            shot.lens = {Metres(0.002), Metres(0.01667), Dioptres(0.0)};
            shot.show.stage = stage;
            const Worst worst = worstDifference(draw(technique, empty, shot), constantImage(192, 144, glm::vec3(0.0f)));
            EXPECT_EQ(worst.linear, 0.0) << techniqueName(technique) << ", stage " << int(stage) << ", " << worst;
        }
}

}  // namespace
}  // namespace dioptre
