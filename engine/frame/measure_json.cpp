// trade.json, there and back, and the governor's table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "frame/machine_json.hpp"
#include "frame/measure_lens.hpp"
#include "frame/measure_rows.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;       // of trade.json
constexpr int kTableSchema = 2;  // of the governor's table

/// Infinity is null in JSON.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}
double finiteOrInfinity(const Json& value) {
    return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

void putComparison(Json& to, const Comparison& c) {
    to["psnr_db"] = number(c.psnr);
    to["ssim"] = c.ssim;
    to["flip"] = c.flip;
}
Comparison comparisonOf(const Json& from) {
    return {finiteOrInfinity(from.at("psnr_db")), from.at("ssim").get<double>(), from.at("flip").get<double>()};
}

Json jsonOf(const MeasuredView& v) {
    Json j = {{"key", v.key},
              {"scene", v.scene},
              {"content", v.content},
              {"triangles", v.triangles},
              {"width", v.width},
              {"height", v.height},
              {"blur", v.blur},
              {"focus", v.focus},
              {"aperture_mm", v.apertureMm},
              {"focus_D", v.focusD},
              {"mean_coc_px", v.meanCocPx},
              {"nearest_coc_px", v.nearestCocPx},
              {"farthest_coc_px", v.farthestCocPx},
              {"nearest_D", v.nearestD},
              {"farthest_D", v.farthestD}};
    Json reference = {{"samples", v.referenceSamples}, {"ms", v.referenceMs}};
    putComparison(reference, v.noise);
    j["reference"] = reference;
    return j;
}

MeasuredView viewOf(const Json& j) {
    MeasuredView v;
    v.key = j.at("key").get<std::string>();
    v.scene = j.at("scene").get<std::string>();
    v.content = j.at("content").get<std::string>();
    v.triangles = j.at("triangles").get<std::uint64_t>();
    v.width = j.at("width").get<int>();
    v.height = j.at("height").get<int>();
    v.blur = j.at("blur").get<std::string>();
    v.focus = j.at("focus").get<std::string>();
    v.apertureMm = j.at("aperture_mm").get<double>();
    v.focusD = j.at("focus_D").get<double>();
    v.meanCocPx = j.at("mean_coc_px").get<double>();
    v.nearestCocPx = j.at("nearest_coc_px").get<double>();
    v.farthestCocPx = j.at("farthest_coc_px").get<double>();
    v.nearestD = j.at("nearest_D").get<double>();
    v.farthestD = j.at("farthest_D").get<double>();
    const Json& reference = j.at("reference");
    v.referenceSamples = reference.at("samples").get<int>();
    v.referenceMs = reference.at("ms").get<double>();
    v.noise = comparisonOf(reference);
    return v;
}

Json jsonOf(const MeasuredRow& r) {
    Json stages = Json::array(), skipped = Json::array();
    for (const MeasuredStage& s : r.stages)
        stages.push_back({{"name", s.name}, {"ms", s.milliseconds}, {"runs", s.runs}});
    for (const SkippedStage& s : r.skipped) skipped.push_back({{"name", s.name}, {"why", s.why}});
    Json j = {
        {"view", r.view},       {"technique", r.technique}, {"dials", r.dials},        {"ms_median", r.time.median},
        {"ms_p10", r.time.p10}, {"ms_p90", r.time.p90},     {"frames", r.time.frames}, {"stages", stages},
        {"skipped", skipped}};
    putComparison(j, r.error);
    j["triangles"] = r.triangles;
    j["fetches_per_px"] = r.fetchesPerPixel ? Json(*r.fetchesPerPixel) : Json(nullptr);
    j["technique_bytes"] = r.techniqueBytes;
    j["process_peak_bytes"] = r.processPeakBytes;
    j["pareto"] = r.pareto;
    return j;
}

MeasuredRow rowOf(const Json& j) {
    MeasuredRow r;
    r.view = j.at("view").get<std::string>();
    r.technique = j.at("technique").get<std::string>();
    r.dials = j.at("dials").get<std::map<std::string, int>>();
    r.time = {j.at("ms_median").get<double>(), j.at("ms_p10").get<double>(), j.at("ms_p90").get<double>(),
              j.at("frames").get<int>()};
    for (const Json& s : j.at("stages"))
        r.stages.push_back({s.at("name").get<std::string>(), s.at("ms").get<double>(), s.at("runs").get<int>()});
    for (const Json& s : j.at("skipped"))
        r.skipped.push_back({s.at("name").get<std::string>(), s.at("why").get<std::string>()});
    r.error = comparisonOf(j);
    r.triangles = j.at("triangles").get<std::uint64_t>();
    if (const Json& fetches = j.at("fetches_per_px"); !fetches.is_null()) r.fetchesPerPixel = fetches.get<double>();
    r.techniqueBytes = j.at("technique_bytes").get<std::uint64_t>();
    r.processPeakBytes = j.at("process_peak_bytes").get<std::uint64_t>();
    r.pareto = j.at("pareto").get<bool>();
    return r;
}

}  // namespace

std::string measurementsJson(const Measurements& all) {
    const MeasuredWith& w = all.with;
    Json j = {{"schema", kSchema}};
    j.update(machineJson(w));
    j.update({{"settings",
               {{"samples_per_half", w.samplesPerHalf},
                {"row_ms", w.rowMs},
                {"exposure_ev", w.exposureEv},
                {"sizes", w.sizes},
                {"blurs", w.blurs}}},
              {"views", Json::array()},
              {"rows", Json::array()}});
    for (const MeasuredView& v : all.views) j["views"].push_back(jsonOf(v));
    for (const MeasuredRow& r : all.rows) j["rows"].push_back(jsonOf(r));
    return j.dump(1) + "\n";
}

Measurements parseMeasurements(std::string_view json, std::string_view where) {
    try {
        const Json j = Json::parse(json);
        if (const int schema = j.at("schema").get<int>(); schema != kSchema)
            throw InputError(fmt::format("{}: schema {} is not {}", where, schema, kSchema));
        Measurements all;
        MeasuredWith& w = all.with;
        w.program = j.at("program").get<std::string>();
        w.commit = j.at("commit").get<std::string>();
        w.renderer = j.at("renderer").get<std::string>();
        w.version = j.at("version").get<std::string>();
        w.context = j.at("context").get<std::string>();
        w.cpu = j.at("cpu").get<std::string>();
        w.cores = j.at("cores").get<int>();
        w.memoryBytes = j.at("memory_bytes").get<std::uint64_t>();
        w.system = j.at("system").get<std::string>();
        w.date = j.at("date").get<std::string>();
        const Json& settings = j.at("settings");
        w.samplesPerHalf = settings.at("samples_per_half").get<int>();
        w.load = j.at("load").get<double>();
        w.rowMs = settings.at("row_ms").get<double>();
        w.exposureEv = settings.at("exposure_ev").get<double>();
        w.sizes = settings.at("sizes").get<std::vector<std::string>>();
        w.blurs = settings.at("blurs").get<std::map<std::string, double>>();
        for (const Json& v : j.at("views")) all.views.push_back(viewOf(v));
        for (const Json& r : j.at("rows")) all.rows.push_back(rowOf(r));
        return all;
    } catch (const nlohmann::json::exception& e) {
        throw InputError(fmt::format("{}: not what dioptre measure writes: {}", where, e.what()));
    }
}

namespace {

/// Means over rows of one plan.
struct Means {
    double ms = 0.0, overPinhole = 0.0, psnr = 0.0, ssim = 0.0, flip = 0.0;
    int count = 0;

    void add(const MeasuredRow& r, double pinholeMs) {
        ms += r.time.median;
        overPinhole += r.time.median - pinholeMs;
        // An equal picture would be infinitely good: 100 dB is beyond what 16 bits can tell.
        psnr += std::min(r.error.psnr, 100.0);
        ssim += r.error.ssim;
        flip += r.error.flip;
        ++count;
    }
    void put(Json& to) const {
        const double n = std::max(count, 1);
        to["ms"] = ms / n;
        to["ms_over_pinhole"] = overPinhole / n;
        to["psnr_db"] = psnr / n;
        to["ssim"] = ssim / n;
        to["flip"] = flip / n;
    }
};

const MeasuredRow* cheapestPinhole(const Measurements& all, const std::string& view) {
    const MeasuredRow* cheapest = nullptr;
    for (const MeasuredRow& r : all.rows)
        if (r.view == view && r.technique == "pinhole" && (!cheapest || r.time.median < cheapest->time.median))
            cheapest = &r;
    return cheapest;
}

/// What prices and errors of a view hang on.
Json classOf(const Measurements& all, const MeasuredView& v) {
    const MeasuredRow* pinhole = cheapestPinhole(all, v.key);
    const auto* focus = std::find_if(std::begin(kMeasuredFocuses), std::end(kMeasuredFocuses),
                                     [&](const MeasuredFocus& f) { return f.name == v.focus; });
    return {{"key", v.key},
            {"triangles", pinhole ? pinhole->triangles : v.triangles},
            {"width", v.width},
            {"height", v.height},
            {"mean_coc_px", v.meanCocPx},
            {"nearest_coc_px", v.nearestCocPx},
            {"farthest_coc_px", v.farthestCocPx},
            {"behind_share", focus == std::end(kMeasuredFocuses) ? 0.5 : focus->share}};
}

/// A line for each view and each entry of a plan, for people to read and compare.
std::string tableText(const Json& table) {
    const auto lines = [](const Json& list, std::string_view indent) {
        std::string text;
        for (const Json& element : list)
            text += fmt::format("{}\n{}{}", text.empty() ? "" : ",", indent, element.dump());
        return text;
    };
    std::string text = "{";
    for (const auto& [key, value] : table.items()) {
        text += text.size() > 1 ? ",\n" : "\n";
        if (key == "views") {
            text += fmt::format(" \"views\": [{}\n ]", lines(value, "  "));
        } else if (key == "plans") {
            std::string plans;
            for (Json plan : value) {
                const std::string entries = lines(plan["entries"], "    ");
                plan.erase("entries");
                std::string head = plan.dump();
                head.pop_back();
                plans += fmt::format("{}\n  {},\"entries\":[{}\n  ]}}", plans.empty() ? "" : ",", head, entries);
            }
            text += fmt::format(" \"plans\": [{}\n ]", plans);
        } else {
            text += fmt::format(" \"{}\": {}", key, value.dump());
        }
    }
    return text + "\n}\n";
}

}  // namespace

std::string governorTable(const Measurements& all) {
    struct Planned {
        const MeasuredRow* first = nullptr;
        Means means;
        Json entries = Json::array();
    };
    std::vector<Planned> plans;
    for (const MeasuredRow& r : all.rows) {
        if (!all.view(r.view)) continue;
        auto plan = std::find_if(plans.begin(), plans.end(), [&](const auto& p) { return p.first->key() == r.key(); });
        if (plan == plans.end()) plan = plans.insert(plans.end(), Planned{&r, {}, Json::array()});
        const MeasuredRow* pinhole = cheapestPinhole(all, r.view);
        Means one;
        one.add(r, pinhole ? pinhole->time.median : 0.0);
        plan->means.add(r, pinhole ? pinhole->time.median : 0.0);
        Json entry = {{"view", r.view}};
        one.put(entry);
        plan->entries.push_back(entry);
    }
    const MeasuredWith& w = all.with;
    Json j = {{"schema", kTableSchema}, {"renderer", w.renderer}, {"version", w.version},   {"commit", w.commit},
              {"cpu", w.cpu},           {"date", w.date},         {"views", Json::array()}, {"plans", Json::array()}};
    for (const MeasuredView& v : all.views) j["views"].push_back(classOf(all, v));
    std::vector<TradePoint> points;
    for (const Planned& plan : plans) {
        Json p = {{"technique", plan.first->technique}, {"dials", plan.first->dials}};
        plan.means.put(p);
        points.push_back({p["ms"].get<double>(), 1.0 - p["ssim"].get<double>()});
        p["entries"] = plan.entries;
        j["plans"].push_back(p);
    }
    j["front"] = paretoFront(points);
    return tableText(j);
}

}  // namespace dioptre
