// Skins, morph targets and moving nodes as they are drawn.
#include <glm/gtc/matrix_transform.hpp>

#include "frame/frame_maker.hpp"
#include "gl_fixture.hpp"
#include "moving_scenes.hpp"
#include "pictures.hpp"
#include "scene/animation.hpp"

namespace dioptre {
namespace {

using namespace test;

constexpr TechniqueChoice kAll[] = {TechniqueChoice::pinhole, TechniqueChoice::mipmap, TechniqueChoice::reference};

class MotionGLTest : public GlTest {
  protected:
    static void pose(GpuScene& gpu, const Scene& scene, double seconds) {
        PassLog log;
        gpu.pose(poseAt(*scene.motion, seconds), log);
    }
    /// In focus at 4 m, where most of these scenes are; 8 samples of the lens.
    static Image picture(TechniqueChoice choice, const GpuScene& gpu, double radius = 0.0) {
        Shot shot;
        shot.lens = lensFor(shot.view, radius, 0.25, 1.0);
        PassLog log;
        EyeFrame frame{gpu, shot.view, shot.lens, 1.0f, 0, {}, log};
        frame.samples = 8;
        return readPicture(makeTechnique(choice)->draw(frame));
    }
};

/// The bar goes straight up from the middle of the picture, 58 px a metre.
void expectUpright(const Image& p) {
    EXPECT_NEAR(p.at(96, 60, 0), 1.0f, 0.01f) << "lower half";
    EXPECT_NEAR(p.at(96, 20, 0), 1.0f, 0.01f) << "upper half";
    EXPECT_NEAR(p.at(72, 43, 0), 0.0f, 0.01f) << "to its left";
}
void expectBent(const Image& p) {
    EXPECT_NEAR(p.at(96, 60, 0), 1.0f, 0.01f) << "lower half";
    EXPECT_NEAR(p.at(96, 20, 0), 0.0f, 0.01f) << "where it was";
    EXPECT_NEAR(p.at(72, 43, 0), 1.0f, 0.01f) << "to its left";
}

TEST_F(MotionGLTest, ASkinnedBarBends) {
    const Scene scene = load(bendingBarGltf());
    GpuScene gpu(scene);
    for (const TechniqueChoice technique : kAll) {
        SCOPED_TRACE(techniqueName(technique));
        pose(gpu, scene, 0.0);
        expectUpright(picture(technique, gpu));
        pose(gpu, scene, 1.0);
        expectBent(picture(technique, gpu));
        pose(gpu, scene, 2.0);
        expectUpright(picture(technique, gpu));
    }
    // A pose depends on its time alone, not on those before.
    pose(gpu, scene, 0.7);
    const Image direct = picture(TechniqueChoice::pinhole, gpu);
    pose(gpu, scene, 1.9);
    pose(gpu, scene, 2.7);
    EXPECT_EQ(direct.pixels, picture(TechniqueChoice::pinhole, gpu).pixels);
}

TEST_F(MotionGLTest, InstancesOfAMeshBendByThemselves) {
    Json gltf = bendingBarGltf();
    // A second bar, 0.8 m to the right, bound to joints of its own that do not turn.
    gltf["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
    gltf["nodes"].push_back({{"translation", {0.8, 0, -4}}, {"children", {5}}});
    gltf["nodes"].push_back({{"translation", {0, 0.5, 0}}});
    gltf["skins"].push_back({{"joints", {4, 5}}, {"inverseBindMatrices", 4}});
    gltf["scenes"][0]["nodes"] = {0, 1, 3, 4};
    const Scene scene = load(gltf);
    GpuScene gpu(scene);
    pose(gpu, scene, 1.0);
    const Image p = picture(TechniqueChoice::pinhole, gpu);
    expectBent(p);
    EXPECT_NEAR(p.at(96 + 47, 20, 0), 1.0f, 0.01f) << "the second stands";
}

TEST_F(MotionGLTest, ASkinOfOneJointIsThatJointsPlace) {
    // Turned, moved and scaled by different factors; then mirrored as well, so that front faces run the other way.
    for (const float side : {1.0f, -1.0f}) {
        SCOPED_TRACE(side);
        glm::mat4 m = glm::translate(glm::mat4(1.0f), {0.3f, 0.2f, -4.2f});
        m = glm::rotate(m, 0.4f, glm::normalize(glm::vec3(1, 2, 1)));
        m = glm::scale(m, {side * 1.2f, 0.8f, 0.9f});
        m = glm::translate(m, {0, 0, 4});
        const std::vector<float> matrix(&m[0][0], &m[0][0] + 16);
        Json rigid = morphedSquareGltf(0, 0, false);
        rigid["nodes"][0]["matrix"] = matrix;
        Json skinned = morphedSquareGltf(0, 0, false);
        skinned["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"matrix", matrix}}};
        skinned["scenes"][0]["nodes"] = {0, 1};
        skinned["skins"] = Json::parse(R"([{"joints": [1]}])");
        attributesOf(skinned)["JOINTS_0"] =
            addAccessor(skinned, bytesOf(std::vector<std::uint16_t>(16, 0)), 5123, "VEC4", 4);
        attributesOf(skinned)["WEIGHTS_0"] =
            addFloats(skinned, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
        const Image a = picture(TechniqueChoice::pinhole, GpuScene(load(rigid)));
        const Image b = picture(TechniqueChoice::pinhole, GpuScene(load(skinned)));
        EXPECT_GT(pixelAt(a, 110, 60).x, 0.1);
        // Other sums in single precision: pixels on the edge may change sides.
        const Worst all = worstDifference(a, b), inside = worstDifference(a, b, [](int x, int y) {
                                                     return std::abs(x - 110) < 10 && std::abs(y - 60) < 10;
                                                 });
        EXPECT_LT(all.mean, 1e-4) << all;
        EXPECT_LT(inside.linear, 1e-3) << inside;
    }
}

TEST_F(MotionGLTest, AMorphAtItsWeightIsTheMeshItLeadsTo) {
    for (const auto& [up, wide] : {std::pair(1.0f, 0.0f), {0.0f, 1.0f}, {1.0f, 1.0f}, {0.5f, -0.5f}}) {
        for (const TechniqueChoice technique : kAll) {
            SCOPED_TRACE(testing::Message() << techniqueName(technique) << ", weights " << up << " " << wide);
            const Image plain = picture(technique, GpuScene(load(morphedSquareGltf(up, wide, false))), 4.0);
            const Image morphed = picture(technique, GpuScene(load(morphedSquareGltf(up, wide, true))), 4.0);
            EXPECT_GT(pixelAt(plain, 96, 66).x, 0.1);
            // The positions are equal to the bit; normals are made unit here in single and there in double precision.
            EXPECT_LT(worstDifference(plain, morphed).linear, 2e-3) << worstDifference(plain, morphed);
            if (up == 0.0f) {
                EXPECT_TRUE(plain.pixels == morphed.pixels);
            }
        }
    }
}

TEST_F(MotionGLTest, FlatNormalsFollowTheMorphedFaces) {
    // Without normals: the upper edge goes back by a metre, so that the square leans and catches other light.
    const auto leaning = [](bool morphed) {
        Json gltf = morphedSquareGltf(0, 0, morphed);
        attributesOf(gltf).erase("NORMAL");
        if (morphed) {
            const std::size_t back = addFloats(gltf, {0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, -1}, "VEC3");
            gltf["meshes"][0]["primitives"][0]["targets"][1] = {{"POSITION", back}};
            gltf["meshes"][0]["weights"] = {0, 1};
        } else {
            attributesOf(gltf)["POSITION"] =
                addFloats(gltf, {-0.5f, -0.5f, -4, 0.5f, -0.5f, -4, 0.5f, 0.5f, -5, -0.5f, 0.5f, -5}, "VEC3");
        }
        return picture(TechniqueChoice::pinhole, GpuScene(load(gltf)));
    };
    const Image plain = leaning(false), morphed = leaning(true);
    EXPECT_LT(worstDifference(plain, morphed).linear, 1e-3) << worstDifference(plain, morphed);
    const Image upright = picture(TechniqueChoice::pinhole, GpuScene(load(morphedSquareGltf(0, 0, false))));
    EXPECT_GT(std::abs(pixelAt(plain, 96, 74).x - pixelAt(upright, 96, 74).x), 0.02) << "the light tells";
}

TEST_F(MotionGLTest, AStillMomentRefinesAndAnotherBeginsAnew) {
    const Scene scene = load(bendingBarGltf());
    GpuScene gpu(scene);
    Shot shot;
    shot.lens = lensFor(shot.view, 3.0, 0.25, 1.0);
    const auto technique = makeTechnique(TechniqueChoice::reference);
    PassLog log;
    EyeFrame frame{gpu, shot.view, shot.lens, 1.0f, 0, {}, log};
    frame.samples = 64;
    frame.samplesNow = 4;
    technique->draw(frame);
    const double once = technique->progress();
    pose(gpu, scene, 2.0);  // the same pose, a period later
    technique->draw(frame);
    EXPECT_DOUBLE_EQ(technique->progress(), 2.0 * once);
    pose(gpu, scene, 1.0);
    technique->draw(frame);
    EXPECT_DOUBLE_EQ(technique->progress(), once) << "what was drawn of the pose before is gone";
    Image last;
    while (technique->progress() < 1.0) last = readPicture(technique->draw(frame));
    frame.samplesNow = 0;
    EXPECT_EQ(last.pixels, readPicture(makeTechnique(TechniqueChoice::reference)->draw(frame)).pixels);
}

TEST_F(MotionGLTest, BoundsAndWhatFollowsFromThemAreOfTheMoment) {
    Json gltf = bendingBarGltf();
    addAnimation(gltf, 1, "translation", {0, 1, 2}, {0, 0, -4, 0, 0, -1, 0, 0, -4});
    const Scene scene = load(gltf);
    GpuScene gpu(scene);
    Shot shot;
    shot.lens = lensFor(shot.view, 8.0, 0.25, 1.0);
    for (const double t : {0.0, 0.8, 1.0, 1.2}) {
        pose(gpu, scene, t);
        const double away = t < 1.0 ? 4.0 - 3.0 * t : 1.0 + 3.0 * (t - 1.0);
        const ViewContents range = gpu.contents(shot.view);
        EXPECT_TRUE(range.anything);
        EXPECT_NEAR(range.nearest, 1.0 / away, 1e-3) << t;
        EXPECT_NEAR(range.farthest, 1.0 / away, 1e-3) << t;
        PassLog log;
        const auto technique = makeTechnique(TechniqueChoice::mipmap);
        technique->draw({gpu, shot.view, shot.lens, 1.0f, 0, {}, log});
        EXPECT_EQ(log.count("reach"), t > 0.0 ? 1 : 0) << "a pass for what lies in front of focus, " << t;
    }
}

TEST_F(MotionGLTest, LightsMoveWithTheirNodes) {
    Json gltf = morphedSquareGltf(0, 0, false);
    gltf["extensions"] = Json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 3}]}})");
    gltf["nodes"].push_back(Json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
    gltf["scenes"][0]["nodes"] = {0, 1};
    addAnimation(gltf, 1, "translation", {0, 1, 2}, {-0.5f, 0, -3.5f, 0.5f, 0, -3.5f, 0, 0, 0}, "STEP");
    const Scene scene = load(gltf);
    GpuScene gpu(scene);
    const auto brightness = [&] {
        const Image p = picture(TechniqueChoice::pinhole, gpu);
        return std::pair(pixelAt(p, 72, 72).x, pixelAt(p, 120, 72).x);
    };
    const auto [left, right] = brightness();
    EXPECT_GT(left, 2.0 * right);
    pose(gpu, scene, 0.5);
    EXPECT_EQ(brightness(), std::pair(left, right));
    pose(gpu, scene, 1.5);
    const auto [leftLater, rightLater] = brightness();
    EXPECT_GT(rightLater, 2.0 * leftLater);
}

TEST_F(MotionGLTest, TheViewMovesWithItsCameraUnlessAPoseIsGiven) {
    Json gltf = bendingBarGltf();
    gltf["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.05}}])");
    gltf["nodes"].push_back({{"camera", 0}});
    gltf["scenes"][0]["nodes"] = {0, 1, 3};
    addAnimation(gltf, 3, "translation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 0, 0, 0});
    const Scene scene = load(gltf);
    Settings settings;
    settings.view.size = {192, 144};
    settings.view.eye = EyeChoice::centre;
    settings.render.technique = TechniqueChoice::pinhole;
    settings.render.msaa = 0;
    FrameMaker maker(scene, settings);
    FrameMaker::Input input;
    input.time = 1.0;
    const FrameReport& report = maker.make(input);
    EXPECT_EQ(report.passes.count("pose"), 1);
    EXPECT_NEAR(maker.startingView().pose.position.x, 1.0, 1e-6);
    // The bar, bent, is 58 px to the left of where the still camera has it.
    EXPECT_NEAR(maker.composed().at(96 - 58, 60, 0), 1.0f, 0.01f);
    EXPECT_NEAR(maker.composed().at(72 - 58, 43, 0), 1.0f, 0.01f);
    maker.make(input);
    EXPECT_EQ(maker.make(input).passes.count("pose"), 0) << "nothing moved";
    settings.view.pose = {{0, 0, 0, 0, 0, 0, 1}};
    FrameMaker held(scene, settings);
    held.make(input);
    expectBent(held.composed());
}

}  // namespace
}  // namespace dioptre
