#include "viewer/live_gaze.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace dioptre {
namespace {

TEST(LiveGazeTest, TakesLinesHoweverTheyAreCut) {
    const std::string text = "t_s,x,y,valid\n0,0.25,0.75,1\r\n# a remark\n\n0.1,0.5,0.125,1\n";
    for (std::size_t cut = 1; cut < 9; ++cut) {
        LiveGaze gaze;
        for (std::size_t i = 0; i < text.size(); i += cut) gaze.add(text.substr(i, cut), 5.0);
        EXPECT_TRUE(gaze.at(5.0).valid);
        EXPECT_EQ(gaze.at(5.0).position, glm::dvec2(0.5, 0.125));
        EXPECT_EQ(gaze.refused(), 1u) << "the header";
    }
}

TEST(LiveGazeTest, WhatIsNoSampleHarmsNothing) {
    LiveGaze gaze;
    gaze.add("0,0.25,0.75,1\n", 1.0);
    for (const char* line : {"nonsense\n", "1,2,3\n", "1,2,3,4,5\n", "0.1,nan,0.5,1\n", "inf,0.5,0.5,1\n",
                             "0.1,0.5,0.5,2\n", ",,,\n", "0.1,0.5,0.5,\n"})
        gaze.add(line, 1.0);
    gaze.add(std::string(100000, '1') + "\n", 1.0);
    EXPECT_EQ(gaze.refused(), 9u);
    EXPECT_EQ(gaze.at(1.0).position, glm::dvec2(0.25, 0.75));
    gaze.add("0.1,nan,nan,0\n", 1.1);
    EXPECT_FALSE(gaze.at(1.1).valid);
}

TEST(LiveGazeTest, ADropoutIsNotValid) {
    LiveGaze gaze;
    EXPECT_FALSE(gaze.at(0.0).valid) << "nothing came yet";
    gaze.add("100,0.25,0.75,1\n", 7.0);
    EXPECT_TRUE(gaze.at(7.0 + 0.5 * LiveGaze::kDropout).valid);
    EXPECT_FALSE(gaze.at(7.0 + 2.0 * LiveGaze::kDropout).valid);
    EXPECT_TRUE(gaze.alive(7.5));
    EXPECT_FALSE(gaze.alive(8.5));
    // A sample that took long to come is as old as it is.
    gaze.add("101,0.5,0.5,1\n", 8.0 + 2.0 * LiveGaze::kDropout);
    EXPECT_FALSE(gaze.at(8.0 + 2.0 * LiveGaze::kDropout).valid);
}

TEST(LiveGazeTest, DisorderIsPassedOverAndARestartIsFollowed) {
    LiveGaze gaze;
    gaze.add("10,0.1,0.1,1\n9.9,0.2,0.2,1\n", 0.0);
    EXPECT_EQ(gaze.at(0.0).position, glm::dvec2(0.1, 0.1));
    gaze.add("0,0.3,0.3,1\n", 1.0);
    EXPECT_EQ(gaze.at(1.0).position, glm::dvec2(0.3, 0.3));
    EXPECT_TRUE(gaze.at(1.0).valid);
}

TEST(GazeInputTest, RefusesWhatIsNoSource) {
    for (const char* source : {"", "file", "udp:", "udp:0", "udp:65536", "udp:x"})
        EXPECT_THROW(GazeInput{source}, InputError) << source;
}

}  // namespace
}  // namespace dioptre
