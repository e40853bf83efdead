// Prices: fitted to a table, then followed from frame to frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "quality/price_model.hpp"

namespace dioptre {
namespace {

const Plan kPinhole{TechniqueChoice::pinhole, 0, {}, {}}, kMipmap{TechniqueChoice::mipmap, 0, {}, {}},
    kMipmap4{TechniqueChoice::mipmap, 4, {}, {}};
const ViewClass kView{1e5, 640.0 * 480.0, 8.0, 30.0, 0.5, 1};

Plan accumulate(int samples) {
    return {TechniqueChoice::accumulate, {}, samples, 4};
}

/// A table of which every time is what the coefficients say.
TradeTable tableOf(const Coefficients& c) {
    TradeTable table;
    for (const double triangles : {1e4, 1e5, 2e6})
        for (const double pixels : {1e5, 3e5, 2e6}) table.views.push_back({triangles, pixels, 8.0, 30.0, 0.5, 1});
    for (const Plan& plan : {kPinhole, Plan{TechniqueChoice::pinhole, 4, {}, {}}, kMipmap, kMipmap4, accumulate(8),
                             accumulate(32), Plan{TechniqueChoice::reference, {}, 16, {}}}) {
        table.rows.push_back({plan, {}});
        for (std::size_t v = 0; v < table.views.size(); ++v)
            table.rows.back().entries.push_back({v, priceOf(c, workOf(plan, table.views[v])), 0.1});
    }
    return table;
}

const Coefficients kCosts = {1e-5, 4e-5, 2e-6, 0.02};

/// A model that has seen the plan take its price for a while.
PriceModel settled(const Plan& plan) {
    PriceModel model(tableOf(kCosts));
    for (int i = 0; i < 200; ++i) model.learn({{plan}}, kView, priceOf(kCosts, workOf(plan, kView)));
    return model;
}

TEST(PriceFitTest, FindsTheCostsAgain) {
    for (const Coefficients& costs : {kCosts, Coefficients{1e-6, 1e-4, 0.0, 0.5}, {0.0, 3e-5, 3e-6, 0.0}}) {
        const Coefficients found = fitPrices(tableOf(costs));
        for (std::size_t k = 0; k < kStages; ++k) EXPECT_NEAR(found[k], costs[k], 1e-6 * costs[k] + 1e-12) << k;
    }
}

TEST(PriceFitTest, NothingCostsLessThanNothing) {
    std::mt19937 random(5);
    for (int round = 0; round < 50; ++round) {
        TradeTable table = tableOf(kCosts);
        for (TradeTable::Row& row : table.rows)
            for (TradeTable::Entry& entry : row.entries)
                entry.milliseconds *= std::exp(std::uniform_real_distribution(-1.0, 1.0)(random));
        const Coefficients found = fitPrices(table);
        for (const double c : found) EXPECT_GE(c, 0.0) << round;
        EXPECT_GT(priceOf(found, workOf(kMipmap, kView)), 0.0) << round;
    }
}

TEST(PriceFitTest, AnyTableGivesPrices) {
    TradeTable one;
    one.views = {kView};
    one.rows = {{kMipmap, {{0, 30.0, 0.05}}}};
    EXPECT_NEAR(PriceModel(one).price(kMipmap, kView), 30.0, 1e-6);
    EXPECT_TRUE(std::isfinite(PriceModel(one).price(accumulate(100), kView))) << "a plan that it does not have";
}

TEST(PriceModelTest, WorkIsThatOfBothEyesAndOfTheSize) {
    ViewClass both = kView;
    both.eyes = 2;
    const PriceModel model(tableOf(kCosts));
    EXPECT_NEAR(model.price(kMipmap, both), 2.0 * model.price(kMipmap, kView), 1e-9);
    Plan half = kMipmap;
    half.eighths = 4;
    const Work whole = workOf(kMipmap, kView), quarter = workOf(half, kView);
    EXPECT_DOUBLE_EQ(quarter[1], 0.25 * whole[1]);
    EXPECT_DOUBLE_EQ(quarter[0], whole[0]);
    ViewClass leveled = kView;
    leveled.leveled = {0.1 * kView.triangles, 0.3 * kView.triangles};
    for (const auto& [eighths, share] : {std::pair(2, 0.1), {3, 0.3}, {4, 1.0}, {8, 1.0}}) {
        half.eighths = eighths;
        EXPECT_DOUBLE_EQ(workOf(half, leveled)[0], share * whole[0]) << eighths;
        EXPECT_DOUBLE_EQ(workOf(half, kView)[0], whole[0]) << eighths;
    }
    EXPECT_GT(workOf(kMipmap4, kView)[1], workOf(kMipmap, kView)[1]);
    // Affine in the samples
    for (std::size_t k = 0; k < kStages; ++k)
        EXPECT_NEAR(workOf(accumulate(30), kView)[k] - workOf(accumulate(20), kView)[k],
                    workOf(accumulate(20), kView)[k] - workOf(accumulate(10), kView)[k], 1e-3);
}

TEST(PriceModelTest, FollowsAStepWithinFiveFrames) {
    for (const double step : {3.0, 1.0 / 3.0, 1.3, 10.0}) {
        PriceModel model = settled(kMipmap);
        const double after = step * model.price(kMipmap, kView);
        for (int i = 0; i < 5; ++i) model.learn({{kMipmap}}, kView, after);
        EXPECT_NEAR(model.price(kMipmap, kView) / after, 1.0, 0.1) << step;
        EXPECT_NEAR(model.load(), step, 0.2 * step) << "what slows one plan at once slows all";
    }
}

TEST(PriceModelTest, ASpikeMovesNothing) {
    for (const double spike : {4.0, 100.0, 0.01}) {
        PriceModel model = settled(kMipmap);
        const double price = model.price(kMipmap, kView);
        model.learn({{kMipmap}}, kView, spike * price);
        EXPECT_TRUE(model.suspects());
        EXPECT_NEAR(model.price(kMipmap, kView), price, 0.01 * price) << spike;
        model.learn({{kMipmap}}, kView, price);
        EXPECT_FALSE(model.suspects());
        EXPECT_NEAR(model.price(kMipmap, kView), price, 0.01 * price) << spike;
    }
}

TEST(PriceModelTest, FollowsADriftAndHoldsStillInNoise) {
    PriceModel model = settled(kMipmap);
    std::mt19937 random(2);
    std::uniform_real_distribution even(0.9, 1.1);
    const double price = model.price(kMipmap, kView);
    double truth = price, worst = 0.0;
    for (int i = 0; i < 3000; ++i) {
        truth = price * std::exp(0.7 * std::sin(i / 500.0));
        model.learn({{kMipmap}}, kView, truth * even(random));
        worst = std::max(worst, std::abs(std::log(model.price(kMipmap, kView) / truth)));
    }
    EXPECT_LE(worst, 0.08);
}

TEST(PriceModelTest, TimesThatNoClockMeasuresAreIgnored) {
    PriceModel model = settled(kMipmap);
    const double price = model.price(kMipmap, kView);
    const double infinity = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 10; ++i)
        for (const double ms : {0.0, -1.0, std::nan(""), infinity, -infinity, 1e-300, 1e300})
            model.learn({{kMipmap}}, kView, ms);
    model.learn({}, kView, 5.0);
    EXPECT_EQ(model.price(kMipmap, kView), price);
}

TEST(PriceModelTest, ARelativePriceIsRememberedWhileOthersAreDrawn) {
    for (const double dearer : {2.0, 6.0}) {
        PriceModel model = settled(kMipmap);
        const double before = model.price(kMipmap, kView), dear = dearer * model.price(kMipmap4, kView);
        for (int i = 0; i < 3; ++i) model.learn({{kMipmap4}}, kView, dear);
        EXPECT_NEAR(model.price(kMipmap4, kView), dear, 0.1 * dear);
        EXPECT_NEAR(model.price(kMipmap, kView), before, 0.4 * before) << "what was known is not to blame";
        for (int i = 0; i < 1000; ++i) model.learn({{kMipmap}}, kView, before);
        EXPECT_NEAR(model.price(kMipmap, kView), before, 0.01 * before);
        EXPECT_NEAR(model.price(kMipmap4, kView), dear, 0.25 * dear) << dearer;
    }
}

TEST(PriceModelTest, TwoPlansInOneFrameCostTheirSum) {
    PriceModel model = settled(kMipmap);
    const double both = model.price(kMipmap, kView) + model.price(kPinhole, kView);
    for (int i = 0; i < 100; ++i) model.learn(std::vector{kPinhole, kMipmap}, kView, 1.5 * both);
    EXPECT_NEAR(model.price(kMipmap, kView) + model.price(kPinhole, kView), 1.5 * both, 0.02 * both);
}

TEST(PriceModelTest, IsLessUnsureOfWhatItSaw) {
    const PriceModel model = settled(kMipmap);
    EXPECT_LT(model.uncertainty(kMipmap, kView), 0.03);
    EXPECT_GT(model.uncertainty(accumulate(8), kView), 0.2);
}

}  // namespace
}  // namespace dioptre
