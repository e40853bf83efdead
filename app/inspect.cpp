// dioptre inspect: what the scene holds, what the lens can do, what this view requires.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "commands.hpp"
#include "frame/frame_maker.hpp"
#include "gl/context.hpp"
#include "optics/lens.hpp"
#include "scene/animation.hpp"

namespace dioptre {

namespace {

std::string metresText(Dioptres d) {
    return d.value <= 0.0 ? "infinity" : fmt::format("{:.4g} m", 1.0 / d.value);
}

std::string sceneText(const Scene& scene) {
    std::string text = fmt::format("scene      {}\n", scene.name);
    std::size_t texels = 0;
    for (const TextureImage& image : scene.images) texels += image.rgba.size();
    text += fmt::format("objects    {} instances of {} meshes, {} triangles drawn\n", scene.instances.size(),
                        scene.meshes.size(), scene.triangleCount());
    text += fmt::format("surfaces   {} materials, {} images ({:.1f} MB decoded)\n", scene.materials.size(),
                        scene.images.size(), static_cast<double>(texels) / 1e6);
    if (scene.bounds.empty()) {
        text += "bounds     nothing to draw\n";
    } else {
        const auto& b = scene.bounds;
        text += fmt::format("bounds     {:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} {:.4g} m\n", b.min.x, b.min.y, b.min.z,
                            b.max.x, b.max.y, b.max.z);
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        text += fmt::format("camera {}   {}, {:.1f} deg high, near {:.4g} m\n", i, scene.cameras[i].name,
                            glm::degrees(scene.cameras[i].yfovRadians), scene.cameras[i].nearMetres);
    text += scene.lights.empty() ? "lights     none: a soft sky and one key light\n"
                                 : fmt::format("lights     {}\n", scene.lights.size());
    if (scene.motion) {
        const std::vector<Animation>& animations = scene.motion->animations;
        for (std::size_t i = 0; i < animations.size(); ++i)
            text += fmt::format("animation {} {}, {:.4g} s, {} channels\n", i, animations[i].name, animations[i].length,
                                animations[i].channels.size());
    }
    if (!scene.warnings.empty()) text += fmt::format("ignored    {} warnings, above\n", scene.warnings.size());
    return text;
}

std::string memoryText(const Scene& scene, const GpuScene& uploaded) {
    return fmt::format("memory     {:.1f} MB read, freed once uploaded; {:.1f} MB for the GPU\n",
                       static_cast<double>(scene.bytes()) / 1e6, static_cast<double>(uploaded.bytes()) / 1e6);
}

std::string lensText(const Settings& settings, const FrameReport& frame) {
    const ResolvedLens& lens = frame.lens;
    std::string text = fmt::format("lens       {}: F {:.4g} mm, aperture diameter {:.3f} mm\n", settings.lens.lens,
                                   lens.lens.focalLength.value * 1e3, lens.apertureDiameter.value * 1e3);
    text += fmt::format("reach      focuses from {} ({:.2f} D) to {} ({:.2f} D)\n", metresText(lens.range.nearest),
                        lens.range.nearest.value, metresText(lens.range.farthest), lens.range.farthest.value);
    text += fmt::format("focus      {:.3f} D ({})", lens.lens.focus.value, metresText(lens.lens.focus));
    if (lens.focusLimited)
        text += fmt::format(": {:.3f} D was asked for, {:+.3f} D out of reach",
                            lens.lens.focus.value + lens.residual.value, lens.residual.value);
    return text + "\n";
}

std::string passesText(const PassLog& passes) {
    std::map<std::string_view, int> counts;
    for (const auto& pass : passes.entries) ++counts[pass.name];
    std::string text = "passes     ";
    for (const auto& [name, count] : counts) text += fmt::format("{} x{}  ", name, count);
    text += "\n";
    // Both eyes leave out the same.
    std::set<std::pair<std::string_view, std::string_view>> told;
    for (const auto& [name, why] : passes.skipped)
        if (told.insert({name, why}).second) text += fmt::format("left out   {}: {}\n", name, why);
    return text;
}

std::string viewText(const FrameMaker& maker, const FrameReport& frame) {
    const View& view = maker.startingView();
    const ViewContents range = maker.scene().contents(view);
    std::string text = fmt::format("view       {}x{} px an eye, f {:.1f} px, near {:.4g} m\n", view.width, view.height,
                                   focalLengthPixels(view).x, view.near.value);
    if (range.anything) {
        const double f = focalLengthPixels(view).x;
        text += fmt::format(
            "depth      {} ({:.3f} D) to {} ({:.3f} D), from bounding boxes\nblur       CoC radius {:.2f} px nearest, "
            "{:+.2f} px farthest (> 0 behind focus)\n",
            metresText(Dioptres(range.nearest)), range.nearest, metresText(Dioptres(range.farthest)), range.farthest,
            cocRadiusPixels(frame.lens.lens, f, Dioptres(range.nearest)),
            cocRadiusPixels(frame.lens.lens, f, Dioptres(range.farthest)));
    }
    text += fmt::format("plan       {}, {:.1f} MB of textures for the eyes\n", planText(frame.plan),
                        static_cast<double>(maker.techniqueBytes()) / 1e6);
    return text + passesText(frame.passes);
}

}  // namespace

void runInspect(const Command& command) {
    Scene scene = loadScene(command);
    if (command.lods) return inspectLods(scene);
    const auto context = openHeadlessContext(command);
    FrameMaker maker(scene, command.settings);
    // One picture is planned without them.
    if (const auto plan = planOf(command.settings.render); plan && usesLevels(*plan))
        maker.addLevels(buildLevels(scene, {lodFolder()}));
    const std::string text = sceneText(scene) + memoryText(scene, maker.scene());
    scene.releaseBulk();
    FrameMaker::Input input;
    input.time = command.settings.view.time;
    input.budgetMilliseconds = command.settings.render.budgetMs.value_or(kPictureMs);
    input.alone = true;
    const FrameReport& frame = maker.make(input);
    std::fputs((text + lensText(command.settings, frame) + viewText(maker, frame)).c_str(), stdout);
}

}  // namespace dioptre
