// The measured table: what is read, what is refused, what it lets expect.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "quality/trade_table.hpp"

namespace dioptre {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

const std::string kFile = DIOPTRE_TEST_DATA "/trade_small.json";

const TradeTable& small() {
    static const TradeTable table = readTradeTable(kFile);
    return table;
}

Json smallJson() {
    return Json::parse(readFile(kFile, 1 << 20));
}

TEST(TradeTableTest, ReadsWhatWasMeasured) {
    EXPECT_EQ(small().views.size(), 6u);
    EXPECT_EQ(small().rows.size(), 11u);
    EXPECT_EQ(small().methods().size(), 8u) << "reference at three numbers of samples, accumulate with S = 4 at two";
    const TradeTable::Row& row = small().rows[3];
    EXPECT_EQ(row.plan, (Plan{TechniqueChoice::mipmap, 4, {}, {}}));
    EXPECT_EQ(row.entries.size(), 6u);
    EXPECT_EQ(small().views[0].pixels, 640.0 * 480.0);
    EXPECT_GT(small().views[0].largestCocPx, small().views[0].meanCocPx);
}

TEST(TradeTableTest, ShippedTablesAreWhole) {
    for (const char* name : {"llvmpipe", "unknown"}) {
        const TradeTable table = readTradeTable(fmt::format("{}/trade/{}.json", DIOPTRE_CONFIG, name));
        EXPECT_EQ(table.methods().size(), 8u) << name;
        for (const TradeTable::Row& row : table.rows) EXPECT_EQ(row.entries.size(), table.views.size()) << name;
    }
}

// The smallest and the largest scene's times, the lowest SSIM of all scenes in the same blur and focus
TEST(TradeTableTest, TheTableForUnknownRenderersIsMadeOfTheMeasuredOne) {
    const auto read = [](const char* name) {
        const std::string text = readFile(fmt::format("{}/trade/{}.json", DIOPTRE_CONFIG, name), 1 << 20);
        return Json::parse(text, nullptr, true, true).at("plans");
    };
    const auto lens = [](const std::string& view) { return view.substr(view.find('-')); };
    const Json measured = read("llvmpipe"), unknown = read("unknown");
    ASSERT_EQ(measured.size(), unknown.size());
    for (std::size_t i = 0; i < unknown.size(); ++i) {
        EXPECT_EQ(unknown[i].at("technique"), measured[i].at("technique"));
        EXPECT_EQ(unknown[i].at("dials"), measured[i].at("dials"));
        for (const Json& entry : unknown[i].at("entries")) {
            const std::string view = entry.at("view");
            double time = 0.0, least = 1.0;
            for (const Json& m : measured[i].at("entries")) {
                if (m.at("view") == view) time = m.at("ms");
                if (lens(m.at("view")) == lens(view)) least = std::min(least, m.at("ssim").get<double>());
            }
            EXPECT_NEAR(entry.at("ms").get<double>() / time, 1.0, 1e-3) << view;
            EXPECT_NEAR(entry.at("ssim").get<double>(), least, 1e-4) << view;
        }
    }
}

TEST(TradeTableTest, RefusalsNameFileAndElement) {
    const auto expectRefused = [](const std::string& text, const char* what) {
        try {
            parseTradeTable(text, "t.json");
            ADD_FAILURE() << "taken, " << what;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("t.json: "));
            EXPECT_THAT(error.what(), HasSubstr(what));
        }
    };
    const auto changed = [](const char* pointer, const Json& value) {
        Json json = smallJson();
        json[Json::json_pointer(pointer)] = value;
        return json.dump();
    };
    expectRefused("", "broken JSON");
    expectRefused("[1]", "t.json: '[1]', must be an object");
    expectRefused(changed("/schema", 1), "schema: '1', must be");
    expectRefused(changed("/views", Json::array()), "views: '[]', must be a list");
    expectRefused(changed("/views/2/width", 0), "views[2].width: '0', must be a number from 1");
    expectRefused(changed("/views/2/key", 7), "views[2].key: '7', must be text");
    expectRefused(changed("/views/2/triangles", "many"), "views[2].triangles");
    expectRefused(changed("/views/2/behind_share", 1.1), "views[2].behind_share");
    expectRefused(changed("/views/1/key", smallJson()["views"][0]["key"]), "views[1].key");
    expectRefused(changed("/plans/0/technique", "magic"), "plans[0].technique: '\"magic\"', must be a technique");
    expectRefused(changed("/plans/0/dials/msaa", 2), "plans[0].dials.msaa: '2', must be 0 or 4");
    expectRefused(changed("/plans/1/dials/msaa", 0), "plans[1].dials");
    expectRefused(changed("/plans/4/dials/samples", 0.5), "plans[4].dials.samples");
    expectRefused(changed("/plans/4/entries/1/ms", 0), "plans[4].entries[1].ms");
    expectRefused(changed("/plans/4/entries/1/ms", nullptr), "plans[4].entries[1].ms");
    expectRefused(changed("/plans/4/entries/1/ssim", 1.5), "plans[4].entries[1].ssim: '1.5', must be a number from -1");
    expectRefused(changed("/plans/4/entries/1/view", "x"), "plans[4].entries[1].view: '\"x\"', must be a key of views");
    expectRefused(changed("/plans/4/entries/1/view", smallJson()["plans"][4]["entries"][0]["view"]),
                  "plans[4].entries[1].view: ");
    expectRefused(changed("/views/2/width", 640.5), "views[2].width: '640.5', must be an integer");
    expectRefused(changed("/plans/4/entries/1/ms", -1), "plans[4].entries[1].ms: '-1', must be a number from");
    expectRefused(changed("/plans/4/entries/1/ms", 1e300), "plans[4].entries[1].ms");
    expectRefused(std::string(100000, '['), "nested deeper than 16");
    expectRefused(R"({"schema": 2, "schema": 2})", "key 'schema' appears twice");
    Json without = smallJson();
    without["plans"][3]["entries"][2].erase("ssim");
    expectRefused(without.dump(), "plans[3].entries[2]: key 'ssim' is missing");
    EXPECT_THROW(readTradeTable("/no/such/file.json"), InputError);
}

TEST(ExpectedErrorsTest, OfAMeasuredViewAreAboutThoseMeasured) {
    for (std::size_t view = 0; view < small().views.size(); ++view) {
        const ExpectedErrors errors(small(), small().views[view]);
        for (const TradeTable::Row& row : small().rows) {
            const double measured = row.entries[view].error;
            EXPECT_NEAR(errors.of(row.plan) / measured, 1.0, 0.05) << view << " " << planText(row.plan);
        }
    }
}

TEST(ExpectedErrorsTest, FallWithTheSamples) {
    for (const ViewClass& view : small().views) {
        const ExpectedErrors errors(small(), view);
        for (const Plan& method : small().methods()) {
            if (!usesSamples(method.technique)) continue;
            double before = 1.0;
            for (int n = 1; n <= 4096; n = n + 1 + n / 8) {
                Plan plan = method;
                plan.samples = n;
                const double error = errors.of(plan);
                EXPECT_LE(error, before) << planText(plan);
                EXPECT_GT(error, 0.0) << planText(plan);
                before = error;
            }
        }
    }
}

TEST(ExpectedErrorsTest, BetweenMeasuredSamplesAreStraightInTheLogarithms) {
    const ViewClass& view = small().views[1];
    const ExpectedErrors errors(small(), view);
    const auto of = [&](int n) { return errors.of({TechniqueChoice::reference, {}, n, {}}); };
    EXPECT_NEAR(of(8), std::sqrt(of(4) * of(16)), 1e-9);
    EXPECT_NEAR(of(32), std::sqrt(of(16) * of(64)), 1e-9);
    EXPECT_NEAR(of(256) / of(64), of(64) / of(16), 1e-9) << "goes on beyond";
    const auto slope = std::log(of(64) / of(4)) / std::log(16.0);
    const auto once = [&](int n) { return errors.of({TechniqueChoice::accumulate, {}, n, 8}); };
    EXPECT_NEAR(std::log(once(16) / once(8)) / std::log(2.0), slope, 1e-9) << "measured at one N";
}

TEST(ExpectedErrorsTest, ChangeGraduallyFromViewToView) {
    ViewClass view = small().views[0];
    view.meanCocPx = 0.1;
    const Plan plan{TechniqueChoice::pinhole, 0, {}, {}};
    double before = ExpectedErrors(small(), view).of(plan);
    for (; view.meanCocPx < 100.0; view.meanCocPx *= 1.02) {
        const double now = ExpectedErrors(small(), view).of(plan);
        EXPECT_NEAR(now / before, 1.0, 0.12) << view.meanCocPx;
        before = now;
    }
}

TEST(ExpectedErrorsTest, WithLessBlurThanMeasuredPinholesAndSamplesDoBetter) {
    ViewClass view = small().views[0];
    for (const ViewClass& known : small().views)
        if (known.meanCocPx < view.meanCocPx) view = known;
    const ExpectedErrors least(small(), view);
    view.meanCocPx *= 0.25;
    const ExpectedErrors less(small(), view);
    const Plan pinhole{TechniqueChoice::pinhole, 0, {}, {}}, mipmap{TechniqueChoice::mipmap, 0, {}, {}},
        reference{TechniqueChoice::reference, {}, 4, {}};
    EXPECT_LT(less.of(pinhole), 0.7 * least.of(pinhole));
    EXPECT_LT(less.of(reference), 0.7 * least.of(reference));
    EXPECT_LE(less.of(mipmap), 1.001 * least.of(mipmap));
    EXPECT_GE(less.of(pinhole), less.of(mipmap));
    view.meanCocPx = 0.0;
    const double none = ExpectedErrors(small(), view).of(pinhole);
    view.meanCocPx = 0.25;
    EXPECT_DOUBLE_EQ(ExpectedErrors(small(), view).of(pinhole), none) << "goes on no farther";
}

TEST(ExpectedErrorsTest, SmallerPicturesAreWorse) {
    const ExpectedErrors errors(small(), small().views[1]);
    for (int eighths = kLeastEighths; eighths < 8; ++eighths)
        EXPECT_GT(errors.of({TechniqueChoice::mipmap, 0, {}, {}, eighths}),
                  errors.of({TechniqueChoice::mipmap, 0, {}, {}, eighths + 1}));
    EXPECT_EQ(errors.of({TechniqueChoice::accumulate, {}, 8, 3}), 1.0) << "never measured";
}

}  // namespace
}  // namespace dioptre
