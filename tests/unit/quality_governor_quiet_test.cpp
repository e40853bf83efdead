// The governor over a renderer that takes just what its table says, frame by frame.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "quality/governor.hpp"
#include "simulated_renderer.hpp"

namespace dioptre {
namespace {

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

TEST_F(QuietTest, OnceAFramesTimeIsKnownGoesOnWithWhatIsSureToFit) {
    situation.budgetMs = 20000.0;
    const Decision first = frame(), second = frame();
    EXPECT_EQ(first.plan, (Plan{TechniqueChoice::mipmap, 0, {}, {}}));
    EXPECT_LT(second.expectedError, first.expectedError);
    EXPECT_LE(priceOf(second.plan), 0.9 * situation.budgetMs);
    EXPECT_EQ(second.change, PlanChange::none);
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
    EXPECT_GT(priceOf({TechniqueChoice::reference, {}, d.refinement->samplesNow + 1, {}}), 0.9 * situation.budgetMs);
    const ExpectedErrors errors(table(), situation.view);
    EXPECT_LE(errors.of({TechniqueChoice::reference, {}, d.refinement->shownFrom, {}}), errors.of(d.plan));
    EXPECT_GT(errors.of({TechniqueChoice::reference, {}, d.refinement->shownFrom / 2, {}}), errors.of(d.plan));
    situation.unseen = true;
    EXPECT_FALSE(frame().refinement.has_value());
}

TEST_F(QuietTest, RefiningMayTakeLongerThanAFrame) {
    situation.requirements.mayRefine = true;
    // Not even one sample fits into a frame.
    situation.budgetMs = 0.5 * priceOf({TechniqueChoice::reference, {}, 1, {}});
    EXPECT_FALSE(frames(50).refinement.has_value());
    const Plan before = frame().plan;
    situation.refineMs = 10.0 * situation.budgetMs;
    const Decision d = frame();
    ASSERT_TRUE(d.refinement.has_value());
    EXPECT_LE(priceOf({TechniqueChoice::reference, {}, d.refinement->samplesNow, {}}), 0.9 * situation.refineMs);
    EXPECT_EQ(d.plan, before) << "what is drawn where something moves keeps to the budget";
}

TEST_F(QuietTest, WhatRefinesTeachesThePriceOfTheReference) {
    situation.requirements.mayRefine = true;
    frames(60);
    // Everything is twice as dear, and only refining is drawn.
    factor = 2.0;
    int before = 0, after = 0;
    for (int i = 0; i < 30; ++i) {
        const Decision d = governor.decide(situation);
        ASSERT_TRUE(d.refinement.has_value());
        (i == 0 ? before : after) = d.refinement->samplesNow;
        situation.lastMs = priceOf({TechniqueChoice::reference, {}, d.refinement->samplesNow, {}});
        situation.lastRefined = true;
        situation.now += 0.4;
    }
    EXPECT_LE(2.0 * truth.price({TechniqueChoice::reference, {}, after, {}}, situation.view), situation.budgetMs);
    EXPECT_LT(after, before);
    EXPECT_GT(after, before / 4);
}

TEST_F(QuietTest, WhatIsAloneBeginsWithTheBest) {
    situation.alone = true;
    const Decision d = frame();
    EXPECT_LE(d.foreseenMs, 0.9 * situation.budgetMs);
    const ExpectedErrors errors(table(), situation.view);
    const Candidates candidates(governor.prices(), errors, situation.view, situation.requirements);
    for (const Plan& method : candidates.methods()) {
        const auto fits = candidates.within(method, 0.9 * situation.budgetMs);
        if (fits) {
            EXPECT_LE(d.expectedError, fits->error) << planText(fits->plan);
        }
    }
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
        situation.now = 7.0 - i / 2;
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
