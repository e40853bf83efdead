// make_studio: writes the scene that Dioptre opens without arguments, a maker's study at sunset.
//   make_studio OUT.glb [--preview OUT.png] [--camera N] [--aperture-mm D] [--focus METRES] [--samples N] [--size WxH]
//   [--draft]
// Light is baked into the textures, since the viewer has neither shadows nor environment light; everything is
// procedural and seeded, so the file is the same on every run and at any thread count.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include "atlas.hpp"
#include "bake.hpp"
#include "glb.hpp"
#include "preview.hpp"
#include "scene.hpp"

namespace studio {

Model makeStudio() {
    Model model;
    model.daylight = makeDaylight();
    model.cameras.push_back({"main", {0.35f, 1.22f, 0.0f}, {0.35f - 0.139f, 1.22f - 0.122f, -0.98f}, 47.0f});
    model.cameras.push_back({"window", {0.30f, 1.52f, -2.2f}, {0.62f, 1.42f, -4.0f}, 50.0f});
    addShell(model);
    addFurniture(model);
    addBooks(model);
    addDesk(model);
    addDeskThings(model);
    addLamps(model);
    addPlants(model);
    addLand(model);
    addTown(model);
    return model;
}

namespace {

struct Options {
    std::string out, preview;
    PreviewOptions view;
    bool draft = false;
};

Options parse(int count, char** words) {
    Options options;
    for (int k = 1; k < count; ++k) {
        const std::string word = words[k];
        const auto value = [&]() -> std::string {
            if (k + 1 >= count) throw std::runtime_error("make_studio: " + word + " needs a value");
            return words[++k];
        };
        if (word == "--preview")
            options.preview = value();
        else if (word == "--camera")
            options.view.camera = static_cast<std::size_t>(std::stoul(value()));
        else if (word == "--aperture-mm")
            options.view.apertureDiameter = std::stof(value()) * 1e-3f;
        else if (word == "--focus")
            options.view.focusDistance = std::stof(value());
        else if (word == "--samples")
            options.view.samples = std::stoi(value());
        else if (word == "--draft")
            options.draft = true;
        else if (word == "--size") {
            if (std::sscanf(value().c_str(), "%dx%d", &options.view.width, &options.view.height) != 2)
                throw std::runtime_error("make_studio: --size needs WxH");
        } else if (word.starts_with("--") || !options.out.empty())
            throw std::runtime_error("make_studio: unknown argument " + word);
        else
            options.out = word;
    }
    if (options.out.empty())
        throw std::runtime_error(
            "usage: make_studio OUT.glb [--preview OUT.png] [--camera N] [--aperture-mm D] [--focus METRES] [--samples "
            "N] [--size WxH] [--draft]");
    return options;
}

void run(const Options& options) {
    using Clock = std::chrono::steady_clock;
    auto start = Clock::now();
    const auto lap = [&](const char* step) {
        const auto now = Clock::now();
        std::printf("%-10s %6.1f s\n", step, std::chrono::duration<double>(now - start).count());
        start = now;
    };
    Model model = makeStudio();
    std::size_t triangles = 0;
    for (Object& object : model.objects) {
        if (object.finish != Finish::glowing) packCharts(object);
        triangles += object.triangleCount();
        std::printf("%-22s %6zu triangles, texture %d x %d\n", object.name.c_str(), object.triangleCount(),
                    object.textureWidth, object.textureHeight);
    }
    std::printf("%zu objects, %zu triangles\n", model.objects.size(), triangles);
    lap("model");
    BakeQuality quality;
    if (options.draft) quality = {9, 6, 2, 16, 10, 2};
    const BakedLight light = bakeLight(model, quality);
    lap("light");
    const std::vector<ObjectPictures> pictures = composePictures(model, light);
    lap("textures");
    const std::size_t bytes = writeGlb(options.out, model, pictures);
    std::printf("%s: %zu bytes\n", options.out.c_str(), bytes);
    lap("file");
    if (options.preview.empty()) return;
    writePng(options.preview, renderPreview(model, pictures, options.view));
    lap("preview");
}

}  // namespace
}  // namespace studio

int main(int count, char** words) {
    try {
        studio::run(studio::parse(count, words));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
