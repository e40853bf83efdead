// What dioptre budget makes of the frames it drew: summary, limits, tables, page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "csv_table.hpp"
#include "frame/budget_rows.hpp"

namespace dioptre {
namespace {

using Json = nlohmann::ordered_json;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

const Plan kMipmap{TechniqueChoice::mipmap, 4, {}, {}};
const Plan kAccumulate8{TechniqueChoice::accumulate, {}, 8, 4}, kAccumulate9{TechniqueChoice::accumulate, {}, 9, 4};

BudgetFrame frame(const Plan& plan, double milliseconds, PlanChange change = PlanChange::none) {
    BudgetFrame f;
    f.plan = plan;
    f.milliseconds = milliseconds;
    f.governed = BudgetFrame::Governed{change, "it fits, and is better", milliseconds * 1.1, 0.9};
    return f;
}

BudgetRun some() {
    BudgetRun run;
    run.with.program = "1.2.3";
    run.with.renderer = "llvmpipe (LLVM)";
    run.scene = "room, </script>";
    run.technique = "auto";
    run.budgetMs = 20.0;
    run.hz = 50.0;
    run.framesWanted = 6;
    run.referenceEvery = 2;
    run.referenceSamples = 64;
    run.frames = {frame(kMipmap, 10.0), frame(kMipmap, 20.0), frame(kAccumulate8, 18.0, PlanChange::up),
                  frame(kAccumulate9, 19.0), frame(kMipmap, 40.0, PlanChange::down)};
    for (std::size_t i = 0; i < run.frames.size(); ++i) run.frames[i].time = static_cast<double>(i) / run.hz;
    run.frames[1].ssim = 0.9;
    run.frames[1].picture = "data:image/jpeg;base64,AAAA";
    run.frames[3].ssim = 0.98;
    run.frames[4].gaze = {0.08, {0.25, 0.75}, true};
    run.frames[4].underGazeD = 1.5;
    return run;
}

TEST(BudgetSummaryTest, CountsFramesAndChanges) {
    const BudgetSummary s = summaryOf(some());
    EXPECT_EQ(s.frames, 5u);
    EXPECT_EQ(s.missed, 1u) << "as long as the budget is within it";
    EXPECT_DOUBLE_EQ(s.missedShare, 0.2);
    EXPECT_DOUBLE_EQ(s.p50, 19.0);
    EXPECT_DOUBLE_EQ(s.p90, 32.0) << "between the values";
    EXPECT_NEAR(s.p99, 39.2, 1e-9);
    EXPECT_DOUBLE_EQ(s.most, 40.0);
    EXPECT_EQ(s.techniqueChanges, 2u) << "more samples are no other technique";
    EXPECT_THAT(s.changes, ElementsAre(Pair("down", 1), Pair("up", 1)));
    EXPECT_EQ(s.compared, 2u);
    EXPECT_DOUBLE_EQ(s.meanSsim.value(), 0.94);
    EXPECT_DOUBLE_EQ(s.worstSsim.value(), 0.9);
    EXPECT_THAT(s.plans, ElementsAre(Pair("mipmap, msaa 4", 3), Pair("accumulate, 8 samples, 4 sub-samples each", 1),
                                     Pair("accumulate, 9 samples, 4 sub-samples each", 1)));
}

TEST(BudgetSummaryTest, NoFramesAreNoTrouble) {
    const BudgetSummary s = summaryOf({});
    EXPECT_EQ(s.frames, 0u);
    EXPECT_EQ(s.missedShare, 0.0);
    EXPECT_EQ(s.most, 0.0);
    EXPECT_EQ(s.meanSsim, std::nullopt);
    EXPECT_THAT(s.plans, IsEmpty());
    EXPECT_THAT(Json::parse(budgetJson({})).at("changes").is_null(), true);
}

TEST(BudgetLimitsTest, AreKeptAtTheirValueAndBrokenBeyond) {
    const BudgetSummary s = summaryOf(some());
    EXPECT_EQ(brokenLimits(s, {}), "");
    EXPECT_EQ(brokenLimits(s, {20.0, 0.94}), "");
    EXPECT_EQ(brokenLimits(s, {19.9, {}}), "20 % of the frames missed the budget, --fail-missed allows 19.9 %");
    EXPECT_EQ(brokenLimits(s, {{}, 0.95}), "the mean SSIM is 0.94000, --fail-ssim asks for 0.95");
    EXPECT_THAT(brokenLimits(s, {0.0, 1.0}), HasSubstr("allows 0 %; the mean SSIM"));
}

TEST(BudgetLimitsTest, WhatWasNotMeasuredIsNotKept) {
    EXPECT_EQ(brokenLimits({}, {0.0, 0.0}), "no frame was compared, --fail-ssim asks for 0");
    BudgetSummary odd;
    odd.meanSsim = std::nan("");
    EXPECT_NE(brokenLimits(odd, {{}, 0.0}), "");
}

TEST(BudgetJsonTest, HasAllKeys) {
    const Json j = Json::parse(budgetJson(some()));
    for (const char* key : {"frames",    "budget_ms",    "p50_ms",
                            "p90_ms",    "p99_ms",       "max_ms",
                            "missed",    "missed_share", "technique_changes",
                            "mean_ssim", "worst_ssim",   "plans",
                            "program",   "commit",       "renderer",
                            "scene",     "width",        "height",
                            "hz",        "head_trace",   "gaze_trace",
                            "compared",  "changes"})
        EXPECT_TRUE(j.contains(key)) << key;
    EXPECT_EQ(j["frames"], 5);
    EXPECT_EQ(j["frames_wanted"], 6);
    EXPECT_EQ(j["missed"], 1);
    EXPECT_DOUBLE_EQ(j["missed_share"].get<double>(), 0.2);
    EXPECT_EQ(j["plans"].begin().key(), "mipmap, msaa 4");
    EXPECT_EQ(j["plans"].begin().value(), 3);
    EXPECT_EQ(j["changes"]["up"], 1);
}

TEST(BudgetJsonTest, WhatThereIsNotIsNull) {
    BudgetRun run = some();
    for (BudgetFrame& f : run.frames) {
        f.ssim.reset();
        f.governed.reset();
    }
    run.scene = "not UTF-8: \xFF";
    const Json j = Json::parse(budgetJson(run));
    EXPECT_TRUE(j["mean_ssim"].is_null());
    EXPECT_TRUE(j["worst_ssim"].is_null());
    EXPECT_TRUE(j["changes"].is_null());
    EXPECT_EQ(j["compared"], 0);
    EXPECT_NO_THROW(budgetPage(run));
}

TEST(BudgetCsvTest, HasACellForEachColumn) {
    BudgetRun run = some();
    run.frames[0].governed.reset();
    const std::string csv = budgetCsv(run);
    const std::vector<std::size_t> cells = cellsPerLine(csv);
    EXPECT_THAT(cells, SizeIs(6u));
    EXPECT_THAT(cells, Each(cells[0]));
    EXPECT_THAT(csv, HasSubstr("\n0,0.000000,\"mipmap, msaa 4\",mipmap,,10.000,20,0,,,,,,"));
    EXPECT_THAT(csv,
                HasSubstr("\n2,0.040000,\"accumulate, 8 samples, 4 sub-samples each\",accumulate,8,18.000,20,0,up,"));
    EXPECT_THAT(csv, HasSubstr("mipmap,,40.000,20,1,down,"));
    EXPECT_THAT(csv, HasSubstr(",0.25000,0.75000,1,1.500000\n"));
}

TEST(BudgetPageTest, HoldsTheFramesAndNeedsNoNetwork) {
    const std::string page = budgetPage(some());
    EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,AAAA"));
    EXPECT_THAT(page, HasSubstr("accumulate, 9 samples, 4 sub-samples each"));
    EXPECT_THAT(page, HasSubstr("room, <\\/script>")) << "data ends no script";
    for (const char* left : {"@DATA@", "@STYLE@", "@SCRIPT@", "src=\"http", "href=\"http", "//cdn"})
        EXPECT_THAT(page, testing::Not(HasSubstr(left)));
}

TEST(BudgetPageTest, ALongRunHasSomeOfItsPictures) {
    BudgetRun run = some();
    run.frames.assign(5000, frame(kMipmap, 10.0));
    for (BudgetFrame& f : run.frames) {
        f.ssim = 0.9;
        f.picture = "data:image/jpeg;base64,AAAA";
    }
    const std::string page = budgetPage(run);
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = page.find("AAAA", at)) != std::string::npos; ++at) ++pictures;
    EXPECT_GE(pictures, 120u);
    EXPECT_LE(pictures, 240u);
}

}  // namespace
}  // namespace dioptre
