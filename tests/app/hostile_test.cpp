// Damaged scenes given to the program: each ends in a picture or in one line and exit code 2, soon and in little memory.
#include "core/image.hpp"
#include "hostile_scenes.hpp"
#include "program.hpp"

namespace dioptre::test {
namespace {

constexpr int kParts = 4;  // run side by side
constexpr std::size_t kPerPart = 60;
constexpr double kMostSeconds = 2.0;
[[maybe_unused]] constexpr long kMostKilobytes = 512 * 1024;

class HostileTest : public ProgramTest, public testing::WithParamInterface<int> {};

TEST_P(HostileTest, DamagedScenesEndInAPictureOrALine) {
    const std::vector<NamedFile> files = damagedFiles();
    const std::size_t count = kPerPart * kParts;
    std::size_t drawn = 0;
    for (auto i = static_cast<std::size_t>(GetParam()); i < count; i += kParts) {
        const NamedFile& file = files[i * files.size() / count];
        SCOPED_TRACE(file.name);
        write("damaged.gltf", file.bytes);
        const Outcome outcome =
            run({"render", "damaged.gltf", "--size", "40x30", "--technique", "mipmap", "--out", "x.pfm"});
        // The processor's time: the machine may be busy.
        EXPECT_LT(outcome.seconds, kMostSeconds);
#ifndef DIOPTRE_SANITIZED  // which take memory of their own
        EXPECT_LT(outcome.kilobytes, kMostKilobytes);
#endif
        if (outcome.status != 0) {
            expectRefused(outcome, {"damaged.gltf: "});
            EXPECT_FALSE(there("x.pfm"));
            continue;
        }
        ++drawn;
        // Reading it refuses what is not finite.
        EXPECT_NO_THROW(readImage(folder / "x.pfm"));
        std::filesystem::remove(folder / "x.pfm");
    }
    EXPECT_GT(drawn, 0u);
    EXPECT_LT(drawn, 2 * kPerPart / 3) << "a third and more is damaged so that it must be refused";
}

INSTANTIATE_TEST_SUITE_P(Parts, HostileTest, testing::Range(0, kParts));

}  // namespace
}  // namespace dioptre::test
