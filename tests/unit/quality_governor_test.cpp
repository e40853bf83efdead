// The governor over simulated renderers whose true costs are not those of its table.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "quality/governor.hpp"
#include "simulated_renderer.hpp"

namespace dioptre {
namespace {

const TradeTable& table() {
    static const TradeTable small = readTradeTable(DIOPTRE_TEST_DATA "/trade_small.json");
    return small;
}

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

/// A renderer that takes just what the table says, and one view of it.
class QuietTest : public testing::Test {
  protected:
    QuietTest() {
        situation.view = table().views[1];
        situation.budgetMs = 400.0;
    }
    double priceOf(const Plan& plan) const {
        return truth.price(plan, situation.view) * factor * (plan == cheaper ? 0.5 : 1.0);
    }
    Decision frame() {
        const Decision d = governor.decide(situation);
        double ms = priceOf(d.plan) + (d.fade ? priceOf(d.fade->from) : 0.0);
        situation.lastMs = ms;
        situation.now += std::max(ms, situation.budgetMs) * 1e-3;
        return d;
    }
    Decision frames(int count) {
        Decision d;
        for (int i = 0; i < count; ++i) d = frame();
        return d;
    }

    PriceModel truth{table()};
    Governor governor{table()};
    Situation situation;
    double factor = 1.0;
    std::optional<Plan> cheaper;  // costs half its price
};

TEST_F(QuietTest, BeginsWithTheCheapestThatBlurs) {
    EXPECT_EQ(frame().plan, (Plan{TechniqueChoice::mipmap, 0, {}, {}}));
}

TEST_F(QuietTest, GoesUpOnceItIsForeseenToFitForTenFrames) {
    for (int i = 0; i < 9; ++i) EXPECT_EQ(frame().change, PlanChange::none) << i;
    const Decision d = frame();
    EXPECT_EQ(d.change, PlanChange::up);
    EXPECT_LE(d.foreseenMs, 0.9 * situation.budgetMs);
    EXPECT_FALSE(d.why.empty());
}

TEST_F(QuietTest, DownAtOnceWhereItNoLongerFits) {
    EXPECT_NE(frames(50).plan.technique, TechniqueChoice::mipmap);
    situation.budgetMs = 70.0;
    const Decision d = frame();
    EXPECT_EQ(d.change, PlanChange::down);
    EXPECT_LE(d.foreseenMs, 0.9 * 70.0);
    EXPECT_FALSE(d.fade.has_value());
    situation.budgetMs = 1e-3;
    EXPECT_EQ(frame().plan.eighths, kLeastEighths) << "nothing fits";
}

TEST_F(QuietTest, SamplesGrowByATenthAFrameAndFallAtOnce) {
    situation.budgetMs = 2000.0;
    const int few = *frames(60).plan.samples;
    situation.budgetMs = 6000.0;
    int before = few;
    for (int i = 0; i < 9; ++i) {
        const Decision d = frame();
        ASSERT_TRUE(d.plan.samples.has_value());
        EXPECT_LE(*d.plan.samples, std::max(before + 1, before * 11 / 10)) << i;
        EXPECT_GE(*d.plan.samples, before) << i;
        before = *d.plan.samples;
    }
    EXPECT_GT(before, few);
    situation.budgetMs = 2000.0;
    EXPECT_LE(*frame().plan.samples, few + 1);
}

TEST_F(QuietTest, AMissedFrameTakesSamplesButOneAloneNoMethod) {
    situation.budgetMs = 2000.0;
    const Plan before = frames(60).plan;
    situation.lastMs = 3.0 * situation.budgetMs;
    const Decision d = frame();
    EXPECT_EQ(methodOf(d.plan), methodOf(before));
    EXPECT_LT(*d.plan.samples, *before.samples);
    EXPECT_GT(*d.plan.samples, *before.samples / 2);
    frames(30);
    factor = 20.0;
    const Decision after = frames(4);
    EXPECT_EQ(after.plan.technique, TechniqueChoice::mipmap);
    EXPECT_LE(priceOf(after.plan), situation.budgetMs);
}

TEST_F(QuietTest, FadesWhereBothPlansFit) {
    factor = 0.02;  // of a machine that draws tens of frames a second
    int faded = 0;
    for (const double budget : {8.0, 12.0, 15.0, 20.0, 25.0, 32.0}) {
        governor = Governor(table());
        situation.budgetMs = budget;
        double weight = 0.0, began = 0.0;
        for (int i = 0; i < 300; ++i) {
            const double now = situation.now;
            const Decision d = frame();
            if (d.change == PlanChange::up) weight = 0.0, began = now;
            if (!d.fade) continue;
            ++faded;
            EXPECT_GT(d.fade->weight, weight);
            EXPECT_LE(d.fade->weight, 1.0);
            EXPECT_LE(d.foreseenMs, 0.91 * budget);
            EXPECT_LT(now, began + 0.1);
            const ExpectedErrors errors(table(), situation.view);
            EXPECT_LE(errors.of(d.plan), errors.of(d.fade->from)) << budget << " ms, " << planText(d.plan);
            weight = d.fade->weight;
        }
    }
    EXPECT_GE(faded, 10);
}

// mipmap with msaa 4 looks too dear, and is not.
TEST_F(QuietTest, FindsOutWhatIsCheaperThanItsPrice) {
    const Plan msaa{TechniqueChoice::mipmap, 4, {}, {}};
    situation.budgetMs = 0.9 * truth.price(msaa, situation.view);
    cheaper = msaa;
    const Decision d = frames(static_cast<int>(30e3 / situation.budgetMs));
    EXPECT_EQ(d.plan, msaa);
}

// It is as dear as it looks: a few frames are missed, ever more seldom.
TEST_F(QuietTest, DoesNotTryWhatIsTooDearAgainAndAgain) {
    situation.budgetMs = 0.9 * truth.price({TechniqueChoice::mipmap, 4, {}, {}}, situation.view);
    int missed = 0, ups = 0;
    for (int i = 0; i < 5000; ++i) {
        ups += frame().change == PlanChange::up;
        missed += *situation.lastMs > situation.budgetMs;
    }
    EXPECT_LE(ups, 8);
    EXPECT_LE(missed, 12);
}

// What it draws slows the machine after a while, and only while it is drawn: a price that cannot be remembered.
TEST_F(QuietTest, TriesWhatFailsEachTimeEverMoreSeldom) {
    situation.budgetMs = 200.0;
    int drawn = 0, ups = 0, last = 0;
    for (int i = 0; i < 20000; ++i) {
        factor = drawn > 40 ? 2.0 : 1.0;
        const Decision d = frame();
        drawn = d.plan.technique == TechniqueChoice::mipmap && d.plan.msaa == 0 ? 0 : drawn + 1;
        if (d.change == PlanChange::up) ++ups, last = i;
    }
    EXPECT_GE(ups, 6) << "it does fail, each time";
    EXPECT_LE(ups, 20) << "the last at frame " << last;
}

TEST_F(QuietTest, WhileNobodySeesTheCheapPlanWillDo) {
    situation.budgetMs = 2000.0;
    Plan before = frames(100).plan;
    ASSERT_TRUE(before.samples.has_value());
    int ups = 0;
    for (int saccade = 0; saccade < 50; ++saccade) {
        situation.unseen = true;
        const Decision rested = frame();
        EXPECT_EQ(rested.change, PlanChange::rested);
        EXPECT_EQ(rested.plan, (Plan{TechniqueChoice::mipmap, 0, {}, {}}));
        EXPECT_EQ(frames(2).change, PlanChange::none);
        situation.unseen = false;
        const Decision seen = frame();
        EXPECT_EQ(seen.change, PlanChange::resumed);
        EXPECT_EQ(methodOf(seen.plan), methodOf(before));
        EXPECT_NEAR(*seen.plan.samples, *before.samples, 1 + *before.samples / 10);
        for (int i = 0; i < 5; ++i) ups += frame().change == PlanChange::up;
        before = frame().plan;
    }
    EXPECT_EQ(ups, 0) << "what was there before is no upgrade";
}

TEST_F(QuietTest, BlinksDoNotDelayWhatIsToCome) {
    situation.unseen = true;
    frames(30);
    situation.unseen = false;
    int frame1 = 0;
    while (frame().change != PlanChange::up && frame1 < 100) ++frame1;
    EXPECT_LE(frame1, 12);
}

TEST_F(QuietTest, WhereNothingIsBlurredPinholesAreEnough) {
    situation.budgetMs = 2000.0;
    const Plan before = frames(60).plan;
    situation.requirements.blur = false;
    EXPECT_EQ(methodOf(frames(5).plan), methodOf(before)) << "a focus that only passes";
    EXPECT_EQ(frames(10).plan, (Plan{TechniqueChoice::pinhole, 4, {}, {}}));
    situation.requirements.blur = true;
    const Decision d = frame();
    EXPECT_EQ(d.change, PlanChange::adapted);
    EXPECT_EQ(methodOf(d.plan), methodOf(before));
}

TEST_F(QuietTest, BlurThatComesIntoASharpViewIsThereAtOnce) {
    situation.requirements.blur = false;
    EXPECT_EQ(frames(30).plan.technique, TechniqueChoice::pinhole);
    situation.requirements.blur = true;
    EXPECT_NE(frame().plan.technique, TechniqueChoice::pinhole);
}

TEST_F(QuietTest, AStillViewMayGoOnWithTheReference) {
    EXPECT_FALSE(frames(50).refinement.has_value());
    situation.requirements.mayRefine = true;
    const Decision d = frame();
    ASSERT_TRUE(d.refinement.has_value());
    EXPECT_EQ(d.refinement->plan.technique, TechniqueChoice::reference);
    const Plan now{TechniqueChoice::reference, {}, d.refinement->samplesNow, {}};
    EXPECT_LE(priceOf(now), 0.9 * situation.budgetMs);
    const ExpectedErrors errors(table(), situation.view);
    EXPECT_LE(errors.of({TechniqueChoice::reference, {}, d.refinement->shownFrom, {}}), errors.of(d.plan));
    EXPECT_GT(errors.of({TechniqueChoice::reference, {}, d.refinement->shownFrom / 2, {}}), errors.of(d.plan));
    situation.unseen = true;
    EXPECT_FALSE(frame().refinement.has_value());
}

TEST_F(QuietTest, BrokenTimesTakeNoSamples) {
    situation.budgetMs = 2000.0;
    const int samples = *frames(100).plan.samples;
    for (const double broken : {0.0, -5.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
        for (int i = 0; i < 30; ++i) {
            situation.lastMs = broken;
            situation.now += 2.0;
            EXPECT_GE(governor.decide(situation).plan.samples.value_or(0), samples) << broken;
        }
}

TEST_F(QuietTest, BrokenTimersHarmNothing) {
    const Plan settled = frames(100).plan;
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    for (const double broken : {0.0, -5.0, nan, infinity, -infinity}) {
        for (int i = 0; i < 30; ++i) {
            frame();
            situation.lastMs = broken;
            if (i % 3 == 0) situation.now = broken;
            const Decision d = governor.decide(situation);
            ASSERT_LE(priceOf(d.plan), situation.budgetMs) << broken;
            situation.now = 50.0 + i;
        }
    }
    situation.now = 1000.0;
    situation.budgetMs = 70.0;
    EXPECT_NE(methodOf(frames(5).plan), methodOf(settled));
    situation.budgetMs = 400.0;
    EXPECT_EQ(methodOf(frames(100).plan), methodOf(settled));
}

TEST_F(QuietTest, AClockThatStandsOrRunsBackwardsDelaysNoFadeAndNoChange) {
    factor = 0.02;  // of a machine that draws tens of frames a second
    situation.budgetMs = 20.0;
    int ups = 0, fades = 0, sinceUp = 1000;
    for (int i = 0; i < 400; ++i) {
        situation.now = i % 2 == 0 ? 7.0 : 7.0 - i;
        const Decision d = frame();
        sinceUp = d.change == PlanChange::up ? 0 : sinceUp + 1;
        ups += d.change == PlanChange::up;
        fades += d.fade.has_value();
        if (sinceUp >= 12) {
            EXPECT_FALSE(d.fade.has_value()) << i << ": frames' times stand in for the clock's";
        }
    }
    EXPECT_GE(ups, 1);
    EXPECT_LE(ups, 6);
    EXPECT_GE(fades, 1);
}

TEST_F(QuietTest, AMethodLeftForABetterOneHasNotFailed) {
    situation.budgetMs = 60.0;
    frames(40);
    situation.budgetMs = 130.0;
    const Plan middle = methodOf(frames(60).plan);
    situation.budgetMs = 2000.0;
    ASSERT_NE(methodOf(frames(60).plan), middle);
    situation.budgetMs = 60.0;
    ASSERT_NE(methodOf(frames(30).plan), middle);
    situation.budgetMs = 130.0;
    EXPECT_EQ(methodOf(frames(30).plan), middle);
}

TEST_F(QuietTest, OddSituationsGetAPlan) {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    for (const double odd : {0.0, -1.0, nan, infinity, 1e300}) {
        situation.budgetMs = odd;
        situation.view = {odd, odd, odd, odd, odd, 0};
        for (int i = 0; i < 20; ++i) {
            const Decision d = governor.decide(situation);
            EXPECT_GE(d.plan.samples.value_or(1), 1);
            EXPECT_LE(d.plan.samples.value_or(1), kMostSamples);
            EXPECT_TRUE(std::isfinite(d.foreseenMs)) << odd;
        }
    }
    situation.view = table().views[1];
    situation.budgetMs = 400.0;
    EXPECT_LE(priceOf(frames(100).plan), 400.0);
}

}  // namespace
}  // namespace dioptre
