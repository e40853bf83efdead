// What the benchmarks share: the unit of price, medians.
#pragma once

#include <algorithm>
#include <vector>

#include "gl/objects.hpp"
#include "gl/pass.hpp"
#include "gl/program.hpp"

namespace dioptre {

inline double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// A full-screen pass with one bilinear RGBA16F fetch a pixel: the unit in which passes are priced.
class CopyPass {
  public:
    CopyPass(int width, int height)
        : source_({GL_RGBA16F, width, height, 1, 0}, "copy source"),
          target_({GL_RGBA16F, width, height, 1, 0}, "copy target"),
          pass_("common/copy.frag.glsl") {
        source_.setLinear(false);
        const Framebuffer::Attachment color[] = {{&target_, 0}};
        framebuffer_ = Framebuffer(color, nullptr, "copy");
        pass_.program().set("size", glm::vec2(width, height));
    }
    /// Milliseconds of one copy, of several in a row.
    double run() const {
        constexpr int kRepeats = 4;
        framebuffer_.bind();
        source_.bind(0);
        glFinish();
        const double start = nowMilliseconds();
        for (int i = 0; i < kRepeats; ++i) {
            pass_.draw();
            glFinish();
        }
        return (nowMilliseconds() - start) / kRepeats;
    }

  private:
    Texture source_, target_;
    FullscreenPass pass_;
    Framebuffer framebuffer_;
};

}  // namespace dioptre
