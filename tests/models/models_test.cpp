// Every model of the glTF Asset Generator looks as its README says; the models beside it draw.
#include <map>
#include <set>

#include "core/error.hpp"
#include "families.hpp"
#include "frame/frame_maker.hpp"
#include "scene/animation.hpp"

namespace dioptre::test {
namespace {

void checkCompatibility(const std::string& name) {
    const int number = numberOf(name);
    if (number < 4) {
        const Image picture = drawModel(loadModel(name));
        EXPECT_NEAR(pixelsDrawn(picture), 200 * 200, 500);
        expectSame(picture, drawModel(loadModel("Compatibility_00")), "the control model");
        return;
    }
    try {
        loadModel(name);
        ADD_FAILURE() << "was loaded";
    } catch (const InputError& error) {
        EXPECT_NE(
            std::string(error.what()).find(number == 4 ? "minVersion: is 2.1" : "FAKE_materials_quantumRendering"),
            std::string::npos)
            << error.what();
    }
}

void checkPrimitiveMode(const std::string& name) {
    const int number = numberOf(name);
    const Scene scene = unlit(loadModel(name));
    const Image picture = drawModel(scene);
    const bool strokes = number < 4 || (number >= 7 && number < 11);
    if (!strokes) {
        EXPECT_NEAR(pixelsDrawn(picture), 200 * 200, 500);
        expectPlane(
            picture, [](glm::dvec2) { return glm::dvec3(1.0); }, 0.0);
        expectSame(drawModel(loadModel(name)), drawModel(loadModel("Mesh_PrimitiveMode_06")), "triangles, lit");
        return;
    }
    // An outline whose upper right corner is cut low, or whole where points go along all of it.
    const Bounds& bounds = scene.bounds;
    EXPECT_EQ(bounds.min, glm::vec3(-0.5f, -0.5f, 0.0f));
    int inside = 0;
    for (int y = 55; y < 245; ++y)
        for (int x = 55; x < 245; ++x) {
            const double top = 50.0 + (x - 50.0) / 200.0 * 40.0;  // from 0.5 to 0.3
            if (y > top + 3.0) inside += pixelAt(picture, x, y) != glm::dvec3(0.0);
        }
    EXPECT_EQ(inside, 0);
    for (const glm::ivec2 at : {glm::ivec2(50, 150), glm::ivec2(150, 249), glm::ivec2(249, 200), glm::ivec2(150, 70)}) {
        bool drawn = false;
        for (int y = at.y - 2; y <= at.y + 2; ++y)
            for (int x = at.x - 2; x <= at.x + 2; ++x) drawn = drawn || pixelAt(picture, x, y) == glm::dvec3(1.0);
        EXPECT_TRUE(drawn) << "outline at pixel " << at.x << ", " << at.y;
    }
    // With and without indices, segment by segment, as a strip or a loop: the same but for where lines end.
    const int differing = pixelsDiffering(picture, drawModel(unlit(loadModel("Mesh_PrimitiveMode_01"))));
    EXPECT_LE(differing, number == 0 || number == 7 ? 500 : 8);
    if (number >= 7)
        expectSame(picture, drawModel(unlit(loadModel("Mesh_PrimitiveMode_0" + std::to_string(number - 7)))),
                   "unindexed");
}

void checkNode(const std::string& name) {
    constexpr double kMove[9][3] = {{0, 0, 0}, {-2, 2, -2}, {-2, 0, 0},  {0, 2, 0},  {0, 0, -2},
                                    {0, 0, 0}, {0, 0, 0},   {-2, 2, -2}, {-2, 2, -2}};
    const int number = numberOf(name);
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(kMove[number][0], kMove[number][1], kMove[number][2]));
    if (number == 5 || number >= 7) m = glm::rotate(m, std::numbers::pi, {0.0, 1.0, 0.0});
    if (number >= 6) m = glm::scale(m, glm::dvec3(1.2));
    // Node 0 stays, node 1 moves: as the untransformed model with the transform put in by hand.
    Scene byHand = loadModel("Node_Attribute_00");
    ASSERT_EQ(byHand.instances.size(), 2u);
    byHand.instances[1].worldFromMesh = glm::mat4(m);
    View view = frontView(30.0, 40.0);
    view.pose = {{18.0, 12.0, 36.0}, glm::quatLookAt(glm::normalize(glm::dvec3(-18.0, -12.0, -36.0)), {0.0, 1.0, 0.0})};
    const Image picture = drawModel(loadModel(name), view), wanted = drawModel(byHand, view);
    EXPECT_GT(pixelsDrawn(picture), 5000);
    // A matrix in single precision moves an edge by much less than a pixel.
    EXPECT_LE(pixelsDiffering(picture, wanted), kSide);
    if (number > 0) {
        EXPECT_GT(pixelsDiffering(picture, drawModel(loadModel("Node_Attribute_00"), view)), 10 * kSide)
            << "nothing moved";
    }
}

/// The model as its animation has it `seconds` after it began.
Image drawModelAt(const Scene& scene, double seconds) {
    GpuScene gpu(scene);
    PassLog log;
    gpu.pose(poseAt(*scene.motion, seconds), log);
    Shot shot;
    shot.view = frontView();
    return draw(TechniqueChoice::pinhole, gpu, shot);
}

/// How far right of the middle what is drawn lies on average, px.
double offsetOf(const Image& picture) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            if (pixelAt(picture, x, y) != glm::dvec3(0.0)) sum += x + 0.5 - kSide / 2.0, ++count;
    return sum / count;
}

// A cube of 0.6 m, its orange front before the viewer halfway. Moved by 0.1 m along x and back, turned to
// its right and left side, or 0.8 and 1.2 times as large; in steps, evenly or smoothly; over 4 s.
void checkAnimatedNode(const std::string& name) {
    const Scene scene = unlit(loadModel(name));
    ASSERT_TRUE(scene.motion);
    const int side = static_cast<int>(0.6 * 200 * 2.0 / 1.7);  // its front stands 0.3 m nearer
    const auto at = [&](double seconds) { return drawModelAt(scene, seconds); };
    const bool turns = numberOf(name) == 1 || numberOf(name) == 5;
    const Image rest = at(turns ? 1.0 : 0.5);  // neither turned nor smaller
    EXPECT_NEAR(pixelsDrawn(rest), side * side, 4 * side);
    const glm::dvec3 front = seenAt(rest, {0.0, 0.2});
    EXPECT_NEAR(front.x, 1.0, 0.02);
    EXPECT_NEAR(front.y, linearFromSrgb(128 / 255.0), 0.02);
    EXPECT_NEAR(front.z, 0.0, 0.02);

    const auto offset = [&](double seconds) { return offsetOf(at(seconds)); };
    const double tenth = 0.1 * 200 * 2.0 / 1.7;
    expectSame(at(4.0), at(0.0), "after a whole period");
    switch (numberOf(name)) {
        case 0:
        case 4:
            EXPECT_NEAR(offset(0.0), -tenth, 3.0);
            EXPECT_NEAR(offset(1.0), tenth, 3.0);
            EXPECT_NEAR(offset(0.5), 0.0, 0.5);
            // Smoothly is slower at first.
            EXPECT_NEAR(offset(0.25), numberOf(name) == 0 ? -0.5 * tenth : -0.6875 * tenth, 2.0);
            break;
        case 3:
            EXPECT_NEAR(offset(0.9), offset(0.0), 0.01);
            EXPECT_NEAR(offset(1.5), offset(1.0), 0.01);
            EXPECT_NEAR(offset(2.0), tenth, 3.0);
            break;
        case 2:
            EXPECT_NEAR(pixelsDrawn(at(1.0)) / static_cast<double>(pixelsDrawn(at(0.0))),
                        2.25 * std::pow(1.76 / 1.64, 2.0), 0.06);
            EXPECT_NEAR(offset(0.7), 0.0, 0.5);
            break;
        default:
            expectSame(at(3.0), rest, "its front again");
            EXPECT_GT(pixelsDiffering(at(0.0), rest), side * side / 2) << "its right";
            EXPECT_GT(pixelsDiffering(at(2.0), at(0.0)), side * side / 2) << "its left";
            EXPECT_GT(pixelsDrawn(at(0.5)), 1.1 * side * side) << "two sides at once";
    }
}

using Check = void (*)(const std::string& name);
struct Family {
    const char* name;
    int models;
    Check check;
};
constexpr Family kFamilies[] = {{"Animation_Node", 6, checkAnimatedNode},
                                {"Buffer_Interleaved", 5, checkInterleaved},
                                {"Compatibility", 6, checkCompatibility},
                                {"Material", 8, checkMaterial},
                                {"Material_AlphaBlend", 7, checkAlphaBlend},
                                {"Material_AlphaMask", 7, checkAlphaMask},
                                {"Mesh_PrimitiveMode", 16, checkPrimitiveMode},
                                {"Mesh_PrimitivesUV", 9, checkPrimitivesUv},
                                {"Node_Attribute", 9, checkNode},
                                {"Texture_Sampler", 14, checkSampler}};

std::map<std::string, Check> models() {
    std::map<std::string, Check> all;
    for (const Family& family : kFamilies)
        for (int i = 0; i < family.models; ++i) {
            const std::string number = std::to_string(i);
            all[std::string(family.name) + "_" + (i < 10 ? "0" : "") + number] = family.check;
        }
    return all;
}

std::vector<std::string> modelNames() {
    std::vector<std::string> names;
    for (const auto& [name, check] : models()) names.push_back(name);
    return names;
}

class AssetGeneratorTest : public GlTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(AssetGeneratorTest, LooksAsItsReadmeSays) {
    models().at(GetParam())(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Models, AssetGeneratorTest, ::testing::ValuesIn(modelNames()),
                         [](const auto& test) { return test.param; });

TEST(ModelsTest, AllAreInTheTable) {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assetGenerator()))
        if (entry.path().extension() == ".gltf") found.insert(entry.path().stem().string());
    const std::vector<std::string> names = modelNames();
    EXPECT_EQ(found, std::set<std::string>(names.begin(), names.end()));
}

class ModelsGLTest : public GlTest {};

// Whatever else lies in the folder is in the middle of the picture, lit, and in as many colours as it brings.
TEST_F(ModelsGLTest, OtherModelsDraw) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(modelsFolder())) {
        if (entry.path().extension() != ".glb") continue;
        ++count;
        SCOPED_TRACE(entry.path().filename().string());
        const Scene scene = loadGltf(entry.path());
        const GpuScene gpu(scene);
        for (const TechniqueChoice choice : kTechniques) {
            Shot shot;
            shot.view = framedView(scene.bounds, {320, 240});
            const Image picture = draw(choice, gpu, shot);
            EXPECT_GT(pixelsDrawn(picture), picture.width * picture.height / 50) << techniqueName(choice);
        }
        bool colored = false;
        for (const Mesh& mesh : scene.meshes)
            for (const Primitive& primitive : mesh.primitives) colored = colored || !primitive.extras.empty();
        EXPECT_EQ(colored, entry.path().stem().string().ends_with("vertColor"));
    }
    EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace dioptre::test
