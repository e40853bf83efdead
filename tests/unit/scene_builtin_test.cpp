// Built-in scenes at a low detail: what they hold, that they are sound, equal at any number of threads, and their
// cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "core/error.hpp"
#include "scene/builtin.hpp"
#include "scene/builtin/model.hpp"
#include "scene/builtin/write_glb.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {
namespace {

namespace fs = std::filesystem;

const BuiltinOptions kCoarse{0.12f, 2, {}};

class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "dioptre-builtin-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    fs::path path;
};

std::string bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

fs::path onlyFile(const fs::path& folder) {
    const fs::directory_iterator found(folder);
    return found == fs::directory_iterator() ? fs::path() : found->path();
}

/// Every triangle has an area, every number is finite, no vertex has more neighbours than a simplifier likes.
void expectSound(const Primitive& primitive, const std::string& name) {
    std::vector<int> valence(primitive.vertices.size(), 0);
    for (const Vertex& v : primitive.vertices) {
        ASSERT_TRUE(std::isfinite(glm::dot(v.position, v.position) + glm::dot(v.uv, v.uv))) << name;
        ASSERT_NEAR(glm::length(v.normal), 1.0f, 1e-4f) << name;
    }
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return primitive.vertices[primitive.indices[i + k]].position; };
        ASSERT_GT(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))), 0.0f) << name << ", triangle " << i / 3;
        for (std::size_t k = 0; k < 3; ++k) ++valence[primitive.indices[i + k]];
    }
    for (const int count : valence) ASSERT_LE(count, 64) << name;
}

struct Content {
    const char* name;
    std::size_t objects, meshes;  // at least
};

class BuiltinScene : public testing::TestWithParam<Content> {};

TEST_P(BuiltinScene, HoldsWhatItPromises) {
    const Scene scene = makeBuiltin(GetParam().name, kCoarse);
    std::set<int> meshes;
    for (const Instance& instance : scene.instances) meshes.insert(instance.mesh);
    EXPECT_GE(scene.instances.size(), GetParam().objects);
    EXPECT_GE(meshes.size(), GetParam().meshes);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "main");
    EXPECT_GE(scene.lights.size(), 2u);
    EXPECT_GE(scene.images.size(), 10u);
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives) expectSound(primitive, mesh.name);
}

// Nearest vertices of the instances before the camera, as depths: the crowd begins at arm's length and ends far off.
TEST_P(BuiltinScene, SpreadsFromArmsLengthToFarOff) {
    const Scene scene = makeBuiltin(GetParam().name, kCoarse);
    const glm::mat4 cameraFromWorld = glm::inverse(scene.cameras[0].worldFromCamera);
    std::vector<int> inRange(4, 0);  // 0.35..1, 1..2.5, 2.5..6, 6..16 m
    float nearest = 1e9f;
    for (const Instance& instance : scene.instances) {
        const auto& primitives = scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives;
        float depth = 1e9f;
        for (const Primitive& primitive : primitives) {
            for (const Vertex& v : primitive.vertices) {
                const glm::vec3 p(cameraFromWorld * instance.worldFromMesh * glm::vec4(v.position, 1.0f));
                const float tangent = std::tan(0.5f * scene.cameras[0].yfovRadians);
                if (p.z < -0.05f && std::abs(p.y) < -tangent * p.z && std::abs(p.x) < -4.0f / 3.0f * tangent * p.z)
                    depth = std::min(depth, -p.z);
            }
        }
        nearest = std::min(nearest, depth);
        const float limits[] = {0.35f, 1.0f, 2.5f, 6.0f, 16.0f};
        for (std::size_t k = 0; k < 4; ++k) inRange[k] += depth >= limits[k] && depth < limits[k + 1] ? 1 : 0;
    }
    EXPECT_NEAR(nearest, 0.45f, 0.1f);
    for (const int count : inRange) EXPECT_GE(count, 2);
}

TEST_P(BuiltinScene, IsTheSameAtAnyNumberOfThreads) {
    const auto with = [](unsigned threads) {
        return builtinGlb(GetParam().name, BuiltinOptions{0.05f, threads, [](std::size_t, std::size_t) {}});
    };
    EXPECT_TRUE(with(1) == with(3));
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene,
                         testing::Values(Content{"toys", 30, 20}, Content{"fishes", 80, 25},
                                         Content{"dragons", 25, 10}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BuiltinTest, ReadsBackWhatItWrites) {
    const TemporaryFolder folder;
    const fs::path file = folder.path / "toys.glb";
    std::ofstream(file, std::ios::binary) << builtinGlb("toys", kCoarse);
    const Scene made = makeBuiltin("toys", kCoarse), read = loadGltf(file);
    EXPECT_THAT(read.warnings, testing::IsEmpty());
    EXPECT_EQ(read.triangleCount(), made.triangleCount());
    ASSERT_EQ(read.instances.size(), made.instances.size());
    for (std::size_t i = 0; i < made.instances.size(); ++i) {
        EXPECT_EQ(read.instances[i].name, made.instances[i].name);
        EXPECT_EQ(read.instances[i].worldFromMesh, made.instances[i].worldFromMesh);
    }
    ASSERT_EQ(read.lights.size(), made.lights.size());
    for (std::size_t i = 0; i < made.lights.size(); ++i) {
        EXPECT_NEAR(glm::distance(read.lights[i].color, made.lights[i].color), 0.0f, 1e-5f);
        EXPECT_NEAR(glm::distance(read.lights[i].position, made.lights[i].position), 0.0f, 1e-5f);
        EXPECT_NEAR(glm::distance(read.lights[i].direction, made.lights[i].direction), 0.0f, 1e-5f);
    }
    EXPECT_EQ(read.images.size(), made.images.size());
    EXPECT_EQ(read.cameras[0].nearMetres, 0.05f);
    ASSERT_EQ(read.materials.size(), made.materials.size());
    for (std::size_t i = 0; i < made.materials.size(); ++i)
        EXPECT_NEAR(glm::distance(read.materials[i].emissive, made.materials[i].emissive), 0.0f, 1e-4f);
}

TEST(BuiltinTest, ChecksumTellsAnyChange) {
    const TemporaryFolder folder;
    const fs::path file = folder.path / "scene.glb";
    Scene scene;
    scene.name = "empty";
    scene.images = {{"grey", 32, 32, std::vector<std::uint8_t>(4096, 128)}};
    const std::string whole = writeGlb(scene, "test", 1);
    const auto holds = [&](const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        return checksumHolds(file);
    };
    EXPECT_TRUE(holds(whole));
    for (const std::size_t at : {std::size_t{5}, std::size_t{150}, whole.size() / 2, whole.size() - 1}) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 4);
        EXPECT_FALSE(holds(changed)) << "byte " << at;
    }
    EXPECT_FALSE(holds(whole.substr(0, whole.size() - 4)));
    EXPECT_FALSE(holds(whole + "more"));
    EXPECT_FALSE(holds(""));
    EXPECT_FALSE(checksumHolds(folder.path / "missing"));
}

TEST(BuiltinTest, CacheIsFilledOnceAndRemadeWhereItIsBroken) {
    const TemporaryFolder folder;
    const fs::path cache = folder.path / "deep" / "cache";
    int parts = 0;
    BuiltinOptions options{0.05f, 2, [&](std::size_t, std::size_t) { ++parts; }};
    const std::size_t triangles = loadBuiltin("toys", cache, options).triangleCount();
    EXPECT_GT(parts, 0);
    const fs::path file = onlyFile(cache);
    const std::string whole = bytesOf(file);
    EXPECT_TRUE(checksumHolds(file));

    parts = 0;
    EXPECT_EQ(loadBuiltin("toys", cache, options).triangleCount(), triangles);
    EXPECT_EQ(parts, 0) << "was made again";

    std::string flipped = whole;
    flipped[whole.size() / 3] = static_cast<char>(flipped[whole.size() / 3] ^ 1);
    for (const std::string& broken :
         {whole.substr(0, whole.size() / 2), std::string("garbage"), std::string(), flipped}) {
        std::ofstream(file, std::ios::binary) << broken;
        parts = 0;
        EXPECT_EQ(loadBuiltin("toys", cache, options).triangleCount(), triangles);
        EXPECT_GT(parts, 0) << "a file of " << broken.size() << " bytes was taken";
        EXPECT_TRUE(bytesOf(file) == whole);
    }
}

TEST(BuiltinTest, IsMadeInMemoryWithoutACache) {
    const TemporaryFolder folder;
    std::ofstream(folder.path / "file") << "in the way";
    const BuiltinOptions options{0.05f, 2, [](std::size_t, std::size_t) {}};
    EXPECT_GT(loadBuiltin("toys", folder.path / "file" / "cache", options).triangleCount(), 1000u);
    EXPECT_GT(loadBuiltin("toys", {}, options).triangleCount(), 1000u);
}

TEST(BuiltinTest, NamesAreCheckedAndListed) {
    EXPECT_EQ(builtinName("toys.glb"), std::nullopt);
    EXPECT_EQ(builtinName("builtin:toys"), "toys");
    EXPECT_EQ(requireBuiltinName("fishes"), "fishes");
    EXPECT_EQ(requireBuiltinName("builtin:studio"), "studio");
    try {
        builtinName("builtin:toy");
        FAIL() << "was taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("toy"), testing::HasSubstr("studio"),
                                                 testing::HasSubstr("dragons")));
    }
}

TEST(BuiltinShapeTest, ClosedShapesHaveTheirVolumeAndEveryEdgeTwice) {
    using namespace builtin;
    const Detail detail;
    const auto sphere = [](const vec3& p) { return glm::length(p) - 1.0f; };
    struct Case {
        const char* name;
        Shape shape;
        double volume;
    };
    const Case cases[] = {{"ball", ball(detail, vec3(0.2f), vec3(1.0f), 64), 4.0 / 3.0 * kPi},
                          {"isosurface", isosurface(sphere, vec3(-1.3f), vec3(1.2f), 40), 4.0 / 3.0 * kPi},
                          {"torus", torus(detail, 1.0f, 0.25f, 96, 48), 2.0 * kPi * kPi * 0.0625},
                          {"lathe", lathe(detail, {{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 64, 400, 0), 2.0 * kPi}};
    for (const Case& c : cases) {
        double volume = 0.0;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::size_t i = 0; i < c.shape.index.size(); i += 3) {
            const std::uint32_t* t = &c.shape.index[i];
            const auto at = [&](int k) { return glm::dvec3(c.shape.position[t[k]]); };
            volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
            for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
        }
        EXPECT_NEAR(volume, c.volume, 0.02 * c.volume) << c.name;
        for (const auto& [edge, count] : edges) {
            ASSERT_EQ(count, 1) << c.name;
            ASSERT_TRUE(edges.contains({edge.second, edge.first})) << c.name << " has a hole";
        }
    }
}

TEST(BuiltinShapeTest, SeamsShareTheirNormals) {
    using namespace builtin;
    const Primitive box = toPrimitive(roundedBox(Detail{}, vec3(1.0f), 0.3f), 0);
    std::map<std::tuple<float, float, float>, glm::vec3> normals;
    for (const Vertex& v : box.vertices) {
        const auto [at, isNew] =
            normals.try_emplace({v.position.x + 0.0f, v.position.y + 0.0f, v.position.z + 0.0f}, v.normal);
        if (!isNew) {
            EXPECT_EQ(at->second, v.normal);
        }
        EXPECT_GT(glm::dot(v.normal, v.position), 0.0f);
    }
}

}  // namespace
}  // namespace dioptre
