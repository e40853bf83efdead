#include "focus/traces.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <fstream>
#include <string>

#include "core/error.hpp"

namespace dioptre {
namespace {

class TraceFile {
  public:
    explicit TraceFile(const std::string& text)
        : path_(std::filesystem::temp_directory_path() / ("dioptre_trace_" + std::to_string(getpid()) + ".csv")) {
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TraceFile() { std::filesystem::remove(path_); }
    TraceFile(const TraceFile&) = delete;
    TraceFile& operator=(const TraceFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

template <class Read>
std::string errorOf(Read read, const std::string& text) {
    const TraceFile file(text);
    try {
        read(file.path());
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find(file.path().string() + ":"), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message.substr(file.path().string().size() + 1);
    }
    return "accepted";
}

TEST(TracesTest, ThoseForAnySceneBeginWhereTheViewDoes) {
    const auto traces = std::filesystem::path(DIOPTRE_CONFIG).parent_path() / "assets/traces";
    for (const std::string name : {"seated", "walk", "reading", "sweep", "dropouts"}) {
        const auto head = readHeadTrace(traces / (name + ".head.csv"));
        const auto gaze = readGazeTrace(traces / (name + ".gaze.csv"));
        EXPECT_EQ(head.front().pose.position, glm::dvec3(0.0)) << name;
        EXPECT_EQ(head.front().pose.orientation.w, 1.0) << name;
        EXPECT_EQ(head.front().time, 0.0) << name;
        EXPECT_EQ(gaze.front().time, 0.0) << name;
        EXPECT_EQ(head.back().time, gaze.back().time) << name;
        std::size_t lost = 0, outside = 0;
        for (const GazeSample& sample : gaze) {
            if (!sample.valid) ++lost;
            const glm::dvec2 p = sample.position;
            if (p.x < 0.0 || p.x > 1.0 || p.y < 0.0 || p.y > 1.0) ++outside;
        }
        EXPECT_EQ(lost > gaze.size() / 3, name == "dropouts") << name << ": " << lost << " of " << gaze.size();
        EXPECT_EQ(outside, 0u) << name;
    }
}

TEST(TracesTest, ReadsGaze) {
    const TraceFile file("t_s,x,y,valid\n0,0.25,0.75,1\n0.5,nan,nan,0\n0.5, 1.5 ,-0.5,1\n");
    const auto trace = readGazeTrace(file.path());
    ASSERT_EQ(trace.size(), 3u);
    EXPECT_EQ(trace[0].position, glm::dvec2(0.25, 0.75));
    EXPECT_TRUE(trace[0].valid);
    EXPECT_FALSE(trace[1].valid);
    EXPECT_EQ(trace[1].position, glm::dvec2(0.5, 0.5));
    EXPECT_EQ(trace[2].position, glm::dvec2(1.5, -0.5));
}

TEST(TracesTest, WhatIsWrittenReadsBackToTheSameBits) {
    const std::vector<GazeSample> gaze = {{-0.5, {0.1, 1.0 / 3.0}, true}, {1e6 / 7.0, {1.5, -0.5}, false}};
    const TraceFile gazeFile(gazeTraceCsv(gaze));
    const auto gazeAgain = readGazeTrace(gazeFile.path());
    ASSERT_EQ(gazeAgain.size(), gaze.size());
    for (std::size_t i = 0; i < gaze.size(); ++i) {
        EXPECT_EQ(gazeAgain[i].time, gaze[i].time);
        EXPECT_EQ(gazeAgain[i].position, gaze[i].position);
        EXPECT_EQ(gazeAgain[i].valid, gaze[i].valid);
    }
    const std::vector<HeadSample> head = {{0.25, {{1.0 / 3.0, -2.0, 3e-9}, {0.5, -0.5, 0.5, 0.5}}}};
    const TraceFile headFile(headTraceCsv(head));
    const auto headAgain = readHeadTrace(headFile.path());
    ASSERT_EQ(headAgain.size(), 1u);
    EXPECT_EQ(headAgain[0].time, head[0].time);
    EXPECT_EQ(headAgain[0].pose, head[0].pose);
}

TEST(TracesTest, WindowsLineEndsBlankLinesCommentsAndByteOrderMark) {
    const TraceFile file("\xEF\xBB\xBF# recorded\r\nt_s,x,y,valid\r\n\r\n  0 , +0.25,1e-1,1\r\n\r\n1,0,0,0");
    const auto trace = readGazeTrace(file.path());
    ASSERT_EQ(trace.size(), 2u);
    EXPECT_EQ(trace[0].position, glm::dvec2(0.25, 0.1));
}

TEST(TracesTest, LocaleDoesNotMatter) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it exists: a comma as decimal point
    const TraceFile file("t_s,x,y,valid\n0.5,0.25,0.75,1\n");
    EXPECT_EQ(readGazeTrace(file.path())[0].time, 0.5);
    std::setlocale(LC_ALL, before.c_str());
}

TEST(TracesTest, ReadsHeadAndNormalises) {
    const TraceFile file(
        "t_s,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,4\n1,1,2,3,0,1e-200,0,1e-200\n2,0,0,0,1e300,0,0,1e300\n");
    const auto trace = readHeadTrace(file.path());
    ASSERT_EQ(trace.size(), 3u);
    EXPECT_EQ(trace[0].pose.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(trace[0].pose.orientation.w, 1.0);
    for (const auto& sample : trace) EXPECT_NEAR(glm::length(sample.pose.orientation), 1.0, 1e-15);
    EXPECT_NEAR(trace[1].pose.orientation.y, std::sqrt(0.5), 1e-15);
}

struct BadTrace {
    std::string text;
    std::string mustName;
};

TEST(TracesTest, ErrorsNameLineColumnAndValue) {
    const std::string gazeHeader = "t_s,x,y,valid\n";
    for (const BadTrace& bad : std::initializer_list<BadTrace>{
             {"", "header t_s,x,y,valid"},
             {"\n\n", "header"},
             {"t,x,y,valid\n0,0,0,1\n", "1: header"},
             {gazeHeader, "no sample"},
             {gazeHeader + "0,0,0\n", "2: 3 columns, must be 4"},
             {gazeHeader + "0,0,0,1,5\n", "2: 5 columns"},
             {gazeHeader + "0,0,0,1\n\n1,0.5,abc,1\n", "4: column 3 (y): 'abc'"},
             {gazeHeader + "0,,0,1\n", "column 2 (x): ''"},
             {gazeHeader + "0,0.5x,0,1\n", "'0.5x'"},
             {gazeHeader + "0,0,0,2\n", "column 4 (valid): '2', must be 0 or 1"},
             {gazeHeader + "nan,0,0,1\n", "column 1 (t_s)"},
             {gazeHeader + "inf,0,0,1\n", "column 1 (t_s)"},
             {gazeHeader + "0,nan,0,1\n", "column 2 (x)"},
             {gazeHeader + "0,inf,0,0\n", "column 2 (x)"},
             {gazeHeader + "1,0,0,1\n0.5,0,0,1\n", "3: column 1 (t_s): '0.5', must not be before 1"},
         }) {
        SCOPED_TRACE(bad.text);
        const std::string message = errorOf(readGazeTrace, bad.text);
        EXPECT_NE(message.find(bad.mustName), std::string::npos) << message;
    }
    const std::string headHeader = "t_s,x,y,z,qx,qy,qz,qw\n";
    for (const BadTrace& bad : std::initializer_list<BadTrace>{
             {headHeader + "0,0,0,0,0,0,0,0\n", "2: quaternion"},
             {headHeader + "0,0,0,nan,0,0,0,1\n", "column 4 (z)"},
             {headHeader + "0,0,0,0,0,0,0,1e999\n", "column 8 (qw)"},
             {gazeHeader + "0,0,0,1\n", "columns, must be 8"},
         }) {
        SCOPED_TRACE(bad.text);
        const std::string message = errorOf(readHeadTrace, bad.text);
        EXPECT_NE(message.find(bad.mustName), std::string::npos) << message;
    }
    EXPECT_THROW(readGazeTrace("/nowhere/gaze.csv"), InputError);
}

TEST(TracesTest, GazeIsTheLatestSample) {
    const std::vector<GazeSample> trace = {{1.0, {0.1, 0.1}, true}, {2.0, {0.2, 0.2}, false}, {2.0, {0.3, 0.3}, true}};
    EXPECT_FALSE(gazeAt(trace, 0.99).valid);
    EXPECT_EQ(gazeAt(trace, 1.0).position.x, 0.1);
    EXPECT_EQ(gazeAt(trace, 1.99).position.x, 0.1);
    EXPECT_EQ(gazeAt(trace, 2.0).position.x, 0.3);
    EXPECT_EQ(gazeAt(trace, 99.0).position.x, 0.3);
    EXPECT_FALSE(gazeAt({}, 0.0).valid);
    EXPECT_FALSE(gazeAt(trace, std::nan("")).valid);
}

TEST(TracesTest, HeadIsInterpolated) {
    const glm::dquat quarter = glm::angleAxis(std::acos(0.0), glm::dvec3(0, 1, 0));
    const std::vector<HeadSample> trace = {
        {0.0, {{0, 0, 0}, {1, 0, 0, 0}}}, {1.0, {{2, 0, 0}, -quarter}}, {1.0, {{5, 0, 0}, quarter}}};
    const Pose half = headPoseAt(trace, 0.5);
    EXPECT_NEAR(half.position.x, 1.0, 1e-15);
    // the short way, though the quaternion's sign is the other one
    const glm::dvec3 ahead = half.orientation * glm::dvec3(0, 0, -1);
    EXPECT_NEAR(ahead.x, -std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(ahead.z, -std::sqrt(0.5), 1e-12);
    EXPECT_EQ(headPoseAt(trace, -1.0).position.x, 0.0);
    EXPECT_EQ(headPoseAt(trace, 1.0).position.x, 5.0);
    EXPECT_EQ(headPoseAt(trace, 7.0).position.x, 5.0);
    EXPECT_EQ(headPoseAt({}, 0.0).orientation.w, 1.0);
}

}  // namespace
}  // namespace dioptre
