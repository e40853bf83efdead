// What a frame leaves behind in the GL: no errors, no objects, the state that the next one relies on.
#include <string>

#include "frame/frame_maker.hpp"
#include "gl_fixture.hpp"
#include "gl_objects.hpp"
#include "pictures.hpp"

namespace dioptre {
namespace {

using namespace test;

class HygieneGLTest : public GlTest {
  protected:
    static void expectSame(const GlObjects& before, const std::string& what) {
        const GlObjects after = glObjectsAlive();
        for (std::size_t i = 0; i < after.size(); ++i)
            EXPECT_EQ(after[i], before[i]) << what << ": " << kGlObjectNames[i];
    }
};

Scene aScene() {
    SceneBuilder b;
    const View view = testView();
    b.wall(4.0, b.textured(checkerImage(8)), 10.0);
    b.quad(view, {60.0, 30.0, 120.0, 100.0}, 1.0, b.unlit({0.2f, 0.6f, 0.3f}));
    b.sphere({0.1, -0.1, -0.6}, 0.1, b.material({}));
    return b.camera().scene();
}

Shot aShot(int width, int height, int msaa) {
    Shot shot;
    shot.view = testView(width, height);
    shot.msaa = msaa;
    shot.lens = {Metres(0.02), Metres(0.01667), Dioptres(1.0)};
    return shot;
}

// GlTest asks for errors after each test; here they are tied to a frame.
TEST_F(HygieneGLTest, FramesLeaveNoErrorAndPlainState) {
    const GpuScene scene(aScene());
    for (const TechniqueChoice choice : kTechniques) {
        const auto technique = makeTechnique(choice);
        for (const int msaa : {0, 4, 0})
            for (const int width : {192, 100, 192}) {
                draw(*technique, scene, aShot(width, 80, msaa));
                const std::string what = std::string(techniqueName(choice)) + ", msaa " + std::to_string(msaa);
                EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << what;
                EXPECT_TRUE(glComplaints().empty()) << what << ": " << glComplaints().front();
                EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST)) << what;
                EXPECT_FALSE(glIsEnabled(GL_BLEND)) << what;
                EXPECT_FALSE(glIsEnabled(GL_CULL_FACE)) << what;
                EXPECT_FALSE(glIsEnabled(GL_SCISSOR_TEST)) << what;
                GLint function = 0, unit = 0;
                GLboolean mask = GL_FALSE;
                glGetIntegerv(GL_DEPTH_FUNC, &function);
                glGetBooleanv(GL_DEPTH_WRITEMASK, &mask);
                EXPECT_EQ(function, GL_GREATER) << what;
                EXPECT_EQ(mask, GL_TRUE) << what;
                for (GLuint i = 0; i < 8; ++i) {
                    glGetIntegeri_v(GL_SAMPLER_BINDING, i, &unit);
                    EXPECT_EQ(unit, 0) << what << ", unit " << i;
                }
            }
    }
}

TEST_F(HygieneGLTest, DrawingAgainGivesTheSamePicture) {
    const GpuScene scene(aScene());
    for (const TechniqueChoice choice : kTechniques) {
        const auto technique = makeTechnique(choice);
        for (const int msaa : {0, 4}) {
            const Image first = draw(*technique, scene, aShot(192, 144, msaa));
            // Other sizes, blurs and multisampling in between leave nothing behind.
            draw(*technique, scene, aShot(64, 300, 4 - msaa));
            Shot other = aShot(192, 144, msaa);
            other.lens.apertureRadius = Metres(0.1);
            draw(*technique, scene, other);
            other.lens.apertureRadius = Metres(0.0);
            draw(*technique, scene, other);
            EXPECT_EQ(draw(*technique, scene, aShot(192, 144, msaa)).pixels, first.pixels)
                << techniqueName(choice) << ", msaa " << msaa;
        }
    }
}

TEST_F(HygieneGLTest, ObjectsDoNotPileUpOverFrames) {
    const GpuScene scene(aScene());
    for (const TechniqueChoice choice : kTechniques) {
        const auto technique = makeTechnique(choice);
        const auto frames = [&](int count) {
            for (int i = 0; i < count; ++i)
                draw(*technique, scene, aShot(64 + 16 * (i % 5), 64 + 8 * (i % 3), i % 2 ? 4 : 0));
            draw(*technique, scene, aShot(96, 64, 4));
        };
        frames(15);
        const auto before = glObjectsAlive();
        const std::size_t bytes = technique->bytes();
        frames(50);
        expectSame(before, std::string(techniqueName(choice)));
        EXPECT_EQ(technique->bytes(), bytes) << techniqueName(choice);
    }
}

TEST_F(HygieneGLTest, ObjectsDoNotPileUpOverStagesShown) {
    const GpuScene scene(aScene());
    const std::vector<ShowChoice> ofMipmap{ShowChoice::none, ShowChoice::vergence, ShowChoice::coc,    ShowChoice::dob,
                                           ShowChoice::don,  ShowChoice::level,    ShowChoice::pyramid};
    const std::vector<ShowChoice> ofAccumulate{ShowChoice::none, ShowChoice::coc, ShowChoice::lod};
    for (const auto& [choice, stages] :
         {std::pair(TechniqueChoice::mipmap, ofMipmap), {TechniqueChoice::accumulate, ofAccumulate}}) {
        const auto technique = makeTechnique(choice);
        const auto frames = [&, &stages = stages](std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) {
                Shot shot = aShot(64 + 16 * static_cast<int>(i % 5), 64, 0);
                shot.show.stage = stages[i % stages.size()];
                draw(*technique, scene, shot);
            }
            draw(*technique, scene, aShot(96, 64, 0));
        };
        frames(14);
        const auto before = glObjectsAlive();
        frames(35);
        expectSame(before, std::string(techniqueName(choice)));
    }
}

TEST_F(HygieneGLTest, EverythingIsGivenBack) {
    const auto before = glObjectsAlive();
    {
        Settings s;
        s.view.size = {96, 72};
        FrameMaker maker(aScene(), s);
        for (int i = 0; i < 3; ++i)
            maker.make({0.02 * i, GazeSample{0.02 * i, {0.3 + 0.2 * i, 0.5}, true}, std::nullopt});
        maker.composed();
        EXPECT_GT(maker.techniqueBytes(), std::size_t{2 * 96 * 72 * 12});
    }
    expectSame(before, "after the frame maker");
}

TEST_F(HygieneGLTest, FrameMakersObjectsDoNotPileUp) {
    Settings s;
    s.view.size = {96, 72};
    FrameMaker maker(aScene(), s);
    const auto frame = [&](int i) {
        maker.make({0.02 * i, GazeSample{0.02 * i, {0.05 + 0.1 * (i % 10), 0.1 + 0.08 * (i % 7)}, true}, std::nullopt});
    };
    for (int i = 0; i < 10; ++i) frame(i);
    const auto before = glObjectsAlive();
    for (int i = 10; i < 60; ++i) frame(i);
    expectSame(before, "50 frames");
}

TEST_F(HygieneGLTest, BytesCountWhatIsHeld) {
    const GpuScene scene(aScene());
    for (const TechniqueChoice choice : kTechniques)
        for (const int msaa : {0, 4}) {
            const auto technique = makeTechnique(choice);
            draw(*technique, scene, aShot(192, 144, msaa));
            // At least colour and depth of the geometry pass, RGBA16F and D32F, and their samples.
            EXPECT_GE(technique->bytes(), std::size_t{192 * 144 * 12} * static_cast<std::size_t>(1 + msaa))
                << techniqueName(choice);
        }
}

}  // namespace
}  // namespace dioptre
