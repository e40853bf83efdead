// The arithmetic of dioptre measure: Pareto front, percentiles, lenses, tables, pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "core/color.hpp"
#include "core/error.hpp"
#include "csv_table.hpp"
#include "frame/measure_content.hpp"
#include "frame/measure_lens.hpp"
#include "frame/measure_pictures.hpp"
#include "frame/measure_rows.hpp"
#include "quality/trade_table.hpp"

namespace dioptre {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(MeasureParetoTest, KeepsWhatNothingBeats) {
    const TradePoint points[] = {{10, 0.5}, {20, 0.2}, {15, 0.6}, {30, 0.2}, {40, 0.1}, {5, 0.9}};
    EXPECT_THAT(paretoFront(points), ElementsAre(5, 0, 1, 4));
}

TEST(MeasureParetoTest, OfEqualPointsTheFirst) {
    const TradePoint points[] = {{1, 0.5}, {1, 0.5}, {1, 0.4}, {1, 0.4}};
    EXPECT_THAT(paretoFront(points), ElementsAre(2));
    EXPECT_THAT(paretoFront({}), IsEmpty());
    const double infinity = std::numeric_limits<double>::infinity();
    const TradePoint odd[] = {{1, std::nan("")}, {infinity, 0.0}, {2, 0.3}};
    EXPECT_THAT(paretoFront(odd), ElementsAre(2));
}

// By definition: a point is on the front unless another is no worse in both and better in one, or equal and earlier.
TEST(MeasureParetoTest, MatchesItsDefinition) {
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<TradePoint> points;
        for (int i = 0; i < 30; ++i)
            points.push_back({static_cast<double>(random() % 12), static_cast<double>(random() % 12)});
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool beaten = false;
            for (std::size_t j = 0; j < points.size(); ++j) {
                const TradePoint &a = points[j], &b = points[i];
                const bool equal = a.cost == b.cost && a.error == b.error;
                beaten = beaten || (a.cost <= b.cost && a.error <= b.error && (!equal || j < i));
            }
            if (!beaten) expected.push_back(i);
        }
        EXPECT_THAT(paretoFront(points), testing::UnorderedElementsAreArray(expected)) << "round " << round;
    }
}

TEST(MeasureStatisticsTest, PercentilesLieBetweenTheValues) {
    EXPECT_EQ(percentile({}, 0.5), 0.0);
    EXPECT_EQ(percentile({7}, 0.1), 7.0);
    EXPECT_EQ(percentile({3, 1, 2}, 0.5), 2.0);
    EXPECT_DOUBLE_EQ(percentile({1, 2, 3, 4}, 0.5), 2.5);
    EXPECT_EQ(percentile({4, 1}, 0.0), 1.0);
    EXPECT_EQ(percentile({4, 1}, 1.0), 4.0);
    const Timing timing = timingOf({9, 1, 2, 3, 4, 5, 6, 7, 8});
    EXPECT_DOUBLE_EQ(timing.median, 5.0);
    EXPECT_DOUBLE_EQ(timing.p10, 1.8);
    EXPECT_DOUBLE_EQ(timing.p90, 8.2);
    EXPECT_EQ(timing.frames, 9);
}

TEST(MeasureStatisticsTest, Words) {
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.0), "59 s");
    EXPECT_EQ(durationText(90.0), "2 min");
    EXPECT_EQ(durationText(3900.0), "1 h 5 min");
    EXPECT_EQ(rendererFileName("llvmpipe (LLVM 15.0.6, 256 bits)"), "llvmpipe");
    EXPECT_EQ(rendererFileName("NVIDIA H200/PCIe/SSE2"), "nvidia-h200-pcie-sse2");
    EXPECT_EQ(rendererFileName("../(x)"), "unknown");
}

TEST(MeasureLensTest, BlurIsWhatItsNameSays) {
    std::vector<double> vergences;
    for (int i = 0; i <= 1000; ++i) vergences.push_back(0.002 * i);
    const VergenceStatistics seen(vergences);
    EXPECT_DOUBLE_EQ(seen.nearest(), 2.0);
    EXPECT_DOUBLE_EQ(seen.farthest(), 0.0);
    for (const MeasuredBlur& blur : kMeasuredBlurs)
        for (const MeasuredFocus& focus : kMeasuredFocuses)
            for (const int width : {320, 640, 1280}) {
                const double f = 0.9 * width;
                const Lens lens = measuredLens(seen, focus, blur, f, width);
                EXPECT_NO_THROW(validate(lens));
                EXPECT_NEAR(lens.focus.value, 2.0 * focus.share, 1e-9);
                double sum = 0.0;
                for (const double d : vergences) sum += std::abs(cocRadiusPixels(lens, f, Dioptres(d)));
                EXPECT_NEAR(2.0 * sum / 1001.0, blur.meanDiameterPx * width / 640.0, 1e-6)
                    << blur.name << " " << focus.name << " " << width;
            }
}

TEST(MeasureLensTest, OddScenesGetAValidLens) {
    for (const std::vector<double>& vergences :
         {std::vector<double>{}, {1.0}, {1.0, 1.0, 1.0}, {0.0, 0.0}, {1000.0, 999.0}, {1.0, 1.0 + 1e-9}}) {
        const VergenceStatistics seen(vergences);
        for (const MeasuredFocus& focus : kMeasuredFocuses)
            EXPECT_NO_THROW(validate(measuredLens(seen, focus, kMeasuredBlurs[2], 600.0, 640)));
    }
}

MeasuredView someView() {
    MeasuredView v;
    v.key = "room-640x480-paper-near";
    v.scene = "room, \"small\"";
    v.content = "00ff";
    v.triangles = 12;
    v.width = 640;
    v.height = 480;
    v.blur = "paper";
    v.focus = "near";
    v.apertureMm = 24.1;
    v.focusD = 1.0 / 3.0;
    v.meanCocPx = 8.0;
    v.nearestCocPx = -40.25;
    v.farthestCocPx = 13.0;
    v.nearestD = 4.0;
    v.referenceSamples = 512;
    v.referenceMs = 1234.5;
    v.noise = {40.0, 0.99, 0.01};
    return v;
}

MeasuredRow someRow(const std::string& technique, double milliseconds, double ssim) {
    MeasuredRow r;
    r.view = someView().key;
    r.technique = technique;
    r.dials = {{"msaa", technique == "pinhole" ? 0 : 4}};
    r.time = {milliseconds, milliseconds * 0.9, milliseconds * 1.2, 9};
    r.stages = {{"geometry", 3.0, 1}, {"blur", 1.5, 2}};
    r.skipped = {{"reach", "nothing is in front"}};
    r.error = {std::numeric_limits<double>::infinity(), ssim, 0.05};
    r.triangles = 12;
    if (technique == "mipmap") r.fetchesPerPixel = 22.5;
    r.techniqueBytes = 100;
    r.processPeakBytes = 200;
    return r;
}

Measurements some() {
    Measurements all;
    all.with.program = "1.2.3";
    all.with.renderer = "llvmpipe (LLVM)";
    all.with.sizes = {"640x480"};
    all.with.blurs = {{"paper", 8.0}};
    all.views = {someView()};
    all.rows = {someRow("pinhole", 10.0, 0.8), someRow("mipmap", 20.0, 0.95), someRow("worse", 30.0, 0.9)};
    all.markPareto();
    return all;
}

TEST(MeasureTableTest, JsonReadsBackAsItWas) {
    const Measurements all = some();
    const std::string json = measurementsJson(all);
    const Measurements back = parseMeasurements(json, "trade.json");
    EXPECT_EQ(measurementsJson(back), json);
    EXPECT_TRUE(back.with.comparable(all.with));
    EXPECT_TRUE(back.views[0].sameAs(all.views[0]));
    ASSERT_EQ(back.rows.size(), 3u);
    EXPECT_TRUE(std::isinf(back.rows[0].error.psnr));
    EXPECT_EQ(back.rows[0].fetchesPerPixel, std::nullopt);
    EXPECT_EQ(back.rows[1].fetchesPerPixel, 22.5);
    EXPECT_EQ(back.rows[1].key(), "mipmap-msaa4");
    EXPECT_EQ(back.rows[1].dialsText(), "msaa 4");
    EXPECT_NE(back.row(someView().key, "mipmap-msaa4"), nullptr);
    EXPECT_EQ(back.row(someView().key, "mipmap-msaa0"), nullptr);
}

TEST(MeasureTableTest, OtherConditionsAreNotComparable) {
    MeasuredWith a = some().with, b = a;
    b.date = "tomorrow";
    b.load = 3.0;
    b.sizes = {"1x1"};
    EXPECT_TRUE(a.comparable(b)) << "more sizes may follow";
    b.samplesPerHalf = 1;
    EXPECT_FALSE(a.comparable(b));
    b = a;
    b.commit = "another";
    EXPECT_FALSE(a.comparable(b));
}

TEST(MeasureTableTest, MarksTheFront) {
    const Measurements all = some();
    EXPECT_TRUE(all.rows[0].pareto);
    EXPECT_TRUE(all.rows[1].pareto);
    EXPECT_FALSE(all.rows[2].pareto);
}

TEST(MeasureTableTest, BrokenFilesNameThemselves) {
    const std::string json = measurementsJson(some());
    const auto expectRefused = [](const std::string& text, const char* what) {
        try {
            parseMeasurements(text, "trade.json");
            ADD_FAILURE() << "taken: " << text.substr(0, 60);
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("trade.json"));
            EXPECT_THAT(error.what(), HasSubstr(what));
        }
    };
    expectRefused("", "parse error");
    expectRefused(json.substr(0, json.size() / 2), "parse error");
    expectRefused("[]", "not what dioptre measure writes");
    expectRefused("{\"schema\": 2}", "schema 2");
    for (const char* key : {"\"ms_p90\"", "\"content\"", "\"rows\"", "\"samples_per_half\""}) {
        std::string without = json;
        without.replace(without.find(key), 3, "\"__");
        expectRefused(without, "key");
    }
}

TEST(MeasureTableTest, CsvHasACellForEachColumn) {
    const std::string csv = measurementsCsv(some());
    const std::vector<std::size_t> cells = cellsPerLine(csv);
    EXPECT_THAT(cells, SizeIs(4u));
    EXPECT_THAT(cells, Each(cells[0]));
    EXPECT_THAT(csv, HasSubstr("\"room, \"\"small\"\"\",640,480,paper,near,"));
    EXPECT_THAT(csv, HasSubstr("\"geometry=3.0000;blur=1.5000\",\"reach: nothing is in front\""));
}

TEST(MeasureTableTest, TheGovernorsTableHasMeansAndTheFront) {
    Measurements all = some();
    MeasuredView other = someView();
    other.key = "garden-640x480-paper-near";
    all.views.push_back(other);
    for (MeasuredRow r : std::vector<MeasuredRow>(all.rows)) {
        r.view = other.key;
        r.time.median += 10.0;
        all.rows.push_back(r);
    }
    const auto table = nlohmann::json::parse(governorTable(all));
    ASSERT_EQ(table.at("plans").size(), 3u);
    const auto& mipmap = table["plans"][1];
    EXPECT_EQ(mipmap.at("technique"), "mipmap");
    EXPECT_EQ(mipmap.at("dials").at("msaa"), 4);
    EXPECT_DOUBLE_EQ(mipmap.at("ms").get<double>(), 25.0);
    EXPECT_DOUBLE_EQ(mipmap.at("ms_over_pinhole").get<double>(), 10.0);
    EXPECT_EQ(mipmap.at("psnr_db"), 100.0);
    ASSERT_EQ(mipmap.at("entries").size(), 2u);
    EXPECT_EQ(mipmap["entries"][1].at("view"), "garden-640x480-paper-near");
    EXPECT_DOUBLE_EQ(mipmap["entries"][1].at("ms").get<double>(), 30.0);
    ASSERT_EQ(table.at("views").size(), 2u);
    EXPECT_DOUBLE_EQ(table["views"][0].at("mean_coc_px").get<double>(), 8.0);
    EXPECT_DOUBLE_EQ(table["views"][0].at("behind_share").get<double>(), 0.85);
    EXPECT_EQ(table.at("front"), nlohmann::json({0, 1}));
}

TEST(MeasureTableTest, TheGovernorReadsItsTable) {
    Measurements all = some();
    all.rows.pop_back();  // a technique that does not exist
    const TradeTable table = parseTradeTable(governorTable(all), "llvmpipe.json");
    EXPECT_EQ(table.renderer, "llvmpipe (LLVM)");
    ASSERT_EQ(table.views.size(), 1u);
    EXPECT_EQ(table.views[0], (ViewClass{12.0, 640.0 * 480.0, 8.0, 40.25, 0.85, 1}));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[1].plan, (Plan{TechniqueChoice::mipmap, 4, {}, {}}));
    EXPECT_DOUBLE_EQ(table.rows[1].entries[0].milliseconds, 20.0);
    EXPECT_DOUBLE_EQ(table.rows[1].entries[0].error, 1.0 - 0.95);
}

TEST(MeasurePicturesTest, Base64) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\xfe\x00\x80", 4)), "//4AgA==");
}

TEST(MeasurePicturesTest, ErrorColoursGetBrighterWithTheError) {
    Image errors(101, 1, 1);
    for (int x = 0; x <= 100; ++x) errors.at(x, 0) = 0.01f * static_cast<float>(x);
    const Image colours = errorColours(errors);
    const auto luminance = [&](int x) {
        return 0.2126f * colours.at(x, 0, 0) + 0.7152f * colours.at(x, 0, 1) + 0.0722f * colours.at(x, 0, 2);
    };
    for (int x = 1; x <= 100; ++x) EXPECT_GT(luminance(x), luminance(x - 1)) << x;
    EXPECT_NEAR(srgbFromLinear(colours.at(0, 0, 2)), 4.0f / 255.0f, 1e-5f);
    EXPECT_NEAR(srgbFromLinear(colours.at(100, 0, 0)), 252.0f / 255.0f, 1e-5f);
}

TEST(MeasurePicturesTest, SmallerKeepsTheMean) {
    Image image(40, 30);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 7) / 7.0f;
    const Image small = smaller(image, 10);
    ASSERT_EQ(small.width, 10);
    ASSERT_EQ(small.height, 8);
    const Image same = smaller(image, 100);
    EXPECT_EQ(same.pixels, image.pixels);
    Image flat(33, 17);
    for (float& x : flat.pixels) x = 0.25f;
    for (const float x : smaller(flat, 9).pixels) EXPECT_NEAR(x, 0.25f, 1e-6f);
}

TEST(MeasureContentTest, EveryChangeOfASceneIsAnotherContent) {
    Scene scene;
    scene.images.push_back({"wood", 1, 2, {1, 2, 3, 4, 5, 6, 7, 8}});
    scene.materials.emplace_back();
    Primitive triangle;
    triangle.vertices.resize(3);
    triangle.indices = {0, 1, 2};
    scene.meshes.push_back({"mesh", {triangle}});
    scene.instances.push_back({"one", 0, glm::mat4(1.0f)});
    scene.lights.emplace_back();
    std::vector<std::string> contents{contentOf(scene)};
    const auto changed = [&](auto change) {
        Scene other = scene;
        change(other);
        contents.push_back(contentOf(other));
    };
    changed([](Scene& s) { s.images[0].rgba[7] = 9; });
    changed([](Scene& s) { s.images[0].width = 2; });
    changed([](Scene& s) { s.materials[0].roughness = 0.5f; });
    changed([](Scene& s) { s.materials[0].doubleSided = true; });
    changed([](Scene& s) { s.materials[0].alphaMode = AlphaMode::blend; });
    changed([](Scene& s) { s.materials[0].occlusionStrength = 0.5f; });
    changed([](Scene& s) { s.materials[0].normalTexture.image = 0; });
    changed([](Scene& s) { s.materials[0].occlusionTexture.uvSet = 1; });
    changed([](Scene& s) { s.materials[0].baseColorTexture.imageFromVertex[2].x = 0.5f; });
    changed([](Scene& s) { s.meshes[0].primitives[0].vertices[2].uv.y = 1.0f; });
    changed([](Scene& s) { s.meshes[0].primitives[0].extras.resize(3); });
    changed([](Scene& s) { s.meshes[0].primitives[0].indices[0] = 1; });
    changed([](Scene& s) { s.meshes[0].primitives[0].topology = Topology::points; });
    changed([](Scene& s) { s.meshes[0].primitives[0].lit = false; });
    changed([](Scene& s) { s.instances[0].worldFromMesh[3].x = 1.0f; });
    changed([](Scene& s) { s.lights[0].range = 1.0f; });
    changed([](Scene& s) { s.lights.clear(); });
    for (std::size_t i = 0; i < contents.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(contents[i], contents[j]) << i << " " << j;
    Scene renamed = scene;
    renamed.name = "another";
    EXPECT_EQ(contentOf(renamed), contents[0]) << "a name changes no picture";
}

}  // namespace
}  // namespace dioptre
