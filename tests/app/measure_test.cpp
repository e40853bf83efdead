// dioptre measure: complete tables, a page, and runs that go on where they stopped.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "program.hpp"

namespace dioptre::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class MeasureTest : public ProgramTest {
  protected:
    // References of a test are not for the user's cache.
    MeasureTest() { ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1); }
    ~MeasureTest() override { ::unsetenv("XDG_CACHE_HOME"); }

    Outcome measure(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {"measure",   "scene.gltf", "--out",  "trade",
                                              "--samples", "32",         "--size", "64x48"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    Json table() const { return Json::parse(read("trade/trade.json")); }
    std::vector<std::filesystem::path> references() const {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "cache/dioptre/references"))
            files.push_back(entry.path());
        return files;
    }
};

// Three blurs, near and far; pinhole and mipmap with msaa 0 and 4, accumulate with 8 samples (4 and 8 sub-samples) and 16,
// the reference with 4 and 16 of 32.
constexpr std::size_t kViews = 6, kRows = kViews * 9;

TEST_F(MeasureTest, WritesWholeTablesAndAPage) {
    const Outcome outcome = measure();
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("54/54"));
    EXPECT_THAT(outcome.err, HasSubstr("trade/index.html"));

    const Json all = table();
    for (const char* key : {"renderer", "version", "cpu", "commit", "program", "date", "system"})
        EXPECT_NE(all.at(key).get<std::string>(), "") << key;
    EXPECT_EQ(all.at("settings").at("samples_per_half"), 32);
    ASSERT_EQ(all.at("views").size(), kViews);
    ASSERT_EQ(all.at("rows").size(), kRows);
    for (const Json& view : all["views"]) {
        EXPECT_EQ(view.at("width"), 64);
        EXPECT_GT(view.at("aperture_mm"), 0.0);
        EXPECT_EQ(view.at("reference").at("samples"), 64);
        EXPECT_GT(view["reference"].at("ssim"), 0.5);
        EXPECT_LE(view["reference"]["ssim"], 1.0);
        EXPECT_GT(view["reference"].at("ms"), 0.0);
    }
    std::set<std::string> keys;
    double psnrOf4 = 0.0, psnrOf16 = 0.0;
    for (const Json& row : all["rows"]) {
        EXPECT_TRUE(keys.insert(row.at("view").get<std::string>() + row.at("technique").get<std::string>() +
                                row.at("dials").dump())
                        .second);
        EXPECT_GT(row.at("ms_median"), 0.0);
        EXPECT_LE(row.at("ms_p10"), row["ms_median"]);
        EXPECT_GE(row.at("ms_p90"), row["ms_median"]);
        EXPECT_GE(row.at("frames"), 2);
        EXPECT_GE(row.at("ssim"), 0.0);
        EXPECT_LE(row["ssim"], 1.0);
        EXPECT_GE(row.at("flip"), 0.0);
        EXPECT_LE(row["flip"], 1.0);
        EXPECT_GT(row.at("technique_bytes"), 0);
        EXPECT_FALSE(row.at("stages").empty());
        const auto& dials = row["dials"];
        const int samples = dials.value("samples", 1);
        if (row.at("technique") == "accumulate") {
            EXPECT_LE(row.at("triangles"), 4 * samples) << "two squares, at most once a sample";
            EXPECT_TRUE(dials.contains("subsamples"));
            continue;
        }
        EXPECT_EQ(row.at("triangles"), 4 * samples) << "two squares";
        if (samples == 4) psnrOf4 += row.at("psnr_db").get<double>();
        if (samples == 16) psnrOf16 += row.at("psnr_db").get<double>();
        if (dials.value("msaa", -1) == 0) {
            EXPECT_EQ(row.at("skipped").at(0).at("name"), "resolve");
        }
    }
    EXPECT_GT(psnrOf16, psnrOf4) << "more samples are closer to the reference";
    EXPECT_EQ(linesOf(read("trade/trade.csv")).size(), kRows + 1);

    std::string governors;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "trade"))
        if (entry.path().filename().string().starts_with("trade-")) governors = textOf(entry.path());
    EXPECT_EQ(Json::parse(governors).at("plans").size(), kRows / kViews);

    const std::string page = read("trade/index.html");
    EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,"));
    EXPECT_THAT(page, testing::Not(HasSubstr("@DATA@")));
    EXPECT_THAT(page, testing::Not(HasSubstr("src=\"http")));
}

TEST_F(MeasureTest, ResumingAddsWhatIsMissing) {
    ASSERT_EQ(measure().status, 0);
    const Json before = table();
    const Outcome nothing = measure({"--resume"});
    EXPECT_EQ(nothing.status, 0) << nothing.err;
    EXPECT_THAT(nothing.err, HasSubstr("54 rows, 0 of them new"));
    EXPECT_EQ(table().at("rows"), before.at("rows"));

    // As if it had been stopped: half of the rows are lost, a reference is broken, another one gone.
    Json half = before;
    half["rows"].erase(half["rows"].begin() + kRows / 2, half["rows"].end());
    write("trade/trade.json", half.dump());
    const auto files = references();
    ASSERT_EQ(files.size(), 2 * kViews);
    for (const auto& file : files) std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    const Outcome rest = measure({"--resume"});
    EXPECT_EQ(rest.status, 0) << rest.err;
    EXPECT_THAT(rest.err, HasSubstr("54 rows, 27 of them new"));
    EXPECT_THAT(rest.err, HasSubstr("it is drawn anew"));
    const Json after = table();
    for (std::size_t i = 0; i < kRows; ++i)
        for (const char* key : {"view", "technique", "dials", "ssim"})
            EXPECT_EQ(after["rows"][i].at(key), before["rows"][i].at(key)) << "row " << i << ", " << key;

    expectRefused(measure({"--resume", "--samples", "16"}), {"--resume", "trade.json", "other"});
    write("trade/trade.json", "{");
    expectRefused(measure({"--resume"}), {"trade.json"});
}

TEST_F(MeasureTest, StoppingKeepsWhatIsFinished) {
    // Signalled when the first row is written, as timeout(1) does it: the process, then its group.
    const Outcome stopped = runProgram("sh", {"-c", R"(
"$0" measure scene.gltf --out trade --size 320x240 --samples 300 &
until [ -s trade/trade.json ]; do kill -0 $! || exit 90; sleep 0.02; done
kill -TERM $!
kill -TERM $!
wait $!
)",
                                              DIOPTRE_PROGRAM});
    EXPECT_EQ(stopped.status, 1) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("--resume"));
    EXPECT_GE(table().at("rows").size(), 1u);
    EXPECT_LT(table().at("rows").size(), kRows);
    EXPECT_TRUE(there("trade/index.html"));
}

TEST_F(MeasureTest, RefusesWhatItCannotMeasure) {
    expectRefused(run({"measure", "scene.gltf"}), {"--out"});
    expectRefused(run({"measure", "absent.gltf", "--out", "trade"}), {"absent.gltf"});
    expectRefused(measure({"--size", "64"}), {"--size", "64"});
    expectRefused(measure({"--samples", "0"}), {"--samples"});
    expectRefused(measure({"scene.gltf"}), {"scene"});
    expectRefused(run({"measure", "scene.gltf", "--out", "scene.bin"}), {"scene.bin"});
    expectRefused(run({"measure", "builtin:absent", "--out", "trade"}), {"absent", "studio"});
}

}  // namespace
}  // namespace dioptre::test
