// What 32-bit floats cost: circle of confusion, projection, focus filter and accumulation as the program computes them,
// and as they might have been, against double precision. docs/numerics.md quotes the tables.
//
//   bench_numerics
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "focus/focus_filter.hpp"
#include "optics/lens.hpp"
#include "optics/lens_samples.hpp"
#include "optics/view.hpp"

namespace dioptre {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void print(const std::string& line) {
    std::fputs((line + "\n").c_str(), stdout);
}

/// A headset's eye: 1832 px over 90 degrees.
View headsetView(double near) {
    View view;
    view.frustum = symmetricFrustum(Radians(std::numbers::pi / 2.0), 1.0);
    view.near = Metres(near);
    view.width = view.height = 1832;
    return view;
}

// c = E |V - Vf| / V with image distances V = F d / (d - F), in 32-bit floats: the form that papers print.
float cocByImageDistances(float radius, float F, float d, float df, float fpx) {
    const float V = std::isinf(d) ? F : F * d / (d - F), Vf = std::isinf(df) ? F : F * df / (df - F);
    return radius * (V - Vf) / V / Vf * fpx;
}

void coc() {
    print("## Circle of confusion\n");
    print("Largest error of its radius, px, over focus at 17.67 mm ... infinity. f 916 px, F 16.67 mm.\n");
    print("| aperture, mm | near plane, m | objects | as computed | by image distances |\n|---|---|---|---|---|");
    const double focuses[] = {0.01767, 0.05, 0.1, 0.3, 1.0, 7.0, 100.0, 1e4, kInfinity};
    for (const double diameter : {0.004, 0.2})
        for (const double near : {1e-4, 0.05}) {
            const View view = headsetView(near);
            const double f = focalLengthPixels(view).x;
            const auto worst = [&](auto objects) {
                double computed = 0.0, printed = 0.0;
                for (const double focus : focuses) {
                    const Lens lens{Metres(0.5 * diameter), Metres(0.01667), Dioptres(1.0 / focus)};
                    const CocTransform transform = cocFromDepth(lens, f, view.near);
                    for (const double d : objects(focus)) {
                        if (!(d > near)) continue;
                        const double exact = cocRadiusPixels(lens, f, Dioptres(1.0 / d));
                        const float drawn = transform.radius(static_cast<float>(near / d));
                        const float other =
                            cocByImageDistances(static_cast<float>(0.5 * diameter), 0.01667f, static_cast<float>(d),
                                                static_cast<float>(focus), static_cast<float>(f));
                        computed = std::max(computed, std::abs(drawn - exact));
                        // Its sign is the other way round.
                        printed = std::max(printed, std::abs(std::abs(static_cast<double>(other)) - std::abs(exact)));
                    }
                }
                return fmt::format("{:.1e} | {:.1e}", computed, printed);
            };
            const std::string first = fmt::format("| {:g} | {:g} |", diameter * 1e3, near);
            print(fmt::format("{} near plane + 1 % | {} |", first,
                              worst([&](double) { return std::vector{1.01 * near}; })));
            print(fmt::format("{} at focus, and a millionth beside | {} |", first, worst([](double focus) {
                                  return std::vector{focus * (1.0 - 1e-6), focus, focus * (1.0 + 1e-6)};
                              })));
            print(fmt::format("{} 0.02 m to 10 m | {} |", first, worst([](double) {
                                  std::vector<double> all;
                                  for (double d = 0.02; d < 10.0; d *= 1.01) all.push_back(d);
                                  return all;
                              })));
            print(fmt::format("{} 10 m to 100 km | {} |", first, worst([](double) {
                                  std::vector<double> all;
                                  for (double d = 10.0; d < 1e5; d *= 1.05) all.push_back(d);
                                  return all;
                              })));
        }
}

void projection() {
    print("\n## Projection\n");
    print(
        "Largest error of a vertex's place in a picture of 1832 px, px, of 1,000 places in view of an object that "
        "stands");
    print("1 to 10 of its scale's metres before the eye; eye and object away from the world's origin.\n");
    print("| scale, m | from the origin, m | matrices combined in double | in float |\n|---|---|---|---|");
    for (const double scale : {1e-4, 1.0, 1e3, 1e6})
        for (const double away : {0.0, 1e3 * scale, 1e5 * scale}) {
            View view = headsetView(0.05 * scale);
            view.pose.position = {away, 0.3 * away, away};
            const glm::dmat4 clip = clipFromView(view), eye = viewFromWorld(view.pose);
            double combined = 0.0, separate = 0.0;
            for (int i = 1; i <= 1000; ++i) {
                const double d = scale * (1.0 + 9.0 * halton(i, 5));
                const glm::dvec3 centre(away + (halton(i, 2) - 0.5) * d, 0.3 * away + (halton(i, 3) - 0.5) * d,
                                        away - d);
                // The object's place is what a file holds: floats.
                glm::mat4 placed(1.0f);
                placed[3] = glm::vec4(glm::vec3(centre), 1.0f);
                const glm::vec4 vertex(glm::vec3(scale * 0.1 * glm::dvec3(halton(i, 7), halton(i, 11), halton(i, 13))),
                                       1.0f);
                const auto place = [&](glm::dvec4 p) {
                    return glm::dvec2(p) / p.w * 0.5 * static_cast<double>(view.width);
                };
                const glm::dvec2 exact = place(clip * eye * glm::dmat4(placed) * glm::dvec4(vertex));
                if (std::max(std::abs(exact.x), std::abs(exact.y)) > 0.5 * view.width) continue;
                const glm::vec4 as = glm::mat4(clip) * (glm::mat4(eye * glm::dmat4(placed)) * vertex);
                const glm::vec4 other = glm::mat4(clip) * (glm::mat4(eye) * (placed * vertex));
                combined = std::max(combined, glm::length(place(glm::dvec4(as)) - exact));
                separate = std::max(separate, glm::length(place(glm::dvec4(other)) - exact));
            }
            print(fmt::format("| {:g} | {:g} | {:.1e} | {:.1e} |", scale, away, combined, separate));
        }
}

void focusFilter() {
    print("\n## Focus filter\n");
    print(
        "A step from 0.2 D to 4 D, time constant 0.1 s, in frames of unequal length for 0.25 s; the largest error of "
        "any");
    print("frame against the closed form, dioptres.\n");
    print("| frames/s | clock, s | the filter | in 32-bit floats |\n|---|---|---|---|");
    for (const double rate : {30.0, 90.0, 1000.0, 1e5})
        for (const double began : {0.0, 3600.0, 1e6}) {
            FocusDynamics dynamics;
            dynamics.tauFarToNear = dynamics.tauNearToFar = Seconds(0.1);
            FocusFilter filter(dynamics, Dioptres(0.2));
            FocusSample sample;
            sample.time = began;
            sample.valid = true;
            sample.underGaze = Dioptres(4.0);
            filter.sample(sample);
            auto time32 = static_cast<float>(began);
            float focus32 = 0.2f;
            double time = began, worst = 0.0, worst32 = 0.0;
            for (int i = 1; time < began + 0.25; ++i) {
                time = std::min(began + 0.25, time + (0.5 + halton(i, 2)) / rate);
                filter.advance(time);
                const auto next = static_cast<float>(time);
                focus32 += (4.0f - focus32) * (1.0f - std::exp(-(next - time32) / 0.1f));
                time32 = next;
                const double exact = 4.0 - 3.8 * std::exp(-(time - began) / 0.1);
                worst = std::max(worst, std::abs(filter.focus().value - exact));
                worst32 = std::max(worst32, std::abs(static_cast<double>(focus32) - exact));
            }
            print(fmt::format("| {:g} | {:g} | {:.1e} | {:.1e} |", rate, began, worst, worst32));
        }
}

void accumulation() {
    print("\n## Accumulation\n");
    print(
        "Relative error of the mean of N half floats between 0 and 2, eight added at once, the largest of 64 "
        "pixels.\n");
    print("| N | summed in 32-bit floats | in half floats |\n|---|---|---|");
    for (int samples = 16; samples <= 65536; samples *= 16) {
        double worst32 = 0.0, worst16 = 0.0;
        for (int pixel = 0; pixel < 64; ++pixel) {
            double exact = 0.0;
            float sum32 = 0.0f, sum16 = 0.0f;
            for (int first = 0; first < samples; first += 8) {
                float batch = 0.0f;
                for (int i = first; i < std::min(first + 8, samples); ++i) {
                    const float value = glm::unpackHalf1x16(
                        glm::packHalf1x16(static_cast<float>(2.0 * halton(i + 1 + 131 * pixel, 3))));
                    exact += static_cast<double>(value);
                    batch += value;
                }
                sum32 += batch;
                sum16 = glm::unpackHalf1x16(glm::packHalf1x16(sum16 + batch));
            }
            worst32 = std::max(worst32, std::abs(static_cast<double>(sum32) / exact - 1.0));
            worst16 = std::max(worst16, std::abs(static_cast<double>(sum16) / exact - 1.0));
        }
        print(fmt::format("| {} | {:.1e} | {:.1e} |", samples, worst32, worst16));
    }
}

}  // namespace
}  // namespace dioptre

int main() {
    dioptre::coc();
    dioptre::projection();
    dioptre::focusFilter();
    dioptre::accumulation();
}
