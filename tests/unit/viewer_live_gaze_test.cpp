#include "viewer/live_gaze.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

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
    gaze.add("0.1,0.5,0.5,1" + std::string(5000, ' ') + "and more\n", 1.0);
    gaze.add(std::string("\0\xff\n", 3), 1.0);
    EXPECT_EQ(gaze.refused(), 11u);
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

TEST(LiveGazeTest, EnormousNumbersPassAndAreForgotten) {
    for (const char* line : {"1e308,0.5,0.5,1\n", "-1e308,0.5,0.5,1\n", "0.2,1e308,-1e308,1\n", "1e-320,0.5,0.5,1\n"}) {
        LiveGaze gaze;
        gaze.add("0,0.25,0.75,1\n", 1.0);
        gaze.add(line, 1.1);
        EXPECT_FALSE(std::isnan(gaze.at(1.1).position.x)) << line;
        // A restart is believed at once, a clock that only ran ahead within seconds.
        for (double t = 1.2; t < 6.0; t += 0.02) gaze.add(fmt::format("{},0.25,0.5,1\n", t), t);
        EXPECT_TRUE(gaze.at(6.0).valid) << line;
        EXPECT_EQ(gaze.at(6.0).position, glm::dvec2(0.25, 0.5)) << line;
    }
}

/// Samples at 100 Hz by a tracker whose clock says `clock(now)`: the share of them that count as fresh when they come.
template <class Clock>
double freshShare(double begin, double end, Clock clock) {
    LiveGaze gaze;
    int fresh = 0, all = 0;
    for (int i = 0; i * 0.01 < end; ++i) {
        const double now = i * 0.01;
        gaze.add(fmt::format("{},0.5,0.5,1\n", clock(now)), now);
        if (now < begin) continue;
        fresh += gaze.at(now).valid;
        ++all;
    }
    return static_cast<double>(fresh) / all;
}

// A crystal is off by up to 100 millionths; a tracker's clock that is off by a thousandth would be 0.6 s late in ten
// minutes.
TEST(LiveGazeTest, AClockThatRunsTooSlowlyOrTooFastIsFollowed) {
    for (const double rate : {0.999, 1.001, 1.02})
        EXPECT_EQ(freshShare(0.0, 600.0, [&](double now) { return 1e6 + rate * now; }), 1.0) << rate;
}

// Ahead by less than a restart: what comes next seems to be older, then late.
TEST(LiveGazeTest, AClockThatJumpsIsBelievedAgainWithinSeconds) {
    for (const double jump : {0.3, 0.9, 5.0, -0.3, -0.9, -5.0}) {
        const auto once = [&](double now) { return now + (now > 3.0 && now < 3.015 ? jump : 0.0); };
        const auto forGood = [&](double now) { return now + (now > 3.0 ? jump : 0.0); };
        EXPECT_EQ(freshShare(9.0, 20.0, once), 1.0) << jump;
        EXPECT_EQ(freshShare(9.0, 20.0, forGood), 1.0) << jump;
    }
}

/// A UDP socket of this machine, on a port that nobody had.
class Sender {
  public:
    Sender() : file_(::socket(AF_INET, SOCK_DGRAM, 0)) {
        address_.sin_family = AF_INET;
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address_;
        EXPECT_EQ(::bind(file_, reinterpret_cast<const sockaddr*>(&address_), size), 0);
        EXPECT_EQ(::getsockname(file_, reinterpret_cast<sockaddr*>(&address_), &size), 0);
    }
    ~Sender() { ::close(file_); }
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;

    int port() const { return ntohs(address_.sin_port); }
    void send(int port, std::string_view text) const {
        sockaddr_in to = address_;
        to.sin_port = htons(static_cast<std::uint16_t>(port));
        ::sendto(file_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    }

  private:
    int file_;
    sockaddr_in address_{};
};

int freePort() {
    return Sender().port();
}

TEST(GazeInputTest, DatagramsAreLinesWithOrWithoutAnEnd) {
    const int port = freePort();
    GazeInput input(fmt::format("udp:{}", port));
    const Sender sender;
    input.read(0.0);
    EXPECT_FALSE(input.gaze().at(0.0).valid);
    sender.send(port, "0.1,0.25,0.5,1");
    sender.send(port, "");
    sender.send(port, "half a li");
    sender.send(port, "0.2,0.5,0.75,1\n0.3,0.125,0.25,1\r\n");
    input.read(0.5);
    EXPECT_EQ(input.gaze().at(0.5).position, glm::dvec2(0.125, 0.25));
    EXPECT_TRUE(input.gaze().at(0.5).valid);
    EXPECT_EQ(input.gaze().refused(), 1u);
}

// What a socket holds is read in one go, so that the newest sample is never left for a later frame.
TEST(GazeInputTest, AFloodOfDatagramsLeavesNothingWaiting) {
    const int port = freePort();
    GazeInput input(fmt::format("udp:{}", port));
    const Sender sender;
    for (int frame = 0; frame < 3; ++frame) {
        for (int i = 0; i < 5000; ++i) sender.send(port, fmt::format("{},0.25,0.5,1", frame + i * 1e-4));
        input.read(frame);
        sender.send(port, fmt::format("{},0.75,0.5,1", frame + 0.9));
        input.read(frame + 0.9);
        EXPECT_EQ(input.gaze().at(frame + 0.9).position.x, 0.75) << frame;
    }
}

TEST(GazeInputTest, APortInUseIsRefused) {
    const Sender taken;
    try {
        GazeInput input(fmt::format("udp:{}", taken.port()));
        FAIL() << "the port was free";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(fmt::format("--gaze-input: UDP port {}: ", taken.port())));
    }
}

/// Standard input, for as long as it lives.
class Pipe {
  public:
    Pipe() {
        EXPECT_EQ(::pipe2(ends_, O_CLOEXEC | O_NONBLOCK), 0);
        ::dup2(ends_[0], STDIN_FILENO);
    }
    ~Pipe() {
        close();
        ::dup2(before_, STDIN_FILENO);
        ::close(before_);
        ::close(ends_[0]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    bool write(std::string_view text) const {
        return ::write(ends_[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
    void close() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

  private:
    int before_ = ::dup(STDIN_FILENO);
    int ends_[2] = {-1, -1};
};

TEST(GazeInputTest, StandardInputMayStopAndEnd) {
    Pipe pipe;
    GazeInput input("stdin");
    input.read(0.0);
    EXPECT_TRUE(pipe.write("0,0.25,0.5,1\n0.1,0.5,"));
    input.read(0.1);
    EXPECT_EQ(input.gaze().at(0.1).position.x, 0.25) << "half a line is none";
    EXPECT_TRUE(pipe.write("0.5,1\n"));
    input.read(0.2);
    EXPECT_EQ(input.gaze().at(0.2).position.x, 0.5);
    pipe.close();
    for (int i = 0; i < 3; ++i) input.read(0.3);
    EXPECT_TRUE(input.gaze().at(0.2).valid);
    EXPECT_FALSE(input.gaze().at(1.0).valid);
}

// As much as a pipe holds, all of it no sample but the last line.
TEST(GazeInputTest, AFloodOnStandardInputLeavesNothingWaiting) {
    Pipe pipe;
    GazeInput input("stdin");
    for (int frame = 0; frame < 3; ++frame) {
        while (pipe.write(std::string(4096 - 2, 'x') + "\n\n")) {
        }
        input.read(frame);
        EXPECT_TRUE(pipe.write(fmt::format("{},0.75,0.5,1\n", frame)));
        input.read(frame);
        EXPECT_TRUE(input.gaze().at(frame).valid) << frame;
    }
}

TEST(GazeInputTest, RefusesWhatIsNoSource) {
    for (const char* source : {"", "file", "udp:", "udp:0", "udp:65536", "udp:x"})
        EXPECT_THROW(GazeInput{source}, InputError) << source;
}

}  // namespace
}  // namespace dioptre
