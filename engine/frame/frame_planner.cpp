#include "frame/frame_planner.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/resources.hpp"
#include "frame/measure_rows.hpp"
#include "gl/context.hpp"
#include "quality/trade_table.hpp"

namespace dioptre {

namespace {

TradeTable tableHere() {
    const std::filesystem::path folder = resource("config/trade");
    const std::filesystem::path own = folder / (rendererFileName(rendererInfo().renderer) + ".json");
    return readTradeTable(std::filesystem::exists(own) ? own : folder / "unknown.json");
}

}  // namespace

FramePlanner::FramePlanner() : governor_(tableHere()) {}

/// Since the frame before.
bool FramePlanner::moved(const Moment& moment) {
    const std::vector<View> eyes(moment.eyes.begin(), moment.eyes.end());
    const bool same = eyes == last_.eyes && moment.lens == last_.lens && moment.scene.version() == last_.version;
    last_ = {eyes, moment.lens, moment.scene.version()};
    return !same;
}

ViewFacts FramePlanner::factsOf(const Moment& moment, const ViewContents& contents) {
    ViewFacts facts;
    const double f = focalLengthPixels(moment.eyes.front()).x;
    // The background, infinitely far, is seen wherever nothing is.
    if (contents.anything) facts.boxes = cocRange(moment.lens, f, Dioptres(contents.nearest), Dioptres(0.0));
    std::vector<CocBin> histogram;
    for (const double vergence : sampler_.vergences()) {
        const double radius = cocRadiusPixels(moment.lens, f, Dioptres(vergence));
        histogram.push_back({radius, radius, 1.0});
    }
    if (!histogram.empty()) facts.pixels = pixelStatistics(histogram);
    facts.highlights = moment.highlights;
    facts.transparency = contents.blended;
    const bool moving = moved(moment);
    facts.moving = moving || moment.alone;
    facts.blades = moment.lens.blades;
    return facts;
}

Decision FramePlanner::decide(const Moment& moment) {
    ViewContents all;
    for (const View& eye : moment.eyes) {
        const ViewContents seen = moment.scene.contents(eye);
        all.nearest = std::max(all.nearest, seen.nearest);
        all.anything = all.anything || seen.anything;
        all.blended = all.blended || seen.blended;
    }
    const ViewFacts facts = factsOf(moment, all);
    requirements_ = require(facts);
    const View& view = moment.eyes.front();
    Situation s;
    s.now = moment.now;
    s.budgetMs = moment.budgetMs;
    s.refineMs = moment.refineMs;
    s.lastMs = std::exchange(lastMs_, std::nullopt);
    s.lastRefined = lastRefined_;
    // Of the whole view's pixels, which a smaller picture has fewer of
    std::vector<double> detail{0.0};
    for (std::size_t i = 0; i < s.view.leveled.size(); ++i) {
        const int eighths = kLeastEighths + static_cast<int>(i);
        detail.push_back(detailPx({TechniqueChoice::pinhole, 0, {}, {}, eighths}) * 8.0 / eighths);
    }
    const std::vector<std::uint64_t> triangles = moment.scene.triangles(view, detail);
    s.view = classOf(facts, static_cast<double>(triangles.front()), static_cast<double>(view.width) * view.height,
                     static_cast<int>(moment.eyes.size()));
    for (std::size_t i = 0; i < s.view.leveled.size(); ++i) s.view.leveled[i] = static_cast<double>(triangles[i + 1]);
    s.requirements = requirements_;
    s.unseen = moment.unseen;
    s.alone = moment.alone;
    return governor_.decide(s);
}

void FramePlanner::finished(double milliseconds, Drew drew) {
    const bool tells = drew == Drew::plan || drew == Drew::refinement;
    lastMs_ = tells ? std::optional(milliseconds) : std::nullopt;
    lastRefined_ = drew == Drew::refinement || drew == Drew::refinementInPart;
}

}  // namespace dioptre
