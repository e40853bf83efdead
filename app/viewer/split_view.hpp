// Another technique's picture of the same frame: on the other side of a line, or as the difference.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "frame/frame_maker.hpp"
#include "gl/program.hpp"
#include "present/compositor.hpp"

namespace dioptre {

class SplitView {
  public:
    /// Controls for the panel, and what was measured; whether anything was changed.
    bool drawPanel();
    bool on() const { return other_.has_value(); }
    /// Nothing, then each technique in turn.
    void compareWithNext();
    void toggleDifference() { difference_ = on() && !difference_; }
    bool showsDifference() const { return on() && difference_; }
    /// "reference, 512 samples: PSNR 31.2 dB, SSIM 0.9731", or how far it is.
    std::string describe() const;

    /// Draws what `maker` drew last with the other technique, as far as the budget allows; goes on with the next call.
    void draw(const FrameMaker& maker, const Settings& settings, double budgetMilliseconds);
    /// How much of it is there, 0..1.
    double progress() const;
    /// Once both pictures are finished: how far they are apart, worked out in the background.
    void measure(const FrameMaker& maker);
    /// Nothing is missing of it, and it was measured.
    bool finished() const { return progress() >= 1.0 && (measured_ || !measurable()); }
    /// The pictures are others now.
    void forget();

    /// Over what the maker presented there: what is right of the line, or the difference.
    void present(const FrameMaker& maker, const Placement& area);
    /// Where the line is, 0..1 from the left of the picture; none where none is seen.
    std::optional<double> line() const { return on() && !difference_ ? std::optional(line_) : std::nullopt; }
    void setLine(double line) { line_ = line; }

  private:
    void compareWith(std::optional<TechniqueChoice> technique);
    bool measurable() const;
    static Plan planFor(TechniqueChoice technique, RenderSettings render);

    struct Distance {
        double psnr = 0.0, ssim = 0.0;
    };
    std::optional<TechniqueChoice> other_;
    bool difference_ = false;
    double line_ = 0.5;
    std::optional<TechniqueChoice> made_;  // what techniques_ are
    Plan plan_;                            // of it
    std::vector<std::unique_ptr<Technique>> techniques_;
    int samplesNow_ = 1;
    Compositor compositor_;
    const Texture* picture_ = nullptr;
    FullscreenPass subtract_;
    std::future<Distance> measuring_;
    bool outdated_ = false;  // what is being measured
    std::optional<Distance> measured_;
};

}  // namespace dioptre
