#include "frame/measure_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

namespace dioptre {

bool MeasuredView::sameAs(const MeasuredView& other) const {
    const auto all = [](const MeasuredView& v) {
        return std::tie(v.key, v.content, v.width, v.height, v.apertureMm, v.focusD, v.referenceSamples);
    };
    return all(*this) == all(other);
}

std::string MeasuredRow::key() const {
    std::string text = technique;
    for (const auto& [name, value] : dials) text += fmt::format("-{}{}", name, value);
    return text;
}

std::string MeasuredRow::dialsText() const {
    std::string text;
    for (const auto& [name, value] : dials) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    return text;
}

bool MeasuredWith::comparable(const MeasuredWith& other) const {
    const auto all = [](const MeasuredWith& w) {
        return std::tie(w.program, w.commit, w.renderer, w.version, w.context, w.cpu, w.system, w.cores,
                        w.samplesPerHalf, w.rowMs, w.exposureEv, w.blurs);
    };
    return all(*this) == all(other);
}

const MeasuredView* Measurements::view(std::string_view key) const {
    const auto found = std::find_if(views.begin(), views.end(), [&](const MeasuredView& v) { return v.key == key; });
    return found == views.end() ? nullptr : &*found;
}

const MeasuredRow* Measurements::row(std::string_view viewKey, std::string_view rowKey) const {
    const auto found = std::find_if(rows.begin(), rows.end(),
                                    [&](const MeasuredRow& r) { return r.view == viewKey && r.key() == rowKey; });
    return found == rows.end() ? nullptr : &*found;
}

void Measurements::markPareto() {
    for (const MeasuredView& of : views) {
        std::vector<MeasuredRow*> mine;
        std::vector<TradePoint> points;
        for (MeasuredRow& r : rows) {
            if (r.view != of.key) continue;
            r.pareto = false;
            mine.push_back(&r);
            points.push_back({r.time.median, 1.0 - r.error.ssim});
        }
        for (const std::size_t i : paretoFront(points)) mine[i]->pareto = true;
    }
}

namespace {

std::string csvText(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

constexpr std::string_view kCsvHeader =
    "scene,width,height,blur,focus,aperture_mm,focus_D,mean_coc_px,nearest_coc_px,farthest_coc_px,reference_samples,"
    "reference_psnr_db,reference_ssim,reference_flip,technique,dials,ms_median,ms_p10,ms_p90,frames,psnr_db,ssim,flip,"
    "triangles,fetches_per_px,technique_bytes,process_peak_bytes,pareto,stages,skipped\n";

}  // namespace

std::string measurementsCsv(const Measurements& all) {
    std::string csv(kCsvHeader);
    for (const MeasuredRow& r : all.rows) {
        const MeasuredView* v = all.view(r.view);
        if (!v) continue;
        std::string stages, skipped;
        for (const MeasuredStage& s : r.stages)
            stages += fmt::format("{}{}={:.4f}", stages.empty() ? "" : ";", s.name, s.milliseconds);
        for (const SkippedStage& s : r.skipped)
            skipped += fmt::format("{}{}: {}", skipped.empty() ? "" : ";", s.name, s.why);
        csv +=
            fmt::format("{},{},{},{},{},{:.4f},{:.6f},{:.4f},{:.4f},{:.4f},{},{:.3f},{:.6f},{:.6f},", csvText(v->scene),
                        v->width, v->height, v->blur, v->focus, v->apertureMm, v->focusD, v->meanCocPx, v->nearestCocPx,
                        v->farthestCocPx, v->referenceSamples, v->noise.psnr, v->noise.ssim, v->noise.flip);
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{},{:.3f},{:.6f},{:.6f},{},{},{},{},{},{},{}\n", r.technique,
                           csvText(r.dialsText()), r.time.median, r.time.p10, r.time.p90, r.time.frames, r.error.psnr,
                           r.error.ssim, r.error.flip, r.triangles,
                           r.fetchesPerPixel ? fmt::format("{:.3f}", *r.fetchesPerPixel) : "", r.techniqueBytes,
                           r.processPeakBytes, r.pareto ? 1 : 0, csvText(stages), csvText(skipped));
    }
    return csv;
}

std::vector<std::size_t> paretoFront(std::span<const TradePoint> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(points[a].cost, points[a].error) < std::tie(points[b].cost, points[b].error);
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    return front;
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below =
        static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(values.size() - 1)));
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

Timing timingOf(const std::vector<double>& milliseconds) {
    return {percentile(milliseconds, 0.5), percentile(milliseconds, 0.1), percentile(milliseconds, 0.9),
            static_cast<int>(milliseconds.size())};
}

std::string rendererFileName(std::string_view renderer) {
    std::string name;
    // The part in brackets is versions.
    for (const char c : renderer.substr(0, renderer.find('('))) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    while (!name.empty() && name.back() == '-') name.pop_back();
    return name.empty() ? "unknown" : name;
}

std::string durationText(double seconds) {
    const long whole = std::lround(std::max(0.0, seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    const long minutes = (whole + 30) / 60;
    if (minutes < 60) return fmt::format("{} min", minutes);
    return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace dioptre
