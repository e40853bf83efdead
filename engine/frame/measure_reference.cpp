#include "frame/measure_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/content_hash.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/resources.hpp"
#include "frame/measure_content.hpp"
#include "gl/objects.hpp"
#include "render/technique.hpp"

namespace dioptre {

namespace fs = std::filesystem;

namespace {

// To be raised with every change in C++ of what the reference draws, so that older pictures are not taken for it.
constexpr std::uint64_t kGeneratorVersion = 1;
constexpr std::size_t kLargestShader = 1u << 20;
// Between two looks at `stopped`.
constexpr int kBetweenStops = 16;  // samples

/// The shaders that take part, so that a change of lighting makes new references.
void addShaders(ContentHash& hash) {
    std::vector<fs::path> files;
    for (const char* folder : {"shaders/scene", "shaders/common", "shaders/shared"})
        for (const auto& entry : fs::directory_iterator(resource(folder)))
            if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return a.parent_path().filename() / a.filename() < b.parent_path().filename() / b.filename();
    });
    for (const fs::path& file : files) {
        hash.addText(file.filename().string());
        hash.addText(readFile(file, kLargestShader));
    }
}

std::optional<Image> drawHalf(const ReferenceRequest& request, int firstSample, const std::function<bool()>& stopped) {
    const auto technique = makeTechnique(TechniqueChoice::reference);
    PassLog log;
    EyeFrame frame{request.scene, request.view, request.lens, request.exposure, 0, {}, log};
    frame.samples = request.samplesPerHalf;
    frame.firstSample = firstSample;
    frame.samplesNow = kBetweenStops;
    const Texture* picture = nullptr;
    do {
        if (stopped()) return std::nullopt;
        log.clear();
        picture = &technique->draw(frame);
    } while (technique->progress() < 1.0);
    Image image(request.view.width, request.view.height);
    image.pixels = readTexture(*picture, GL_RGB, 3);
    return image;
}

/// What the cache has, if it is whole.
std::optional<Image> readCached(const fs::path& file, const View& view) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return std::nullopt;
    try {
        Image image = readImage(file);
        if (image.width == view.width && image.height == view.height) return image;
        logWarning(fmt::format("{}: {}x{} is not the size asked for: it is drawn anew", file.string(), image.width,
                               image.height));
    } catch (const std::runtime_error& error) {
        logWarning(fmt::format("{}: it is drawn anew", error.what()));
    }
    return std::nullopt;
}

void writeCached(const fs::path& file, const Image& image) {
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    try {
        writeImage(file, image);
    } catch (const std::runtime_error& error) {
        logWarning(fmt::format("{}; the reference is not kept", error.what()));
    }
}

}  // namespace

Image ReferencePictures::mean() const {
    Image image = first;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.5f * (first.pixels[i] + second.pixels[i]);
    return image;
}

std::string referenceKey(const ReferenceRequest& request) {
    ContentHash hash;
    hash.add(kGeneratorVersion);
    addShaders(hash);
    hash.addText(request.renderer);
    hash.addText(request.content);
    const View& v = request.view;
    const Lens& l = request.lens;
    for (const double value :
         {v.pose.position.x, v.pose.position.y, v.pose.position.z, v.pose.orientation.w, v.pose.orientation.x,
          v.pose.orientation.y, v.pose.orientation.z, v.frustum.left, v.frustum.right, v.frustum.bottom, v.frustum.top,
          v.near.value, l.apertureRadius.value, l.focalLength.value, l.focus.value, l.bladeRotation.value,
          static_cast<double>(request.exposure)})
        hash.add(value);
    for (const int value : {v.width, v.height, l.blades, request.samplesPerHalf})
        hash.add(static_cast<std::uint64_t>(value));
    return hash.hex();
}

std::optional<ReferencePictures> referencePictures(const ReferenceRequest& request, const fs::path& cache,
                                                   const std::function<bool()>& stopped) {
    const std::string key = referenceKey(request);
    ReferencePictures pictures;
    Image* halves[] = {&pictures.first, &pictures.second};
    for (int half = 0; half < 2; ++half) {
        // OpenEXR: compressed, and its checksums tell a broken file.
        const fs::path file = cache / fmt::format("{}-{}.exr", key, half + 1);
        auto cached = cache.empty() ? std::nullopt : readCached(file, request.view);
        if (!cached) {
            const double start = nowMilliseconds();
            cached = drawHalf(request, half * request.samplesPerHalf, stopped);
            if (!cached) return std::nullopt;
            pictures.milliseconds += nowMilliseconds() - start;
            if (!cache.empty()) writeCached(file, *cached);
        }
        *halves[half] = std::move(*cached);
    }
    return pictures;
}

}  // namespace dioptre
