#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "quality/plan.hpp"

namespace dioptre {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(PlanTest, ReadsAsText) {
    EXPECT_EQ(planText({TechniqueChoice::mipmap, 4, {}, {}}), "mipmap, msaa 4");
    EXPECT_EQ(planText({TechniqueChoice::accumulate, {}, 32, 4}), "accumulate, 32 samples, 4 sub-samples each");
    EXPECT_EQ(planText({TechniqueChoice::reference, {}, 512, {}}), "reference, 512 samples");
    EXPECT_EQ(planText({TechniqueChoice::pinhole, 0, {}, {}, 6}), "pinhole, msaa 0, 6/8 size");
}

TEST(PlanTest, HasTheDialsOfItsTechnique) {
    RenderSettings settings;
    settings.msaa = 0;
    settings.technique = TechniqueChoice::mipmap;
    EXPECT_THAT(planOf(settings)->dials(), ElementsAre(Pair("msaa", 0)));
    settings.technique = TechniqueChoice::accumulate;
    settings.subsamples = 8;
    EXPECT_THAT(planOf(settings)->dials(), ElementsAre(Pair("samples", 32), Pair("subsamples", 8)));
    settings.technique = TechniqueChoice::reference;
    EXPECT_THAT(planOf(settings)->dials(), ElementsAre(Pair("samples", 512)));
    settings.samples = 7;
    EXPECT_THAT(planOf(settings)->dials(), ElementsAre(Pair("samples", 7)));
}

TEST(PlanTest, WhereNobodyNamesATechniqueOnlyAStageToBeShownDoes) {
    RenderSettings settings;
    EXPECT_FALSE(planOf(settings).has_value());
    settings.show.stage = ShowChoice::dob;
    EXPECT_EQ(planOf(settings)->technique, TechniqueChoice::mipmap);
    settings.show.stage = ShowChoice::lod;
    EXPECT_EQ(planOf(settings)->technique, TechniqueChoice::accumulate);
}

TEST(PlanTest, AMethodIsAPlanWithoutItsSamples) {
    const Plan few{TechniqueChoice::accumulate, {}, 8, 4}, many{TechniqueChoice::accumulate, {}, 64, 4};
    EXPECT_EQ(methodOf(few), methodOf(many));
    EXPECT_NE(methodOf(few), methodOf({TechniqueChoice::accumulate, {}, 8, 8}));
    EXPECT_NE(methodOf({TechniqueChoice::mipmap, 0, {}, {}}), methodOf({TechniqueChoice::mipmap, 0, {}, {}, 6}));
}

TEST(PlanTest, NamesReadBack) {
    for (const auto choice :
         {TechniqueChoice::pinhole, TechniqueChoice::mipmap, TechniqueChoice::accumulate, TechniqueChoice::reference})
        EXPECT_EQ(techniqueNamed(techniqueName(choice)), choice);
    EXPECT_EQ(techniqueNamed("Mipmap"), std::nullopt);
}

}  // namespace
}  // namespace dioptre
