// The governor over simulated renderers whose true costs are not those of its table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "quality/governor.hpp"
#include "simulated_renderer.hpp"

namespace dioptre {
namespace {

/// What a run looked like, without the frames in which nothing could have fit, and the ten after a step.
struct Outcome {
    int frames = 0, inside = 0;
    double used = 0.0;        // mean share of the budget, of the second half
    std::vector<double> ups;  // seconds
    int changes = 0, lateChanges = 0;
    Decision last;

    double insideShare() const { return frames > 0 ? static_cast<double>(inside) / frames : 1.0; }
    double leastBetweenUps() const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i < ups.size(); ++i) least = std::min(least, ups[i] - ups[i - 1]);
        return least;
    }
};

struct Play {
    SimulatedRenderer& renderer;
    ViewClass view;
    double budgetMs = 0.0;
    int frames = 2400;
    std::function<double(int frame, double now)> load = [](int, double) { return 1.0; };
    bool stepsAreSudden = true;
};

double leastCost(const SimulatedRenderer& renderer, const ViewClass& view, const Governor& governor) {
    double least = std::numeric_limits<double>::infinity();
    for (Plan plan : governor.prices().methods()) {
        if (usesSamples(plan.technique)) plan.samples = kLeastSamples;
        least = std::min(least, renderer.cost(plan, view));
    }
    return least;
}

Outcome play(Play p) {
    Governor governor(table());
    Outcome run;
    Situation s;
    s.view = p.view;
    s.budgetMs = p.budgetMs;
    p.renderer.load = 1.0;
    const double least = leastCost(p.renderer, p.view, governor);
    int countFrom = 10, usedFrames = 0;
    for (int frame = 0; frame < p.frames; ++frame) {
        const double load = p.load(frame, s.now);
        const bool stepped = p.stepsAreSudden && load != p.renderer.load;
        p.renderer.load = load;
        if (stepped || least * load > 0.9 * p.budgetMs) countFrom = std::max(countFrom, frame + 10);
        const Decision d = governor.decide(s);
        double cost = p.renderer.cost(d.plan, p.view);
        if (d.fade) cost += p.renderer.cost(d.fade->from, p.view);
        const double ms = p.renderer.frame(cost);
        if (frame >= countFrom) ++run.frames, run.inside += ms <= p.budgetMs;
        if (frame >= p.frames / 2) run.used += cost / p.budgetMs, ++usedFrames;
        if (d.change == PlanChange::up) run.ups.push_back(s.now);
        if (d.change == PlanChange::up || d.change == PlanChange::down) {
            ++run.changes;
            run.lateChanges += frame >= p.frames / 2;
        }
        run.last = d;
        s.lastMs = ms;
        s.now += std::max(ms, p.budgetMs) * 1e-3;
    }
    run.used /= usedFrames;
    return run;
}

ViewClass someView(SimulatedRenderer& renderer) {
    ViewClass view{9e4 * renderer.off(4.0), 3e5 * renderer.off(3.0), 8.0 * renderer.off(3.0), 0.0, 0.6, 1};
    view.largestCocPx = 4.0 * view.meanCocPx;
    return view;
}

/// From half of what mipmap takes at full size to forty times it.
double someBudget(SimulatedRenderer& renderer, const ViewClass& view) {
    const double mipmap = renderer.cost({TechniqueChoice::mipmap, 0, {}, {}}, view);
    return mipmap * std::sqrt(0.5 * 40.0) * renderer.off(std::sqrt(40.0 / 0.5));
}

/// By its error the best plan that truly fits.
PricedPlan bestOf(const SimulatedRenderer& renderer, const ViewClass& view, double budgetMs) {
    const ExpectedErrors errors(table(), view);
    PricedPlan best{{}, 0.0, 2.0};
    const PriceModel prices(table());
    for (Plan plan : prices.methods()) {
        if (usesSamples(plan.technique)) plan.samples = kLeastSamples;
        if (renderer.cost(plan, view) > 0.9 * budgetMs) continue;
        while (plan.samples && *plan.samples < kMostSamples) {
            Plan more = plan;
            ++*more.samples;
            if (renderer.cost(more, view) > 0.9 * budgetMs) break;
            plan = more;
        }
        if (const double error = errors.of(plan); error < best.error) best = {plan, renderer.cost(plan, view), error};
    }
    return best;
}

constexpr unsigned kSeeds = 50;

// Noise and spikes: spikes alone cost 0.3 %.
TEST(GovernorTest, KeepsTheBudgetAndComesNearTheBestPlan) {
    int nearBest = 0, judged = 0;
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
        SimulatedRenderer renderer(seed);
        const ViewClass view = someView(renderer);
        const double budget = someBudget(renderer, view);
        const Outcome run = play({renderer, view, budget});
        const std::string what = fmt::format("seed {}, {} ms, {}", seed, budget, planText(run.last.plan));
        EXPECT_GE(run.insideShare(), 0.99) << what;
        EXPECT_GE(run.leastBetweenUps(), 1.0) << what;
        EXPECT_LE(run.lateChanges, 8) << what;
        const PricedPlan best = bestOf(renderer, view, budget);
        if (best.error > 1.0) continue;
        ++judged;
        nearBest += run.last.expectedError <= 1.1 * best.error;
    }
    EXPECT_GE(judged, 45);
    EXPECT_GE(nearBest, judged * 90 / 100) << "of " << judged;
}

// With steps of samples finer than a tenth of the budget there is always more that it could have been used for.
TEST(GovernorTest, UsesTheBudgetWhereABetterPlanWouldNotFit) {
    int fine = 0;
    double used = 0.0;
    for (unsigned seed = 0; seed < kSeeds / 2; ++seed) {
        SimulatedRenderer renderer(seed);
        const ViewClass view = someView(renderer);
        const double budget = 60.0 * renderer.cost({TechniqueChoice::mipmap, 0, {}, {}}, view);
        const Outcome run = play({renderer, view, budget});
        const int samples = run.last.plan.samples.value_or(0);
        if (samples < 10 || samples == kMostSamples) continue;
        ++fine;
        used += run.used;
        EXPECT_GE(run.used, 0.8) << seed << ", " << planText(run.last.plan);
        EXPECT_LE(run.used, 0.91) << seed << ", " << planText(run.last.plan);
    }
    EXPECT_GE(fine, 20);
    EXPECT_GE(used / fine, 0.85);
}

TEST(GovernorTest, FollowsALoadThatTriplesForTwoSeconds) {
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
        SimulatedRenderer renderer(seed);
        const ViewClass view = someView(renderer);
        double began = -10.0;
        const Outcome run = play({renderer, view, someBudget(renderer, view), 2400, [&](int frame, double now) {
                                      if (frame % 1200 == 600) began = now;
                                      return now - began < 2.0 ? 3.0 : 1.0;
                                  }});
        EXPECT_GE(run.insideShare(), 0.99) << seed;
        EXPECT_GE(run.leastBetweenUps(), 1.0) << seed;
    }
}

TEST(GovernorTest, FollowsCostsThatDrift) {
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
        SimulatedRenderer renderer(seed);
        const ViewClass view = someView(renderer);
        const Outcome run = play({renderer, view, someBudget(renderer, view), 2400,
                                  [](int frame, double) { return std::exp(0.5 * std::sin(frame / 600.0)); }, false});
        EXPECT_GE(run.insideShare(), 0.99) << seed;
        EXPECT_GE(run.leastBetweenUps(), 1.0) << seed;
    }
}

TEST(GovernorTest, NoLimitCycleInAHundredThousandFrames) {
    for (unsigned seed : {2u, 17u, 20u}) {
        SimulatedRenderer renderer(seed);
        const ViewClass view = someView(renderer);
        const Outcome run = play({renderer, view, someBudget(renderer, view), 100000});
        EXPECT_LE(run.lateChanges, 10) << seed;
        EXPECT_LE(run.changes, 40) << seed;
        EXPECT_GE(run.insideShare(), 0.99) << seed;
    }
}

TEST(GovernorTest, BudgetsFromAMillisecondToTenSeconds) {
    for (const double budget : {1.0, 4.0, 11.1, 33.0, 120.0, 1000.0, 10000.0}) {
        int frames = 0, inside = 0;
        for (unsigned seed = 0; seed < 8; ++seed) {
            SimulatedRenderer renderer(seed);
            const ViewClass view = someView(renderer);
            const Outcome run = play({renderer, view, budget, 800});
            frames += run.frames;
            inside += run.inside;
            if (run.frames > 0) continue;
            // Nothing fits: what is cheapest by true costs, or nearly
            EXPECT_LE(renderer.cost(run.last.plan, view), 1.5 * leastCost(renderer, view, Governor(table())))
                << budget << " ms, seed " << seed << ", " << planText(run.last.plan);
        }
        EXPECT_GE(inside, 0.99 * frames) << budget << " ms";
    }
}

}  // namespace
}  // namespace dioptre
