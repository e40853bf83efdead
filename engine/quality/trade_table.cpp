#include "quality/trade_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::json;

constexpr int kSchema = 2;

/// A value of the file, and where it stands: "llvmpipe.json: plans[3].ms".
class Element {
  public:
    Element(const Json& value, std::string_view file, std::string path = "")
        : value_(value), file_(file), path_(std::move(path)) {}

    [[noreturn]] void fail(const std::string& limit) const {
        throw InputError(fmt::format("{}: {}, must be {}", where(), quote(value_.dump()), limit));
    }
    Element at(const char* key) const {
        if (!value_.is_object()) fail("an object");
        const auto found = value_.find(key);
        if (found == value_.end()) throw InputError(fmt::format("{}: key '{}' is missing", where(), key));
        return {*found, file_, path_.empty() ? key : fmt::format("{}.{}", path_, key)};
    }
    std::vector<Element> list() const {
        if (!value_.is_array() || value_.empty()) fail("a list that is not empty");
        std::vector<Element> elements;
        for (std::size_t i = 0; i < value_.size(); ++i)
            elements.emplace_back(value_[i], file_, fmt::format("{}[{}]", path_, i));
        return elements;
    }
    double number(double least, double most) const {
        const double number = value_.is_number() ? value_.get<double>() : std::nan("");
        if (!(number >= least && number <= most)) fail(fmt::format("a number from {} to {}", least, most));
        return number;
    }
    int integer(int least, int most) const {
        if (!value_.is_number_integer()) fail(fmt::format("an integer from {} to {}", least, most));
        return static_cast<int>(number(least, most));
    }
    std::string text() const {
        if (!value_.is_string()) fail("text");
        return value_.get<std::string>();
    }

  private:
    std::string where() const { return path_.empty() ? std::string(file_) : fmt::format("{}: {}", file_, path_); }

    const Json& value_;
    std::string_view file_;
    std::string path_;
};

constexpr std::size_t kMostPlans = 1000;
constexpr double kMost = 1e12;  // triangles, pixels, px, ms: beyond anything that is measured

Plan planOf(const Element& element) {
    const Element name = element.at("technique");
    const auto technique = techniqueNamed(name.text());
    if (!technique) name.fail("a technique: pinhole, mipmap, accumulate or reference");
    const Element dials = element.at("dials");
    Plan plan{*technique, {}, {}, {}};
    if (usesMsaa(*technique)) {
        plan.msaa = dials.at("msaa").integer(0, 4);
        if (*plan.msaa != 0 && *plan.msaa != 4) dials.at("msaa").fail("0 or 4");
    }
    if (usesSamples(*technique)) plan.samples = dials.at("samples").integer(1, 65536);
    if (*technique == TechniqueChoice::accumulate) plan.subsamples = dials.at("subsamples").integer(0, 16);
    return plan;
}

ViewClass viewOf(const Element& element) {
    ViewClass view;
    view.triangles = element.at("triangles").number(0.0, kMost);
    constexpr int kMostSide = 1 << 20;
    view.pixels =
        static_cast<double>(element.at("width").integer(1, kMostSide)) * element.at("height").integer(1, kMostSide);
    view.meanCocPx = element.at("mean_coc_px").number(0.0, kMost);
    view.largestCocPx = std::max(std::abs(element.at("nearest_coc_px").number(-kMost, kMost)),
                                 std::abs(element.at("farthest_coc_px").number(-kMost, kMost)));
    view.behindShare = element.at("behind_share").number(0.0, 1.0);
    return view;
}

TradeTable tableOf(const Element& root) {
    root.at("schema").integer(kSchema, kSchema);
    TradeTable table;
    table.renderer = root.at("renderer").text();
    std::map<std::string, std::size_t> byKey;
    for (const Element& view : root.at("views").list()) {
        const Element key = view.at("key");
        if (!byKey.emplace(key.text(), table.views.size()).second) key.fail("another than those before");
        table.views.push_back(viewOf(view));
    }
    const std::vector<Element> plans = root.at("plans").list();
    if (plans.size() > kMostPlans) root.at("plans").fail(fmt::format("at most {} plans", kMostPlans));
    for (const Element& row : plans) {
        const Plan plan = planOf(row);
        if (std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& r) { return r.plan == plan; }))
            row.at("dials").fail("others than those before");
        table.rows.push_back({plan, {}});
        std::set<std::size_t> seen;
        for (const Element& entry : row.at("entries").list()) {
            const Element key = entry.at("view");
            const auto view = byKey.find(key.text());
            if (view == byKey.end()) key.fail("a key of views");
            if (!seen.insert(view->second).second) key.fail("another than those before");
            table.rows.back().entries.push_back(
                {view->second, entry.at("ms").number(1e-6, kMost), 1.0 - entry.at("ssim").number(-1.0, 1.0)});
        }
    }
    return table;
}

constexpr double kLeastCocPx = 0.25;  // DIAMETER; less is not seen
// Of an error's logarithm, for each doubling of the blur: a picture without any misses by no more than all of it.
constexpr double kMostSlope = 1.0;

/// Doublings between two amounts; below `least` they are as good as equal.
double doublings(double a, double b, double least) {
    const auto sane = [&](double x) { return std::isfinite(x) ? std::max(x, least) : least; };
    return std::log2(sane(a) / sane(b));
}

/// What 1 - SSIM gains where a picture is drawn smaller and enlarged again: as fitted by `bench_governor sizes`.
double errorOfScale(int eighths, double meanCocPx) {
    constexpr double kSharp[] = {0.299, 0.198, 0.121, 0.075, 0.040, 0.001, 0.0};  // 2/8 to 8/8
    return kSharp[std::clamp(eighths, kLeastEighths, 8) - kLeastEighths] * scaleSeen(eighths, meanCocPx);
}

/// How little two views are alike, >= 0; 0: the same. In doublings of blur and of triangles per pixel.
double distanceOf(const ViewClass& a, const ViewClass& b) {
    // Error hangs on blur before all else; what lies on which side of focus is worth a doubling of it.
    const double mean = doublings(a.meanCocPx, b.meanCocPx, kLeastCocPx);
    const double largest = 0.5 * doublings(a.largestCocPx, b.largestCocPx, kLeastCocPx);
    const double side = 1.4 * (a.behindShare - b.behindShare);
    const double density = 0.25 * (doublings(a.triangles, b.triangles, 1.0) - doublings(a.pixels, b.pixels, 1.0));
    return std::hypot(std::hypot(mean, largest), std::hypot(side, density));
}

}  // namespace

double scaleSeen(int eighths, double meanCocPx) {
    constexpr double kHalved = 2.5;  // of what an enlarged pixel is too wide
    const double wider = 8.0 / std::clamp(eighths, kLeastEighths, 8) - 1.0;
    return wider > 0.0 ? 1.0 / (1.0 + std::max(meanCocPx, 0.0) / (kHalved * wider)) : 0.0;
}

TradeTable parseTradeTable(std::string_view json, std::string_view where) {
    constexpr std::size_t kDeepest = 16;
    std::array<std::set<std::string>, kDeepest + 1> keys;  // of the open object at each depth
    const auto check = [&](int depth, Json::parse_event_t event, Json& value) {
        const auto d = static_cast<std::size_t>(depth);
        if (d >= kDeepest) throw InputError(fmt::format("{}: nested deeper than {}", where, kDeepest));
        if (event == Json::parse_event_t::object_start) keys[d + 1].clear();
        if (event == Json::parse_event_t::key && !keys[d].insert(value.get<std::string>()).second)
            throw InputError(fmt::format("{}: key {} appears twice", where, quote(value.get<std::string>())));
        return true;
    };
    try {
        return tableOf({Json::parse(json, check, true, true), where});
    } catch (const Json::parse_error& error) {
        throw InputError(fmt::format("{}: broken JSON at byte {}", where, error.byte));
    }
}

TradeTable readTradeTable(const std::filesystem::path& file) {
    constexpr std::size_t kLimitBytes = 16 << 20;  // a table is some hundred kB
    return parseTradeTable(readFile(file, kLimitBytes), file.string());
}

std::vector<Plan> TradeTable::methods() const {
    std::vector<Plan> methods;
    for (const Row& row : rows)
        if (const Plan method = methodOf(row.plan); std::find(methods.begin(), methods.end(), method) == methods.end())
            methods.push_back(method);
    return methods;
}

ExpectedErrors::ExpectedErrors(const TradeTable& table, const ViewClass& view) : meanCocPx_(view.meanCocPx) {
    constexpr double kLeastError = 1e-5;  // equal pictures have no logarithm
    // A view with less blur than any that was measured is as the least blurred of its kind, and goes on from there.
    ViewClass measured = view;
    double leastCoc = std::numeric_limits<double>::infinity();
    for (const ViewClass& known : table.views) leastCoc = std::min(leastCoc, known.meanCocPx);
    measured.meanCocPx = std::max(view.meanCocPx, leastCoc);
    const double below = std::min(doublings(view.meanCocPx, measured.meanCocPx, kLeastCocPx), 0.0);
    std::vector<double> weights, blurs;
    for (const ViewClass& known : table.views) {
        // So that the nearest decides, and the step from one to the next is no jump
        const double distance = distanceOf(measured, known) + 0.1;
        weights.push_back(std::pow(distance, -4.0));
        blurs.push_back(doublings(known.meanCocPx, measured.meanCocPx, kLeastCocPx));
    }
    for (const TradeTable::Row& row : table.rows) {
        double sum = 0.0, all = 0.0, blur = 0.0, blur2 = 0.0, product = 0.0;
        for (const TradeTable::Entry& entry : row.entries) {
            const double weight = weights[entry.view], logError = std::log(std::max(entry.error, kLeastError));
            sum += weight * logError;
            all += weight;
            blur += weight * blurs[entry.view];
            blur2 += weight * blurs[entry.view] * blurs[entry.view];
            product += weight * blurs[entry.view] * logError;
        }
        // Least squares; a technique that does worse with less blur does so because of what it cannot smooth, no more.
        const double spread = all * blur2 - blur * blur;
        const double slope = spread > 1e-9 * all * all ? (all * product - blur * sum) / spread : 0.0;
        const double logError = sum / all + std::clamp(slope, 0.0, kMostSlope) * below;
        const Plan method = methodOf(row.plan);
        auto curve = std::find_if(curves_.begin(), curves_.end(), [&](const Curve& c) { return c.method == method; });
        if (curve == curves_.end()) curve = curves_.insert(curves_.end(), {method, {}});
        curve->points.push_back({std::log(static_cast<double>(row.plan.samples.value_or(1))), logError});
    }
    // A pinhole's picture is the mipmap technique's without its blur: at its best as good.
    for (Curve& curve : curves_) {
        if (curve.method.technique != TechniqueChoice::pinhole) continue;
        Plan blurred = curve.method;
        blurred.technique = TechniqueChoice::mipmap;
        for (const Curve& other : curves_)
            if (other.method == blurred)
                curve.points.front().logError = std::max(curve.points.front().logError, other.points.front().logError);
    }
    for (Curve& curve : curves_) {
        std::vector<Point>& p = curve.points;
        std::sort(p.begin(), p.end(), [](const Point& a, const Point& b) { return a.logSamples < b.logSamples; });
        // More samples are never worse; what says so is noise.
        for (std::size_t i = 1; i < p.size(); ++i) p[i].logError = std::min(p[i].logError, p[i - 1].logError);
    }
    // Where no reference was measured: about as noise falls
    referenceSlope_ = -0.5;
    for (const Curve& curve : curves_)
        if (curve.method.technique == TechniqueChoice::reference && curve.points.size() > 1)
            referenceSlope_ = (curve.points.back().logError - curve.points.front().logError) /
                              (curve.points.back().logSamples - curve.points.front().logSamples);
}

/// Of the line that holds there, <= 0.
double ExpectedErrors::slopeOf(const Curve& curve, double logSamples) const {
    const std::vector<Point>& p = curve.points;
    if (p.size() < 2) return referenceSlope_;
    std::size_t i = 1;
    while (i + 1 < p.size() && p[i].logSamples < logSamples) ++i;
    return (p[i].logError - p[i - 1].logError) / (p[i].logSamples - p[i - 1].logSamples);
}

double ExpectedErrors::of(const Plan& plan) const {
    Plan method = methodOf(plan);
    method.eighths = 8;
    const auto curve = std::find_if(curves_.begin(), curves_.end(), [&](const Curve& c) { return c.method == method; });
    if (curve == curves_.end()) return 1.0;
    const std::vector<Point>& p = curve->points;
    double logError = p.front().logError;
    if (plan.samples) {
        const double logSamples = std::log(static_cast<double>(std::max(*plan.samples, 1)));
        std::size_t from = 0;
        while (from + 1 < p.size() && p[from + 1].logSamples <= logSamples) ++from;
        logError = p[from].logError + slopeOf(*curve, logSamples) * (logSamples - p[from].logSamples);
    }
    const double error = std::min(std::exp(logError), 1.0);
    return error + (1.0 - error) * errorOfScale(plan.eighths, meanCocPx_);
}

}  // namespace dioptre
