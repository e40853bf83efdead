// How long a scene takes from its file until its first frame can be drawn, against the least that this needs: reading
// the file, decoding its images on all cores, uploading its bytes. And the memory that stays.
//
//   bench_load [FILE.glb|builtin:NAME ...]     default builtin:dragons; built-in ones from the warm cache
#include <fmt/format.h>
#include <stb_image.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bench_common.hpp"
#include "core/file.hpp"
#include "frame/frame_maker.hpp"
#include "gl/context.hpp"
#include "scene/builtin.hpp"
#include "scene/gltf_loader.hpp"

namespace dioptre {
namespace {

namespace fs = std::filesystem;

std::uint64_t statusBytes(std::string_view key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != key) continue;
        std::uint64_t kilobytes = 0;
        status >> kilobytes;
        return kilobytes * 1024;
    }
    return 0;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
    return word;
}

/// Reads, decodes, uploads: no check, no conversion. Milliseconds.
double least(const fs::path& file) {
    glFinish();
    const double start = nowMilliseconds();
    const std::string bytes = readFile(file, std::size_t{1} << 31);
    const std::uint32_t jsonLength = wordAt(bytes, 12);
    const auto json = nlohmann::json::parse(bytes.begin() + 20, bytes.begin() + 20 + jsonLength);
    const char* binary = bytes.data() + 20 + jsonLength + 8;
    std::vector<Texture> textures(json.contains("images") ? json["images"].size() : 0);
    struct Decoded {
        int width = 0, height = 0;
        unsigned char* rgba = nullptr;
    };
    std::vector<Decoded> decoded(textures.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i; (i = next++) < decoded.size();) {
            const auto& view = json["bufferViews"][json["images"][i]["bufferView"].get<std::size_t>()];
            int channels = 0;
            decoded[i].rgba = stbi_load_from_memory(
                reinterpret_cast<const unsigned char*>(binary + view.value("byteOffset", std::size_t{0})),
                view["byteLength"].get<int>(), &decoded[i].width, &decoded[i].height, &channels, 4);
        }
    };
    std::vector<std::future<void>> workers;
    for (unsigned t = 1; t < std::max(1u, std::thread::hardware_concurrency()); ++t)
        workers.push_back(std::async(std::launch::async, work));
    work();
    for (auto& worker : workers) worker.get();
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        textures[i] = Texture({GL_SRGB8_ALPHA8, decoded[i].width, decoded[i].height, 1, 0}, "image");
        glTextureSubImage2D(textures[i].name(), 0, 0, 0, decoded[i].width, decoded[i].height, GL_RGBA, GL_UNSIGNED_BYTE,
                            decoded[i].rgba);
        stbi_image_free(decoded[i].rgba);
    }
    const Buffer geometry(bytes.size(), bytes.data(), false, "the file's bytes");
    glFinish();
    return nowMilliseconds() - start;
}

struct Loaded {
    double ready = 0.0, shown = 0.0;  // milliseconds until the first frame can be drawn, and until it is
    std::uint64_t gpu = 0, resident = 0;
};

Loaded firstFrame(const std::string& name) {
    Loaded loaded;
    const std::uint64_t before = statusBytes("VmRSS:");
    glFinish();
    const double start = nowMilliseconds();
    const auto builtin = builtinName(name);
    Scene scene = builtin ? loadBuiltin(*builtin, cacheFolder()) : loadGltf(name);
    Settings settings;
    settings.view.eye = EyeChoice::centre;
    FrameMaker maker(scene, settings);
    glFinish();
    loaded.ready = nowMilliseconds() - start;
    scene.releaseBulk();
    maker.make({});
    loaded.shown = nowMilliseconds() - start;
    loaded.gpu = maker.scene().bytes();
    loaded.resident = statusBytes("VmRSS:") - before;
    return loaded;
}

void measure(const std::string& name) {
    const auto builtin = builtinName(name);
    // Made, if need be, and its file's place found
    if (builtin) loadBuiltin(*builtin, cacheFolder());
    const fs::path exported = fs::temp_directory_path() / fmt::format("dioptre-bench-load-{}.glb", ::getpid());
    if (builtin) writeFileAtomically(exported, builtinGlb(*builtin, {}));
    const fs::path file = builtin ? exported : fs::path(name);
    firstFrame(name);  // compiles shaders
    std::vector<double> ratios, ready, shown, base;
    Loaded loaded;
    for (int i = 0; i < 5; ++i) {
        const double before = least(file);
        loaded = firstFrame(name);
        base.push_back(0.5 * (before + least(file)));
        ready.push_back(loaded.ready);
        shown.push_back(loaded.shown);
        ratios.push_back(ready.back() / base.back());
    }
    const double bytes = static_cast<double>(fs::file_size(file));
    std::fputs(fmt::format("| {} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | **{:.2f}** | {:.1f} | {:.1f} |\n", name,
                           bytes * 1e-6, median(base), median(ready), median(shown), median(ratios),
                           static_cast<double>(loaded.gpu) * 1e-6, static_cast<double>(loaded.resident) * 1e-6)
                   .c_str(),
               stdout);
    std::fflush(stdout);
    if (builtin) fs::remove(exported);
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    try {
        const auto context = dioptre::createHeadlessContext("auto");
        std::fputs(
            "| scene | file, MB | read, decode, upload, ms | ready to draw, ms | first frame drawn, ms | ready / read, "
            "decode, "
            "upload | GPU, MB | resident, MB |\n|---|---|---|---|---|---|---|---|\n",
            stdout);
        if (argc <= 1) dioptre::measure("builtin:dragons");
        for (int i = 1; i < argc; ++i) dioptre::measure(argv[i]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
