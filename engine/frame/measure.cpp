#include "frame/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/file.hpp"
#include "frame/frame_maker.hpp"
#include "frame/measure_content.hpp"
#include "frame/measure_frames.hpp"
#include "frame/measure_page.hpp"
#include "frame/measure_reference.hpp"
#include "metrics/metrics.hpp"
#include "scene/lod.hpp"

namespace dioptre {

namespace {

constexpr std::size_t kLargestTable = 64u << 20;
// What a row costs besides its frames, and a reference besides its samples, in drawings of the scene: comparing,
// writing, a technique's shaders. Few frames are drawn of many samples.
constexpr double kRowWork = 40.0, kReferenceWork = 20.0;
constexpr double kFramesOfARow = 12.0, kSampledFramesOfARow = 4.0;
// With more samples than half of one of the reference's halves a technique could not be told from the reference's
// noise.
constexpr double kMostOfAHalf = 0.5;

double pixelsOf(PictureSize size) {
    return static_cast<double>(size.width) * size.height;
}

Measurements readMeasurements(const std::filesystem::path& file) {
    return parseMeasurements(readFile(file, kLargestTable), file.string());
}

}  // namespace

/// A scene, a size and a lens.
struct Measuring::Subject {
    const GpuScene& scene;
    std::string content;
    View view;
    Lens lens;
    Image reference;
};

Measuring::Measuring(MeasureRequest request) : request_(std::move(request)), pictures_(request_.folder / "pictures") {
    makeFolder(request_.folder, "--out");
    all_.with = measuredHere();
    all_.with.program = request_.program;
    all_.with.commit = request_.commit;
    all_.with.context = request_.context;
    all_.with.samplesPerHalf = request_.samplesPerHalf;
    all_.with.rowMs = request_.rowMilliseconds;
    all_.with.exposureEv = request_.exposureEv;
    for (const PictureSize& size : request_.sizes)
        all_.with.sizes.push_back(fmt::format("{}x{}", size.width, size.height));
    for (const MeasuredBlur& blur : kMeasuredBlurs) all_.with.blurs.emplace(blur.name, blur.meanDiameterPx);

    const auto table = request_.folder / "trade.json";
    if (!request_.resume && std::filesystem::exists(table))
        throw InputError(fmt::format("--out: {} is there already: --resume goes on with it, another folder begins anew",
                                     table.string()));
    if (request_.resume && std::filesystem::exists(table)) {
        Measurements before = readMeasurements(table);
        if (!before.with.comparable(all_.with))
            throw InputError(
                fmt::format("--resume: {} was measured by another build, on another machine or with other "
                            "settings; give another --out",
                            table.string()));
        all_.views = std::move(before.views);
        all_.rows = std::move(before.rows);
    }

    plans_ = measuredPlans();
    std::erase_if(plans_,
                  [&](const Plan& plan) { return plan.samples.value_or(0) > kMostOfAHalf * request_.samplesPerHalf; });
    constexpr std::size_t kViews = std::size(kMeasuredBlurs) * std::size(kMeasuredFocuses);
    rowsWanted_ = request_.scenes * request_.sizes.size() * kViews * plans_.size();
    double workOfAView = kReferenceWork + 2.0 * request_.samplesPerHalf;
    for (const Plan& plan : plans_) {
        work_.push_back(kRowWork + (plan.samples ? kSampledFramesOfARow * *plan.samples : kFramesOfARow));
        workOfAView += work_.back();
    }
    for (const PictureSize& size : request_.sizes)
        workTotal_ += static_cast<double>(request_.scenes * kViews) * workOfAView * pixelsOf(size);
    start_ = nowMilliseconds();
    progress_.emplace("row", rowsWanted_);
}

void Measuring::progressed(double work, const std::string& doing) {
    workDone_ += work;
    // What was found finished took no time and tells nothing about what is left.
    const double seconds = (nowMilliseconds() - start_) * 1e-3;
    const double left = workTotal_ - workSkipped_ - workDone_;
    const std::string rest =
        workDone_ > 0.0 && left > 0.0 ? fmt::format(", about {} left", durationText(seconds * left / workDone_)) : "";
    progress_->update(rowsDone_, fmt::format("{}{}", doing, rest));
}

void Measuring::keep(const MeasuredView& view) {
    const auto same = [&](const auto& v) { return v.key == view.key; };
    const auto found = std::find_if(all_.views.begin(), all_.views.end(), same);
    if (found == all_.views.end()) {
        all_.views.push_back(view);
    } else if (!found->sameAs(view)) {
        // The scene has changed since: its rows are of another picture.
        std::erase_if(all_.rows, [&](const MeasuredRow& r) { return r.view == view.key; });
        *found = view;
    }
}

bool Measuring::add(const std::string& name, const Scene& scene) {
    const std::string content = contentOf(scene);
    GpuScene gpu(scene);
    for (const BuiltLevel& built : buildLevels(scene, {request_.lods}, request_.stopped))
        gpu.addLevel(built.mesh, built.primitive, built.data);
    for (const PictureSize& size : request_.sizes) {
        ViewSettings settings = request_.view;
        settings.size = size;
        const View view = startView(scene, settings);
        const VergenceStatistics seen = visibleVergences(gpu, view);
        if (seen.sorted.empty()) throw InputError(fmt::format("{}: nothing is seen, nothing to measure", name));
        const double f = focalLengthPixels(view).x;
        for (const MeasuredBlur& blur : kMeasuredBlurs) {
            for (const MeasuredFocus& focus : kMeasuredFocuses) {
                const Lens lens = measuredLens(seen, focus, blur, f, size.width);
                MeasuredView row;
                row.key = fmt::format("{}-{}x{}-{}-{}", name, size.width, size.height, blur.name, focus.name);
                row.scene = name;
                row.content = content;
                row.triangles = scene.triangleCount();
                row.width = size.width;
                row.height = size.height;
                row.blur = blur.name;
                row.focus = focus.name;
                row.apertureMm = lens.apertureRadius.value * 2e3;
                row.focusD = lens.focus.value;
                row.meanCocPx = 2.0 * lens.apertureRadius.value * f * seen.meanDifference(lens.focus.value);
                row.nearestCocPx = 2.0 * cocRadiusPixels(lens, f, Dioptres(seen.nearest()));
                row.farthestCocPx = 2.0 * cocRadiusPixels(lens, f, Dioptres(seen.farthest()));
                row.nearestD = seen.nearest();
                row.farthestD = seen.farthest();
                row.referenceSamples = 2 * request_.samplesPerHalf;
                if (!measureView({gpu, content, view, lens, {}}, row)) return false;
            }
        }
    }
    return true;
}

bool Measuring::measureView(const Subject& given, MeasuredView view) {
    const double pixels = pixelsOf({view.width, view.height});
    if (const MeasuredView* before = all_.view(view.key); before && before->sameAs(view)) view = *before;
    keep(view);
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < plans_.size(); ++i) {
        MeasuredRow wanted;
        wanted.technique = techniqueName(plans_[i].technique);
        for (const auto& [name, value] : plans_[i].dials()) wanted.dials.emplace(name, value);
        if (!all_.row(view.key, wanted.key())) {
            missing.push_back(i);
        } else {
            workSkipped_ += work_[i] * pixels;
            ++rowsDone_;
        }
    }
    const double referenceWork = (kReferenceWork + 2.0 * request_.samplesPerHalf) * pixels;
    if (missing.empty()) {
        workSkipped_ += referenceWork;
        return true;
    }
    progressed(0.0, fmt::format("{}: reference", view.key));

    Subject subject = given;
    const auto reference = referencePictures(
        {subject.scene, subject.content, subject.view, subject.lens, static_cast<float>(std::exp2(request_.exposureEv)),
         request_.samplesPerHalf, all_.with.renderer + " " + all_.with.version},
        request_.cache, request_.stopped);
    if (!reference) return false;
    if (reference->milliseconds > 0.0)
        workDone_ += referenceWork;
    else
        workSkipped_ += referenceWork;
    if (const std::size_t bad = countNotFinite(reference->first) + countNotFinite(reference->second); bad > 0)
        throw RunError(fmt::format("{}: {} values of the reference are not finite", view.key, bad));
    view.referenceMs = reference->milliseconds;
    view.noise = compareImages(reference->first, reference->second);
    subject.reference = reference->mean();
    *std::find_if(all_.views.begin(), all_.views.end(), [&](const auto& v) { return v.key == view.key; }) = view;
    pictures_.writePicture(view.key, subject.reference);

    for (const std::size_t i : missing)
        if (!measureRow(subject, view, i)) return false;
    return true;
}

bool Measuring::measureRow(const Subject& subject, const MeasuredView& view, std::size_t planIndex) {
    const Plan& plan = plans_[planIndex];
    // Techniques that take samples take others than the reference did: its error would look smaller than it is.
    auto measured =
        measureFrames({subject.scene, subject.view, subject.lens, static_cast<float>(std::exp2(request_.exposureEv)),
                       2 * request_.samplesPerHalf, request_.rowMilliseconds},
                      plan, request_.stopped);
    if (!measured) return false;
    MeasuredRow& row = measured->row;
    row.view = view.key;
    if (const std::size_t bad = countNotFinite(measured->picture); bad > 0)
        throw RunError(fmt::format("{}, {}: {} values of its picture are not finite", view.key, row.key(), bad));
    const Image errors = flipMap(subject.reference, measured->picture);
    double sum = 0.0;
    for (const float e : errors.pixels) sum += static_cast<double>(e);
    row.error = {psnr(subject.reference, measured->picture), ssim(subject.reference, measured->picture),
                 sum / static_cast<double>(errors.pixels.size())};
    pictures_.writePicture(view.key + "." + row.key(), measured->picture);
    pictures_.writeErrors(view.key + "." + row.key(), errors);
    all_.rows.push_back(row);
    all_.markPareto();
    writeTables();
    ++rowsDone_;
    ++rowsAdded_;
    progressed(work_[planIndex] * pixelsOf({view.width, view.height}), fmt::format("{}: {}", view.key, row.key()));
    return true;
}

void Measuring::writeTables() const {
    writeFileAtomically(request_.folder / "trade.json", measurementsJson(all_));
    writeFileAtomically(request_.folder / "trade.csv", measurementsCsv(all_));
}

void Measuring::finish() {
    progress_.reset();
    // A view whose reference was not finished has nothing to show.
    std::erase_if(all_.views, [&](const MeasuredView& v) {
        return std::none_of(all_.rows.begin(), all_.rows.end(), [&](const MeasuredRow& r) { return r.view == v.key; });
    });
    writeTables();
    writeFileAtomically(request_.folder / fmt::format("trade-{}.json", rendererFileName(all_.with.renderer)),
                        governorTable(all_));
    writeFileAtomically(request_.folder / "index.html", measurePage(all_, pictures_));
}

}  // namespace dioptre
