// dioptre budget: what a run leaves behind, what it refuses, and how it fails.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace dioptre::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

class BudgetTest : public ProgramTest {
  protected:
    /// A budget that no frame of this size misses, and few samples.
    Outcome budget(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {
            "budget", "scene.gltf",          "--out", "run", "--size", "40x30", "--frames", "6", "--budget-ms",
            "10000",  "--reference-samples", "16"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    Json result() const { return Json::parse(read("run/budget.json")); }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "run"))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }
};

const std::vector<std::string> kHeld = {"--technique", "mipmap", "--msaa", "0"};

TEST_F(BudgetTest, AHeldPlanIsDrawnInEveryFrame) {
    std::vector<std::string> options = kHeld;
    options.insert(options.end(), {"--hz", "10", "--reference-every", "3", "--aperture-mm", "12"});
    const Outcome outcome = budget(options);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("6 frames, 0 % longer than 10000 ms"));
    EXPECT_THAT(outcome.err, HasSubstr("run/index.html"));
    EXPECT_THAT(files(), ElementsAre("budget.json", "frames.csv", "index.html"));

    const Json j = result();
    EXPECT_EQ(j.at("frames"), 6);
    EXPECT_EQ(j.at("budget_ms"), 10000.0);
    EXPECT_EQ(j.at("hz"), 10.0);
    EXPECT_EQ(j.at("missed"), 0);
    EXPECT_EQ(j.at("technique"), "mipmap, msaa 0");
    EXPECT_EQ(j.at("technique_changes"), 0);
    EXPECT_EQ(j.at("plans"), Json({{"mipmap, msaa 0", 6}}));
    EXPECT_EQ(j.at("compared"), 2);
    EXPECT_GT(j.at("worst_ssim"), 0.5);
    EXPECT_GE(j.at("mean_ssim"), j["worst_ssim"]);
    EXPECT_LE(j["mean_ssim"], 1.0);
    EXPECT_GT(j.at("p50_ms"), 0.0);
    EXPECT_LE(j["p50_ms"], j.at("p90_ms"));
    EXPECT_LE(j["p99_ms"], j.at("max_ms"));
    EXPECT_THAT(j.at("gaze_trace").get<std::string>(), HasSubstr("seated.gaze.csv"));
    EXPECT_NE(j.at("renderer"), "");

    const std::vector<std::string> rows = linesOf(read("run/frames.csv"));
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_TRUE(rows[0].starts_with("frame,t_s,plan,technique,samples,ms,budget_ms,missed,change,why")) << rows[0];
    EXPECT_TRUE(rows[6].starts_with("5,0.500000,\"mipmap, msaa 0\",mipmap,,")) << rows[6];
    const std::string page = read("run/index.html");
    EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
    EXPECT_THAT(page, testing::Not(HasSubstr("src=\"http")));
}

TEST_F(BudgetTest, TheSameRunGivesTheSamePictures) {
    const auto ssims = [&] {
        std::string values;
        EXPECT_EQ(budget({"--technique", "mipmap", "--msaa", "0", "--reference-every", "2"}).status, 0);
        const Json j = result();
        return fmt::format("{} {}", j.at("mean_ssim").dump(), j.at("worst_ssim").dump());
    };
    const std::string first = ssims();
    EXPECT_EQ(ssims(), first);
}

TEST_F(BudgetTest, TheGovernorChoosesWithinTheBudget) {
    const Outcome outcome = budget({"--frames", "12"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json j = result();
    EXPECT_EQ(j.at("technique"), "auto");
    EXPECT_TRUE(j.at("changes").is_object());
    EXPECT_EQ(j.at("missed"), 0);
    int frames = 0;
    bool samples = false;
    for (const auto& [plan, count] : j.at("plans").items()) {
        frames += count.get<int>();
        samples = samples || plan.find("samples") != std::string::npos;
    }
    EXPECT_EQ(frames, 12);
    EXPECT_TRUE(samples) << "ten seconds are enough for points of the lens: " << j.at("plans");

    // Where nothing fits: what the table has as the cheapest. Which plan turns out to be, at this size, is a matter of
    // chance.
    ASSERT_EQ(budget({"--frames", "12", "--budget-ms", "0.001"}).status, 0);
    const Json missed = result();
    EXPECT_EQ(missed.at("missed"), 12);
    const std::vector<std::string> rows = linesOf(read("run/frames.csv"));
    ASSERT_EQ(rows.size(), 13u);
    EXPECT_THAT(rows[1], HasSubstr("2/8 size"));
}

TEST_F(BudgetTest, AGazeThatIsGivenStaysThere) {
    ASSERT_EQ(budget({"--frames", "2", "--technique", "pinhole", "--gaze", "0.5,0.5"}).status, 0);
    EXPECT_EQ(result().at("gaze_trace"), "");
    ASSERT_EQ(budget({"--frames", "2", "--technique", "pinhole"}).status, 0);
    EXPECT_THAT(result().at("gaze_trace").get<std::string>(), testing::HasSubstr("seated"));
}

TEST_F(BudgetTest, TheRateIsTheBudgetWhereNoneIsGivenAndTheOtherWayAround) {
    ASSERT_EQ(run({"budget", "scene.gltf", "--out", "run", "--size", "40x30", "--frames", "2", "--hz", "50",
                   "--technique", "pinhole", "--reference-every", "0"})
                  .status,
              0);
    EXPECT_DOUBLE_EQ(result().at("budget_ms").get<double>(), 20.0);
    EXPECT_EQ(result().at("compared"), 0);
    EXPECT_TRUE(result().at("mean_ssim").is_null());
    ASSERT_EQ(budget({"--budget-ms", "5000", "--technique", "pinhole"}).status, 0);
    EXPECT_DOUBLE_EQ(result().at("hz").get<double>(), 0.2);
}

TEST_F(BudgetTest, ARunIsAsLongAsItsTraces) {
    const std::vector<std::string> arguments = {
        "budget",  "scene.gltf",        "--out", "run", "--size", "40x30", "--hz", "10", "--technique",
        "pinhole", "--reference-every", "0"};
    const auto framesWith = [&](std::vector<std::string> more) {
        more.insert(more.begin(), arguments.begin(), arguments.end());
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return result().at("frames").get<int>();
    };
    EXPECT_EQ(framesWith({}), 101) << "ten seconds, seated";
    EXPECT_EQ(framesWith({"--time", "9"}), 11);
    write("gaze.csv", "t_s,x,y,valid\n0,0.25,0.5,1\n1.25,0.8,0.5,1\n");
    EXPECT_EQ(framesWith({"--gaze-trace", "gaze.csv"}), 13);
    EXPECT_EQ(result().at("head_trace"), "") << "who gives one trace means it";
    write("one.csv", "t_s,x,y,z,qx,qy,qz,qw\n0,0.1,0,0,0,0,0,1\n");
    EXPECT_EQ(framesWith({"--head-trace", "one.csv"}), 300) << "a single sample has no length";
    EXPECT_EQ(framesWith({"--gaze", "0.25,0.5"}), 300);
    EXPECT_EQ(result().at("gaze_trace"), "") << "who says where to look means it";
}

TEST_F(BudgetTest, ABrokenLimitFailsOnceEverythingIsWritten) {
    std::vector<std::string> options = kHeld;
    options.insert(options.end(), {"--budget-ms", "0.001", "--hz", "10", "--fail-missed", "5", "--fail-ssim", "1"});
    const Outcome outcome = budget(options);
    EXPECT_EQ(outcome.status, 1);
    const std::vector<std::string> lines = linesOf(outcome.err);
    EXPECT_THAT(lines.back(), HasSubstr("error: 100 % of the frames missed the budget, --fail-missed allows 5 %"));
    EXPECT_THAT(lines.back(), HasSubstr("--fail-ssim asks for 1"));
    EXPECT_THAT(files(), ElementsAre("budget.json", "frames.csv", "index.html"));
    EXPECT_EQ(result().at("missed"), 6);
    EXPECT_EQ(budget({"--technique", "pinhole", "--fail-missed", "0", "--fail-ssim", "0"}).status, 0);
}

TEST_F(BudgetTest, RefusesWhatItCannotRun) {
    expectRefused(run({"budget", "scene.gltf", "--budget-ms", "10"}), {"--out"});
    expectRefused(run({"budget", "scene.gltf", "--out", "run"}), {"--budget-ms", "--hz"});
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {"--frames", "0", "1..1000000"},
             {"--frames", "2.5", "no whole number"},
             {"--hz", "nan", "0.001..1000"},
             {"--hz", "0", "0.001..1000"},
             {"--budget-ms", "nan", "ms"},
             {"--budget-ms", "0", "ms"},
             {"--reference-every", "-1", "0..1000000"},
             {"--reference-every", "7", "6 frames"},
             {"--reference-samples", "0", "1..65536"},
             {"--fail-missed", "101", "0..100"},
             {"--fail-missed", "nan", "0..100"},
             {"--fail-ssim", "2", "0..1"},
             {"--size", "40x8", "11x11"},
             {"--gaze-trace", "absent.csv", "absent.csv"},
             {"--show", "coc", "--show"},
             {"--out", "scene.bin", "--out"},
         })
        expectRefused(budget({wrong[0], wrong[1]}), {wrong[0] == "--gaze-trace" ? wrong[1] : wrong[0], wrong[2]});
    expectRefused(budget({"--fail-ssim", "0.9", "--reference-every", "0"}), {"--fail-ssim", "--reference-every"});
    expectRefused(run({"budget", "absent.gltf", "--out", "run", "--budget-ms", "10"}), {"absent.gltf"});
    expectRefused(budget({"--fail-mised", "3"}), {"--fail-mised", "--fail-missed"});
    EXPECT_FALSE(there("run"));
}

TEST_F(BudgetTest, AFolderThatCannotBeWrittenIsSaidBeforeTheRun) {
    const Outcome outcome = budget({"--out", "/proc/run"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(linesOf(outcome.err).size(), 1u) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("/proc/run"));
}

TEST_F(BudgetTest, AFullDiskKeepsWhatWasThere) {
    ASSERT_EQ(budget(kHeld).status, 0);
    const std::string before = read("run/index.html");
    fileSizeLimit = 5000;  // the page is larger
    const Outcome full = budget(kHeld);
    EXPECT_EQ(full.status, 1) << full.err;
    EXPECT_THAT(full.err, HasSubstr("index.html: cannot be written"));
    EXPECT_EQ(read("run/index.html"), before);
    EXPECT_THAT(files(), ElementsAre("budget.json", "frames.csv", "index.html"));
}

TEST_F(BudgetTest, ARunThatIsStoppedKeepsWhatIsFinished) {
    // Stopped when the first tenth is told, as timeout(1) does it: the process, then its group.
    write("steps.sh", R"(
"$1" budget scene.gltf --size 40x30 --frames 2000 --budget-ms 1000 --technique mipmap --reference-samples 16 \
    --out run 2>err.txt & program=$!
for try in $(seq 1200); do
    [ -s err.txt ] && break
    sleep 0.05
done
kill -TERM $program
kill -TERM $program
wait $program
)");
    const Outcome outcome = runProgram("sh", {"steps.sh", DIOPTRE_PROGRAM});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(read("err.txt"), HasSubstr("error: stopped with "));
    const Json j = result();
    EXPECT_GE(j.at("frames"), 100);
    EXPECT_LT(j["frames"], 2000);
    EXPECT_EQ(j.at("frames_wanted"), 2000);
    EXPECT_EQ(linesOf(read("run/frames.csv")).size(), j["frames"].get<std::size_t>() + 1);
    EXPECT_THAT(files(), ElementsAre("budget.json", "frames.csv", "index.html"));
}

}  // namespace
}  // namespace dioptre::test
