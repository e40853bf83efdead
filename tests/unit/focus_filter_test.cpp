#include "focus/focus_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "csv_table.hpp"

namespace dioptre {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const char* const kPresets[] = {"natural", "snappy", "instant"};

FocusSample at(double time, double underGaze, double degrees = 0.0) {
    return {time, Dioptres(underGaze), {degrees, 0.0}, true, Dioptres(0.0)};
}
FocusSample blink(double time, double centre = 0.0) {
    return {time, std::nullopt, {0.0, 0.0}, false, Dioptres(centre)};
}

/// A gaze as a function of time, read at each frame of `hertz` from 0 to `end`; focus after each frame.
std::vector<double> run(FocusFilter& filter, const std::function<FocusSample(double)>& gaze, int hertz, double end) {
    std::vector<double> focus;
    const int frames = static_cast<int>(std::lround(end * hertz));
    for (int i = 0; i <= frames; ++i) {
        filter.sample(gaze(static_cast<double>(i) / hertz));
        focus.push_back(filter.focus().value);
    }
    return focus;
}

/// How often focus turns round by more than what nobody sees.
int turns(const std::vector<double>& focus) {
    int count = 0;
    double extreme = focus.front(), direction = 0.0;
    for (const double f : focus) {
        if ((f - extreme) * direction >= 0.0 && f != extreme) {
            if (direction == 0.0) direction = f > extreme ? 1.0 : -1.0;
            extreme = f;
        } else if (std::abs(f - extreme) > 0.02) {
            direction = -direction;
            extreme = f;
            ++count;
        }
    }
    return count;
}

TEST(FocusFilterTest, ComesToRest) {
    FocusFilter filter(focusPreset("natural"), Dioptres(3.0));
    filter.sample(at(1.0, 0.0));
    filter.advance(8.0);
    EXPECT_EQ(filter.focus().value, 0.0) << "or a view would never stand still";
}

TEST(FocusFilterTest, StepIsExactForAnyDivisionOfTime) {
    const CsvTable table = testTable("accommodation_step.csv");
    for (std::size_t row = 0; row < table.size(); ++row) {
        SCOPED_TRACE(table.describe(row));
        const Seconds elapsed(table.number(row, "t_since_onset_s")), tau(table.number(row, "tau_s"));
        const Dioptres from(table.number(row, "D0")), to(table.number(row, "D_target"));
        const double expected = table.number(row, "first_order_D");
        EXPECT_NEAR(focusStep(from, to, elapsed, tau).value, expected, 1e-14);
        Dioptres focus = from;
        for (int i = 0; i < 10; ++i) focus = focusStep(focus, to, elapsed / 10.0, tau);
        EXPECT_NEAR(focus.value, expected, 1e-13);
        // and through the filter, once the latency is over
        FocusDynamics dynamics = focusPreset("natural");
        dynamics.tauFarToNear = tau;
        FocusFilter filter(dynamics, from);
        filter.sample(at(1.0, to.value));
        filter.advance(1.0 + dynamics.latency.value + elapsed.value);
        // Nearer than 1e-4 D it is there.
        const bool there = std::abs(to.value - expected) < 1e-4;
        EXPECT_NEAR(filter.focus().value, there ? to.value : expected, 1e-12);
    }
    EXPECT_EQ(focusStep(Dioptres(1.0), Dioptres(2.0), Seconds(0.0), Seconds(0.0)).value, 2.0);
}

TEST(FocusFilterTest, PresetsSettleInTheirTime) {
    for (const char* name : kPresets) {
        for (const bool farToNear : {true, false}) {
            SCOPED_TRACE(::testing::Message() << name << " far to near " << farToNear);
            const FocusDynamics dynamics = focusPreset(name);
            const double from = farToNear ? 0.5 : 3.0, to = farToNear ? 3.0 : 0.5;
            FocusFilter filter(dynamics);
            filter.jump(0.0, Dioptres(from));
            // the gaze jumps by 10 degrees at t = 1
            const auto gaze = [&](double t) { return at(t, t < 1.0 ? from : to, t < 1.0 ? 0.0 : 10.0); };
            const double settle = settleTime(dynamics, farToNear).value;
            double settled = -1.0;
            constexpr int kHertz = 1000;
            for (int i = 0; i <= 3 * kHertz; ++i) {
                const double t = static_cast<double>(i) / kHertz;
                filter.sample(gaze(t));
                const bool there = std::abs(filter.focus().value - to) <= 0.05 * std::abs(to - from);
                if (there && settled < 0.0) settled = t - 1.0;
            }
            EXPECT_NEAR(settled, settle, 0.05 * settle + 1.0 / kHertz);
        }
    }
    EXPECT_EQ(settleTime(focusPreset("instant"), true).value, 0.0);
    EXPECT_THROW(focusPreset("lazy"), InputError);
}

TEST(FocusFilterTest, SnappyIsAQuarterOfNatural) {
    const FocusDynamics natural = focusPreset("natural"), snappy = focusPreset("snappy");
    EXPECT_DOUBLE_EQ(snappy.latency.value, natural.latency.value / 4.0);
    EXPECT_DOUBLE_EQ(settleTime(snappy, true).value, settleTime(natural, true).value / 4.0);
    EXPECT_NE(natural.tauFarToNear, natural.tauNearToFar);
}

// The same timed samples, advanced between them on frames of 30, 72 and 120 Hz.
TEST(FocusFilterTest, AdvancingAtAnyRateGivesTheSameFocus) {
    const std::vector<FocusSample> samples = {at(0.013, 0.5),     at(0.1, 2.0, 9.0), at(0.16, 2.1, 9.1),
                                              at(0.7, 2.0, 9.0),  blink(0.9),        at(1.05, 0.3, 20.0),
                                              at(1.9, 0.3, 20.0), at(2.0, 4.0, 2.0), at(2.05, 4.0, 2.0)};
    for (const char* name : kPresets) {
        std::vector<std::vector<double>> probes;
        for (const int hertz : {1, 30, 72, 120, 997}) {
            FocusFilter filter(focusPreset(name), Dioptres(1.0));
            std::vector<double> probe;
            std::size_t next = 0;
            for (int i = 0; i <= 40 * hertz; ++i) {
                const double frame = static_cast<double>(i) / hertz;
                for (; next < samples.size() && samples[next].time <= frame; ++next) filter.sample(samples[next]);
                filter.advance(frame);
                if (i % hertz == 0) probe.push_back(filter.focus().value);  // every whole second, drift included
            }
            probes.push_back(probe);
        }
        for (const auto& probe : probes)
            for (std::size_t i = 0; i < probe.size(); ++i)
                EXPECT_NEAR(probe[i], probes[0][i], 1e-9) << name << " at " << i << " s";
    }
}

// The gaze itself read at 30, 72 and 120 Hz; it changes at moments that are frames of all three. That a saccade has
// landed is known a few samples later, differently many at each rate: the latency counts from the landing all the same.
TEST(FocusFilterTest, ReadingTheGazeAtAnyRateGivesTheSameFocus) {
    const auto gaze = [](double t) {
        if (t < 0.5) return at(t, 0.5, 0.0);
        if (t < 1.5) return at(t, 3.0, 10.0);
        if (t < 1.75 - 1e-9) return blink(t);
        if (t < 3.0) return at(t, 3.0, 10.0);
        if (t < 4.0) return at(t, 1.0, 10.0);  // the thing moves away under a resting gaze
        return at(t, 2.0, 25.0);
    };
    for (const char* name : kPresets) {
        std::vector<double> at30, at72, at120;
        for (auto& [hertz, out] : {std::pair<int, std::vector<double>&>{30, at30}, {72, at72}, {120, at120}}) {
            FocusFilter filter(focusPreset(name), Dioptres(0.5));
            const auto focus = run(filter, gaze, hertz, 6.0);
            for (std::size_t i = 0; i < focus.size(); i += static_cast<std::size_t>(hertz) / 6) out.push_back(focus[i]);
        }
        ASSERT_EQ(at30.size(), at72.size());
        ASSERT_EQ(at30.size(), at120.size());
        for (std::size_t i = 0; i < at30.size(); ++i) {
            EXPECT_NEAR(at72[i], at30[i], 1e-6) << name << " at " << static_cast<double>(i) / 6.0;
            EXPECT_NEAR(at120[i], at30[i], 1e-6) << name << " at " << static_cast<double>(i) / 6.0;
        }
        EXPECT_NEAR(at30.back(), 2.0, 0.01);
    }
}

TEST(FocusFilterTest, ScriptedGazeDoesNotOscillate) {
    for (const char* name : {"natural", "snappy"}) {
        for (const int hertz : {30, 72, 120}) {
            SCOPED_TRACE(::testing::Message() << name << " at " << hertz << " Hz");
            std::mt19937 random(7);
            std::uniform_real_distribution<double> half(-0.5, 0.5);
            // A depth edge at 0 degrees: 3 D to its left, 0.5 D to its right. The gaze rests left, crosses it slowly,
            // rests right with a blink, jitters by 0.5 degrees on the edge itself, then jumps 10 degrees to the left.
            const auto gaze = [&](double t) {
                double x = -5.0;
                if (t >= 1.0) x = std::min(4.0, -5.0 + (t - 1.0) * 20.0);
                if (t >= 3.0) x = 0.3;
                if (t >= 6.0) x = -10.0;
                x += half(random);
                FocusSample sample = at(t, x < 0.0 ? 3.0 : 0.5, x);
                sample.valid = !(t > 2.2 && t < 2.4);
                return sample;
            };
            FocusFilter filter(focusPreset(name), Dioptres(3.0));
            const auto focus = run(filter, gaze, hertz, 9.0);
            EXPECT_EQ(turns(focus), 1);  // away once, back once
            const auto frame = [&](double t) { return focus[static_cast<std::size_t>(std::lround(t * hertz))]; };
            EXPECT_NEAR(frame(1.0), 3.0, 1e-9);
            EXPECT_NEAR(frame(3.0), 0.5, 0.05);
            EXPECT_NEAR(frame(5.9), 0.5, 0.05);  // jitter on the edge has not moved it
            EXPECT_NEAR(frame(9.0), 3.0, 0.01);
        }
    }
}

TEST(FocusFilterTest, JitterAcrossAnEdgeIsNotFollowed) {
    for (const char* name : {"natural", "snappy"}) {
        for (const int hertz : {30, 72, 120}) {
            FocusFilter filter(focusPreset(name), Dioptres(3.0));
            const auto gaze = [](double t) {  // 0.5 degrees to either side, 3 times a second
                const bool left = std::fmod(t * 3.0 + 1e-6, 1.0) < 0.5;
                return at(t, left ? 3.0 : 0.5, left ? -0.5 : 0.5);
            };
            filter.jump(0.0, Dioptres(3.0));
            for (const double focus : run(filter, gaze, hertz, 10.0))
                ASSERT_EQ(focus, 3.0) << name << " at " << hertz << " Hz";
        }
    }
}

TEST(FocusFilterTest, HoldsThroughBlinksAndSaccades) {
    FocusFilter filter(focusPreset("natural"));
    filter.jump(0.0, Dioptres(2.0));
    filter.sample(at(0.1, 2.0));
    EXPECT_EQ(filter.state(), FocusState::deadZone);
    filter.sample(blink(0.2));
    EXPECT_EQ(filter.state(), FocusState::invalid);
    filter.sample({0.3, Dioptres(kNan), {0.0, 0.0}, true, Dioptres(0.0)});
    filter.sample({0.4, Dioptres(5.0), {kNan, 0.0}, true, Dioptres(kNan)});
    filter.sample({0.5, std::nullopt, {0.0, 0.0}, true, Dioptres(0.0)});
    EXPECT_EQ(filter.state(), FocusState::invalid);
    for (int i = 0; i < 100; ++i) {  // 200 deg/s over whatever lies there
        const double t = 0.6 + i / 100.0;
        filter.sample(at(t, i % 2 ? 0.0 : 6.0, t * 200.0));
        if (i > 3) {
            EXPECT_EQ(filter.state(), FocusState::saccade) << i;
        }
    }
    EXPECT_EQ(filter.focus().value, 2.0);
    EXPECT_EQ(filter.target().value, 2.0);
}

TEST(FocusFilterTest, DeadZoneIsNotFollowed) {
    FocusFilter filter(focusPreset("natural"));
    filter.jump(0.0, Dioptres(2.0));
    for (int i = 1; i < 300; ++i) filter.sample(at(i / 30.0, i % 2 ? 2.24 : 1.76));
    EXPECT_EQ(filter.focus().value, 2.0);
    for (int i = 300; i < 600; ++i) filter.sample(at(i / 30.0, 2.26));
    EXPECT_NEAR(filter.focus().value, 2.26, 1e-6);
}

TEST(FocusFilterTest, FollowsAThingThatApproaches) {
    FocusFilter filter(focusPreset("natural"), Dioptres(0.5));
    double worst = 0.0;
    for (int i = 0; i < 600; ++i) {
        const double t = i / 60.0, depth = 0.5 + 0.5 * std::max(0.0, t - 1.0);
        filter.sample(at(t, depth));
        worst = std::max(worst, std::abs(filter.focus().value - depth));
    }
    EXPECT_LT(worst, 0.75);  // dead zone, latency and time constant at 0.5 D/s
}

TEST(FocusFilterTest, StatesInOrder) {
    FocusFilter filter(focusPreset("natural"), Dioptres(0.5));
    filter.jump(0.0, Dioptres(0.5));
    for (int i = 0; i <= 10; ++i) filter.sample(at(i / 100.0, 0.5));
    EXPECT_EQ(filter.state(), FocusState::deadZone);
    filter.sample(at(0.11, 3.0, 12.0));
    EXPECT_EQ(filter.state(), FocusState::saccade);
    for (int i = 12; i <= 16; ++i) filter.sample(at(i / 100.0, 3.0, 12.0));
    EXPECT_EQ(filter.state(), FocusState::waiting);
    filter.advance(0.11 + 0.349);
    EXPECT_EQ(filter.focus().value, 0.5);
    filter.advance(0.11 + 0.351);  // the latency runs from the landing
    EXPECT_EQ(filter.state(), FocusState::tracking);
    EXPECT_GT(filter.focus().value, 0.5);
    filter.advance(3.0);
    EXPECT_EQ(filter.state(), FocusState::deadZone);
    EXPECT_NEAR(filter.focus().value, 3.0, 1e-3);
}

TEST(FocusFilterTest, DriftsToTheCentreAfterThirtySeconds) {
    FocusFilter filter(focusPreset("natural"));
    filter.jump(0.0, Dioptres(3.0));
    filter.sample(at(1.0, 3.0));
    for (int i = 0; i < 290; ++i) filter.sample(blink(1.5 + i / 10.0, 1.0));
    EXPECT_EQ(filter.focus().value, 3.0);
    filter.advance(30.99);
    EXPECT_EQ(filter.focus().value, 3.0);
    filter.advance(31.5);
    EXPECT_EQ(filter.state(), FocusState::drifting);
    EXPECT_NEAR(filter.focus().value, 1.0 + 2.0 * std::exp(-0.5 / 0.2), 1e-9);  // from 31 s on, whenever asked
    filter.sample(blink(40.0, 2.0));  // the centre changes: it goes on following
    filter.advance(45.0);
    EXPECT_NEAR(filter.focus().value, 2.0, 1e-6);
    for (int i = 0; i < 30; ++i) filter.sample(at(46.0 + i / 10.0, 5.0));  // the tracker is back
    EXPECT_NEAR(filter.focus().value, 5.0, 0.01);
}

TEST(FocusFilterTest, JumpIsAtOnce) {
    FocusFilter filter(focusPreset("natural"));
    filter.sample(at(0.0, 4.0));
    filter.jump(0.1, Dioptres(1.0));
    EXPECT_EQ(filter.focus().value, 1.0);
    filter.advance(5.0);  // what was waiting is forgotten
    EXPECT_EQ(filter.focus().value, 1.0);
    filter.jump(kNan, Dioptres(kNan));
    EXPECT_EQ(filter.focus().value, 1.0);
}

TEST(FocusFilterTest, InstantFollowsEverySample) {
    FocusFilter filter(focusPreset("instant"));
    for (int i = 0; i < 50; ++i) {
        const double depth = i % 7;
        filter.sample(at(i / 30.0, depth, 10.0 * i));
        EXPECT_EQ(filter.focus().value, depth);
    }
    filter.sample(blink(3.0));
    EXPECT_EQ(filter.focus().value, 0.0);
}

TEST(FocusFilterTest, TimeThatGoesBackOrIsNoneHarmsNothing) {
    FocusFilter filter(focusPreset("natural"), Dioptres(1.0));
    filter.advance(kNan);
    filter.sample(at(kNan, 5.0));
    filter.sample(at(std::numeric_limits<double>::infinity(), 5.0));
    EXPECT_EQ(filter.focus().value, 1.0);
    for (int i = 0; i < 200; ++i) filter.sample(at(100.0 + i / 60.0, 3.0));
    const double settled = filter.focus().value;
    filter.advance(103.0);  // a little back
    filter.sample(at(103.1, 3.0));
    EXPECT_NEAR(filter.focus().value, settled, 1e-4);
    for (int i = 0; i < 200; ++i) filter.sample(at(i / 60.0, 1.0));  // the trace begins again
    EXPECT_NEAR(filter.focus().value, 1.0, 0.001);
    filter.advance(1e300);
    EXPECT_TRUE(std::isfinite(filter.focus().value));
    filter.sample(at(1e300, 2.0));
    EXPECT_TRUE(std::isfinite(filter.focus().value));
    for (int i = 0; i < 100000; ++i) filter.sample(at(1e300, 2.0, i % 3));  // a clock that stands still
}

TEST(FocusFilterTest, BadDynamicsAreRefused) {
    const auto refuses = [](auto change) {
        FocusDynamics dynamics = focusPreset("natural");
        change(dynamics);
        EXPECT_THROW(FocusFilter{dynamics}, InputError);
    };
    refuses([](auto& d) { d.latency = Seconds(-0.1); });
    refuses([](auto& d) { d.tauFarToNear = Seconds(kNan); });
    refuses([](auto& d) { d.tauNearToFar = Seconds(std::numeric_limits<double>::infinity()); });
    refuses([](auto& d) { d.deadZone = Dioptres(-1.0); });
    refuses([](auto& d) { d.saccadeDegreesPerSecond = 0.0; });
    refuses([](auto& d) { d.driftAfter = Seconds(0.0); });
}

}  // namespace
}  // namespace dioptre
