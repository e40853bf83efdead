// Files around the JSON: missing and odd ones, GLB containers, URIs that must not leave the folder, limits.
#include <sys/stat.h>
#include <zlib.h>

#include "scene_gltf_maker.hpp"

namespace dioptre {
namespace {

using namespace test;
namespace fs = std::filesystem;

void expectSays(const std::string& message, const std::string& fragment) {
    EXPECT_TRUE(contains(message, fragment)) << "says: " << message << "\nmust: " << fragment;
}

TEST(GltfFileTest, OddFilesAreRefused) {
    const TemporaryFolder folder;
    expectSays(refusal(folder.path() / "none.glb"), "none.glb: no such file (");
    expectSays(refusal(folder.write("empty.glb", "")), "empty.glb: is empty");
    fs::create_directory(folder.path() / "folder.gltf");
    expectSays(refusal(folder.path() / "folder.gltf"), "folder.gltf: is a directory");
    ASSERT_EQ(mkfifo((folder.path() / "pipe.gltf").c_str(), 0600), 0);
    expectSays(refusal(folder.path() / "pipe.gltf"), "pipe.gltf: is not a plain file");
    expectSays(refusal(folder.write("picture.glb", "\x89PNG\r\n\x1a\n....")),
               "picture.glb: is a PNG picture, not a glTF scene");
    LoadLimits limits;
    limits.maxFileBytes = 10;
    expectSays(refusal(folder.write("large.gltf", "{\"asset\":{}}"), limits), "12 bytes, the limit is 10");
}

TEST(GltfFileTest, BrokenJsonIsOneLine) {
    const TemporaryFolder folder;
    for (const std::string text :
         {"{", "{\n\"asset\":\n,}", "[1,2]", "nonsense", "{\"a\": 1e999}", "\"\xff\"", "{}x"}) {
        SCOPED_TRACE(text);
        EXPECT_NE(refusal(folder.write("scene.gltf", text)), "");
    }
    expectSays(refusal(folder.write("scene.gltf", "{\n  \"asset\": [\n")), "scene.gltf: JSON: parse error at line 3");
    expectSays(refusal(folder.write("scene.gltf", std::string(1'000'000, '['))), "nested deeper than 128 at byte 128");
    LoadLimits limits;
    limits.maxJsonValues = 100;
    std::string many = "[0";
    for (int i = 0; i < 200; ++i) many += ",0";
    expectSays(refusal(folder.write("scene.gltf", many + "]"), limits), "values, the limit is 100");
}

std::string glbOf(Json gltf) {
    std::string binary;
    for (std::size_t i = 0; i < gltf["bufferViews"].size(); ++i) binary += std::string(36, '\0');
    gltf["buffers"] = Json::parse(R"([{"byteLength": 36}])");
    gltf["bufferViews"] = Json::parse(R"([{"buffer": 0, "byteLength": 36}])");
    gltf["accessors"] = Json::parse(R"([{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}])");
    gltf["meshes"][0]["primitives"][0] = Json::parse(R"({"attributes": {"POSITION": 0}})");
    const std::string chunks = glbChunk(kJsonChunk, gltf.dump(), ' ') +
                               glbChunk(kBinaryChunk, bytesOf<float>({0, 0, 0, 2, 0, 0, 0, 2, 0}), '\0');
    return glbHeader(2, static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

TEST(GltfFileTest, ReadsGlb) {
    const TemporaryFolder folder;
    const Scene scene = loadGltf(folder.write("scene.glb", glbOf(triangleGltf())));
    EXPECT_EQ(scene.name, "scene");
    EXPECT_EQ(scene.triangleCount(), 1u);
    EXPECT_EQ(scene.bounds.max, glm::vec3(2, 2, 0));
}

TEST(GltfFileTest, DamagedGlbIsRefused) {
    const TemporaryFolder folder;
    const std::string good = glbOf(triangleGltf());
    const auto says = [&](const std::string& bytes, const std::string& fragment) {
        expectSays(refusal(folder.write("scene.glb", bytes)), fragment);
    };
    const auto with32 = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = good;
        std::memcpy(&bytes[at], &value, 4);
        return bytes;
    };
    says("glTX" + good.substr(4), "GLB header: starts with \"glTX\"");
    says(good.substr(0, 10), "GLB header: the file has 10 bytes");
    says(with32(4, 1), "GLB header: version 1");
    says(with32(8, 8), "GLB header: length 8");
    says(with32(8, 0x7FFFFFFF), "GLB header: length 2147483647, but the file has");
    says(with32(12, 0xFFFFFFFF), "GLB chunk 0: 4294967295 bytes, but only");
    says(with32(16, kBinaryChunk), "GLB chunk 0: type 0x004e4942, the first must be JSON");
    says(good.substr(0, good.size() - 4), "GLB header: length");
    std::string noChunk = glbHeader(2, 24) + bytesOf<std::uint32_t>({0, kJsonChunk, 0});
    says(noChunk, "JSON: parse error");
    // Cut after the JSON chunk: the buffer has nothing to stand on.
    std::uint32_t jsonBytes = 0;
    std::memcpy(&jsonBytes, &good[12], 4);
    std::string cut = good.substr(0, 20 + jsonBytes);
    const auto length = static_cast<std::uint32_t>(cut.size());
    std::memcpy(&cut[8], &length, 4);
    says(cut, "buffers[0].uri: is missing, and there is no GLB binary chunk");
}

class GltfUriTest : public ::testing::Test {
  protected:
    // Positions come from that URI.
    std::string refusalOf(const std::string& uri) {
        Json gltf = triangleGltf();
        gltf["buffers"][0]["uri"] = uri;
        return refusal(folder.write("scenes/scene.gltf", gltf.dump()));
    }
    TemporaryFolder folder;
    const std::string positions = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
};

TEST_F(GltfUriTest, FilesInsideTheFolderAreRead) {
    folder.write("scenes/plain.bin", positions);
    folder.write("scenes/sub/with space.bin", positions);
    folder.write("scenes/\xC3\xA9.bin", positions);
    for (const char* uri : {"plain.bin", "./plain.bin", "sub/../plain.bin", "sub/with%20space.bin",
                            "sub/with space.bin", "%C3%A9.bin", "\xC3\xA9.bin", "%70lain.bin"})
        EXPECT_EQ(refusalOf(uri), "") << uri;
    fs::create_symlink("plain.bin", folder.path() / "scenes/link.bin");
    EXPECT_EQ(refusalOf("link.bin"), "");
}

TEST_F(GltfUriTest, FilesOutsideAreRefused) {
    const fs::path secret = folder.write("secret.bin", positions);
    folder.write("scenes-other/secret.bin", positions);
    folder.write("scenes/sub/in.bin", positions);
    fs::create_symlink(secret, folder.path() / "scenes/link.bin");
    fs::create_directory_symlink(folder.path(), folder.path() / "scenes/up");
    expectSays(refusalOf("../secret.bin"), "buffers[0].uri: \"../secret.bin\" leads out of the scene's folder");
    expectSays(refusalOf("sub/../../secret.bin"), "leads out of");
    expectSays(refusalOf("%2e%2e/secret.bin"), "leads out of");
    expectSays(refusalOf("%2E%2E%2Fsecret.bin"), "leads out of");
    expectSays(refusalOf("../scenes-other/secret.bin"), "leads out of");
    expectSays(refusalOf(secret.string()), "is an absolute path");
    expectSays(refusalOf("%2Fetc/passwd"), "is an absolute path");
    expectSays(refusalOf("link.bin"), "\"link.bin\" links out of the scene's folder");
    expectSays(refusalOf("up/secret.bin"), "links out of");
    expectSays(refusalOf("up/none.bin"), "links out of");
    expectSays(refusalOf("file:///etc/passwd"), "scheme \"file:\"");
    expectSays(refusalOf("http://example.org/a.bin"), "scheme \"http:\"");
    expectSays(refusalOf("a%00.bin"), "contains a zero byte");
    expectSays(refusalOf("a%2.bin"), "without two hex digits");
    expectSays(refusalOf("a%"), "without two hex digits");
    expectSays(refusalOf(""), "is empty");
    expectSays(refusalOf("sub"), "is a directory");
    expectSays(refusalOf("none.bin"), "buffers[0].uri: no such file");
    expectSays(refusalOf("sub/in.bin/x"), "buffers[0].uri: ");
    expectSays(refusalOf("a\n.bin"), "a\\x0a.bin");
    expectSays(refusalOf(std::string(5000, 'a')), "buffers[0].uri: ");
}

TEST_F(GltfUriTest, DataMayBePercentEncoded) {
    std::string uri = "data:application/octet-stream,";
    for (const char c : positions) {
        constexpr char kHex[] = "0123456789ABCDEF";
        uri += {'%', kHex[static_cast<unsigned char>(c) >> 4], kHex[c & 15]};
    }
    EXPECT_EQ(refusalOf(uri), "");
}

TEST(GltfLimitTest, ImagesAreBoundedBeforeDecoding) {
    // A header that promises 2^31 - 1 by 1 texels, then one of 16384 a side; 1 bit each, behind 40 kB of nothing.
    const auto withSize = [&](const std::string& size, std::size_t dataBytes = 40'000) {
        const std::string header = std::string("\0\0\0\rIHDR", 8) + size + std::string("\1\0\0\0\0\0\0\0\0", 9);
        const std::string length{static_cast<char>(dataBytes >> 24), static_cast<char>(dataBytes >> 16),
                                 static_cast<char>(dataBytes >> 8), static_cast<char>(dataBytes)};
        return dataUri("\x89PNG\r\n\x1a\n" + header + length + "IDAT" + std::string(dataBytes + 4, '\0'), "image/png");
    };
    Json gltf = texturedGltf();
    gltf["images"][0]["uri"] = withSize(std::string("\x7F\xFF\xFF\xFF\0\0\0\1", 8));
    expectSays(refusal(gltf), "images[0]: is 2147483647 x 1 texels, the limit is 16384 a side");
    gltf["images"][0]["uri"] = withSize(std::string("\0\0\x40\0\0\0\x40\0", 8));
    LoadLimits limits;
    limits.maxImageBytes = 1000;
    expectSays(refusal(gltf, limits), "images[0]: decodes to 1073741824 bytes, 0 of at most 1000 bytes");
    limits = {};
    limits.maxTotalBytes = 1'000'000;
    expectSays(refusal(gltf, limits), "images[0]: needs 4294967296 bytes more");
}

TEST(GltfLimitTest, DataThatCannotFillAnImageIsRefusedBeforeDecoding) {
    Json gltf = texturedGltf();
    std::string png = decodedBase64(std::string(kPng).substr(std::string(kPng).find(',') + 1));
    png[18] = png[22] = '\x20';  // 8194 x 8193 texels from 17 bytes
    gltf["images"][0]["uri"] = dataUri(png);
    expectSays(refusal(gltf), "images[0]: cannot be decoded: its 74 bytes cannot hold 8194 x 8193 texels");
    png = decodedBase64(std::string(kPng).substr(std::string(kPng).find(',') + 1));
    png[33] = '\x6A';  // its data chunk says it is 1.7 GB
    gltf["images"][0]["uri"] = dataUri(png);
    expectSays(refusal(gltf), "images[0]: cannot be decoded: a PNG chunk is longer than the file");
    // Baseline frame header of 8192 x 8192, a scan and no more
    const std::string jpeg("\xFF\xD8\xFF\xC0\0\x0B\x08\x20\0\x20\0\1\1\x11\0\xFF\xDA\0\x08\1\1\0\0\x3F\0", 25);
    gltf["images"][0]["uri"] = dataUri(jpeg);
    expectSays(refusal(gltf), "images[0]: cannot be decoded: its 25 bytes cannot hold 8192 x 8192 texels");
}

TEST(GltfLimitTest, DataThatUnpacksToMoreThanTheImageIsRefused) {
    // 256 x 256 texels of grey; the data goes on with 20 MB of zeros, in 0.1 MB.
    const auto withData = [](std::size_t bytes) {
        std::string packed(compressBound(static_cast<uLong>(bytes)), '\0');
        uLongf length = static_cast<uLongf>(packed.size());
        const std::vector<Bytef> zeros(bytes);
        compress2(reinterpret_cast<Bytef*>(packed.data()), &length, zeros.data(), static_cast<uLong>(bytes), 1);
        packed.resize(length);
        std::string png = "\x89PNG\r\n\x1a\n";
        const auto addWord = [&](std::size_t word) {
            for (int shift = 24; shift >= 0; shift -= 8) png += static_cast<char>(word >> shift);
        };
        const auto chunk = [&](const std::string& type, const std::string& data) {
            const std::string body = type + data;
            addWord(data.size());
            png += body;
            addWord(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
        };
        chunk("IHDR", std::string("\0\0\1\0\0\0\1\0\x08\0\0\0\0", 13));
        chunk("IDAT", packed);
        chunk("IEND", "");
        Json gltf = texturedGltf();
        gltf["images"][0]["uri"] = dataUri(png);
        return gltf;
    };
    EXPECT_EQ(refusal(withData(256 * 257)), "");
    expectSays(refusal(withData(std::size_t{20} << 20)),
               "images[0]: cannot be decoded: damaged data, or more than 256");
}

TEST(GltfLimitTest, MemoryIsBoundedBeforeAllocation) {
    // No bufferView, so the accessor is all zeros and as long as it likes.
    Json gltf = triangleGltf();
    gltf["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1ull << 40}};
    gltf["meshes"][0]["primitives"][0] = Json::parse(R"({"attributes": {"POSITION": 0}})");
    expectSays(refusal(gltf), "meshes[0].primitives[0].attributes.POSITION: has 1099511627776 elements");
    gltf["accessors"][0]["count"] = 1u << 30;
    expectSays(refusal(gltf), "meshes[0].primitives[0]: needs");
    gltf["accessors"][0]["count"] = 3;
    EXPECT_EQ(refusal(gltf), "");
    // Values of JSON take memory as well.
    gltf["extras"] = std::vector<int>(50'000, 1);
    LoadLimits small;
    small.maxTotalBytes = 4'000'000;
    expectSays(refusal(gltf, small), "JSON: needs 500");
    // The same vertices a hundred times.
    gltf = triangleGltf();
    for (int i = 0; i < 100; ++i) gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
    LoadLimits limits;
    limits.maxTotalBytes = 20'000;
    expectSays(refusal(gltf, limits), "bytes are in use");
}

TEST(GltfLimitTest, DrawsAreCounted) {
    Json gltf = triangleGltf();
    gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
    for (std::size_t i = 1; i < 10; ++i) {
        gltf["nodes"].push_back({{"mesh", 0}});
        gltf["scenes"][0]["nodes"].push_back(i);
    }
    LoadLimits limits;
    limits.maxDraws = 20;
    EXPECT_EQ(refusal(gltf, limits), "");
    limits.maxDraws = 13;
    expectSays(refusal(gltf, limits), "nodes[6].mesh: is primitive 14 to draw, the limit is 13");
}

TEST(GltfLimitTest, WarningsAreCounted) {
    Json gltf = triangleGltf();
    for (int i = 0; i < 10; ++i) gltf["extensionsUsed"].push_back("EXT_" + std::to_string(i));
    for (int i = 0; i < 3; ++i) gltf["materials"].push_back({{"emissiveFactor", {2, 0, 0}}});
    LoadLimits limits;
    limits.maxWarnings = 10;
    const Scene scene = load(gltf, limits);
    ASSERT_EQ(scene.warnings.size(), 11u);
    EXPECT_EQ(scene.warnings[9], "extensionsUsed[9]: EXT_9 is ignored");
    EXPECT_EQ(scene.warnings[10], "3 more warnings");
    EXPECT_EQ(load(gltf).warnings.back(), "materials[1].emissiveFactor: a factor outside 0..1 is clamped (and 2 more)");
}

}  // namespace
}  // namespace dioptre
