#include "frame/measure_frames.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "gl/objects.hpp"

namespace dioptre {

namespace {

// Nine frames leave one on each side of the 10th and 90th percentile. Frames of seconds vary less.
constexpr int kMostFrames = 9, kLeastFrames = 2, kStageFrames = 3;
constexpr double kSlowMilliseconds = 200.0;

/// Linux keeps the most memory that a process had resident, and forgets it on request.
void forgetPeak() {
    std::ofstream("/proc/self/clear_refs") << "5";
}
std::uint64_t peakBytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != "VmHWM:") continue;
        std::uint64_t kilobytes = 0;
        status >> kilobytes;
        return kilobytes * 1024;
    }
    return 0;
}

struct TimedFrame {
    const Texture& picture;
    double milliseconds;
};

TimedFrame drawTimed(Technique& technique, const EyeFrame& frame) {
    frame.log.clear();
    glFinish();
    const double start = nowMilliseconds();
    const Texture& picture = technique.draw(frame);
    glFinish();
    return {picture, nowMilliseconds() - start};
}

/// Sums by name, in the order of the frame.
std::vector<MeasuredStage> stagesOf(const PassLog& log) {
    std::vector<MeasuredStage> stages;
    for (const PassLog::Entry& entry : log.entries) {
        auto stage =
            std::find_if(stages.begin(), stages.end(), [&](const MeasuredStage& s) { return s.name == entry.name; });
        if (stage == stages.end()) stage = stages.insert(stages.end(), {std::string(entry.name), 0.0, 0});
        stage->milliseconds += entry.milliseconds;
        ++stage->runs;
    }
    return stages;
}

std::vector<MeasuredStage> medianStages(const std::vector<std::vector<MeasuredStage>>& frames) {
    std::vector<MeasuredStage> result = frames.front();
    for (std::size_t s = 0; s < result.size(); ++s) {
        std::vector<double> values;
        for (const auto& stages : frames)
            if (s < stages.size()) values.push_back(stages[s].milliseconds);
        result[s].milliseconds = percentile(values, 0.5);
    }
    return result;
}

}  // namespace

VergenceStatistics visibleVergences(const GpuScene& scene, const View& view) {
    const Texture depth({GL_DEPTH_COMPONENT32F, view.width, view.height, 1, 0}, "visible depth");
    const Framebuffer target({}, &depth, "visible depth");
    target.bind();
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &infinitelyFar);
    scene.drawDepth(view, 0.0);
    std::vector<double> vergences;
    for (const float stored : readTexture(depth, GL_DEPTH_COMPONENT, 1))
        if (stored > 0.0f) vergences.push_back(static_cast<double>(stored) / view.near.value);
    return VergenceStatistics(std::move(vergences));
}

std::optional<MeasuredPicture> measureFrames(const FrameRequest& request, const Plan& plan,
                                             const std::function<bool()>& stopped) {
    forgetPeak();
    MeasuredPicture result;
    MeasuredRow& row = result.row;
    row.technique = techniqueName(plan.technique);
    for (const auto& [name, value] : plan.dials()) row.dials.emplace(name, value);

    const auto technique = makeTechnique(plan.technique);
    PassLog log;
    EyeFrame frame{request.scene, request.view, request.lens, request.exposure, 0, {}, log};
    apply(plan, frame);
    frame.firstSample = request.firstSample;

    // Compiles what the driver compiles at first use
    EyeFrame least = frame;
    least.samples = 1;
    technique->draw(least);

    // The picture, and what drawing it took
    const std::uint64_t trianglesBefore = request.scene.trianglesDrawn();
    const TimedFrame first = drawTimed(*technique, frame);
    row.triangles = request.scene.trianglesDrawn() - trianglesBefore;
    row.fetchesPerPixel = technique->fetchesPerPixel();
    row.techniqueBytes = technique->bytes();
    for (const PassLog::Skipped& skipped : log.skipped)
        row.skipped.push_back({std::string(skipped.name), std::string(skipped.why)});
    result.picture = Image(request.view.width, request.view.height);
    result.picture.pixels = readTexture(first.picture, GL_RGB, 3);

    // More finished frames. By stage: in the same ones where the waits between stages are nothing to them, otherwise in
    // some of their own.
    const bool slow = first.milliseconds > kSlowMilliseconds;
    const int frames = static_cast<int>(
        std::clamp(request.rowMilliseconds / first.milliseconds, 1.0 * kLeastFrames, 1.0 * kMostFrames));
    std::vector<double> milliseconds{first.milliseconds};
    std::vector<std::vector<MeasuredStage>> stages;
    for (int i = 1; i < frames + (slow ? 0 : kStageFrames); ++i) {
        if (stopped()) return std::nullopt;
        log.timed = slow || i >= frames;
        const TimedFrame next = drawTimed(*technique, frame);
        if (i < frames) milliseconds.push_back(next.milliseconds);
        if (log.timed) stages.push_back(stagesOf(log));
    }
    row.time = timingOf(milliseconds);
    row.stages = medianStages(stages);
    row.processPeakBytes = peakBytes();
    return result;
}

}  // namespace dioptre
