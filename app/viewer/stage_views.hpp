// The stages of a frame (--show) as small pictures in the panel.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gl/program.hpp"
#include "render/technique.hpp"

namespace dioptre {

class StageViews {
  public:
    /// Another picture was made: what is here is of the one before.
    void age() { fresh_ = 0; }
    /// Whether the panel shows them and they are not all of the last picture.
    bool due() const { return shown_ && (stages_.empty() || fresh_ < stages_.size()); }
    /// Draws one of them anew, in turn, as the technique's plan has it. A few hundredths of what a frame takes.
    void drawNext(const GpuScene& scene, const View& head, const Lens& lens, const Plan& plan, double exposure);

    /// In the panel; the one that was clicked at.
    std::optional<ShowStage> draw(const ShowStage& current);
    /// The panel no longer shows them.
    void hide() { shown_ = false; }

  private:
    struct Small {
        ShowStage stage;
        Texture picture;  // sRGB, as it is shown
        Framebuffer target;
    };
    void prepare(TechniqueChoice technique, int height);

    std::optional<TechniqueChoice> choice_;
    std::unique_ptr<Technique> technique_;
    std::vector<Small> stages_;
    FullscreenPass encode_;
    std::size_t next_ = 0, fresh_ = 0;
    bool shown_ = false;
};

}  // namespace dioptre
