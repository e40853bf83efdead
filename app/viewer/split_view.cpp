#include "viewer/split_view.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "metrics/metrics.hpp"

namespace dioptre {

namespace {

Image imageOf(const Texture& texture) {
    Image image(texture.width(), texture.height());
    image.pixels = readTexture(texture, GL_RGB, 3);
    return image;
}

}  // namespace

bool SplitView::drawPanel() {
    bool changed = false;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("compare with");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    const std::string current(other_ ? techniqueName(*other_) : "nothing");
    if (ImGui::BeginCombo("##compare", current.c_str())) {
        if (ImGui::Selectable("nothing", !other_)) {
            compareWith(std::nullopt);
            changed = true;
        }
        for (const TechniqueChoice technique : kTechniques) {
            if (!ImGui::Selectable(std::string(techniqueName(technique)).c_str(), other_ == technique)) continue;
            compareWith(technique);
            changed = true;
        }
        ImGui::EndCombo();
    }
    if (!other_) return changed;
    if (ImGui::RadioButton("right of a line", !difference_)) difference_ = false;
    ImGui::SameLine();
    if (ImGui::RadioButton("difference \u00d7 4", difference_)) difference_ = true;
    ImGui::TextWrapped("%s", describe().c_str());
    return changed;
}

void SplitView::compareWithNext() {
    const auto techniques = std::span(kTechniques);
    const auto now = other_ ? std::find(techniques.begin(), techniques.end(), *other_) + 1 : techniques.begin();
    compareWith(now == techniques.end() ? std::nullopt : std::optional(*now));
}

void SplitView::compareWith(std::optional<TechniqueChoice> technique) {
    other_ = technique;
    if (other_) return;
    difference_ = false;
    // Its textures are not kept for a next time.
    techniques_.clear();
    made_.reset();
    picture_ = nullptr;
    compositor_ = {};
}

std::string SplitView::describe() const {
    if (!other_ || made_ != other_) return {};
    const std::string name = planText(plan_);
    if (measured_) return fmt::format("{}: PSNR {:.1f} dB, SSIM {:.4f}", name, measured_->psnr, measured_->ssim);
    if (progress() < 1.0) return fmt::format("{}: {:.0f} %", name, 100.0 * progress());
    return fmt::format("{}: PSNR and SSIM follow once nothing moves", name);
}

Plan SplitView::planFor(TechniqueChoice technique, RenderSettings render) {
    render.technique = technique;
    render.samples.reset();
    return planOf(render).value_or(Plan());
}

void SplitView::draw(const FrameMaker& maker, const Settings& settings, double budgetMilliseconds) {
    const std::vector<View>& views = maker.eyeViews();
    if (made_ != other_ || techniques_.size() != views.size()) {
        techniques_.clear();
        for (std::size_t i = 0; i < views.size(); ++i) techniques_.push_back(makeTechnique(*other_));
        made_ = other_;
    }
    const RenderSettings& render = settings.render;
    plan_ = planFor(*other_, render);
    const double start = nowMilliseconds();
    std::vector<const Texture*> pictures;
    PassLog unread;
    for (std::size_t i = 0; i < views.size(); ++i) {
        EyeFrame frame{
            maker.scene(), views[i], maker.report().lens.lens, static_cast<float>(std::exp2(render.exposureEv)), 0, {},
            unread};
        apply(plan_, frame);
        frame.samplesNow = samplesNow_;
        pictures.push_back(&techniques_[i]->draw(frame));
    }
    glFinish();
    samplesNow_ = samplesInTime(samplesNow_, nowMilliseconds() - start, budgetMilliseconds, plan_.samples.value_or(1));
    const DisplayChoice display = views.size() == 1 ? DisplayChoice::mono : settings.view.display;
    picture_ = &compositor_.compose({*pictures.front(),
                                     *pictures.back(),
                                     {views.front().width, views.front().height},
                                     display,
                                     settings.view.swapEyes,
                                     render.tonemap},
                                    unread);
}

double SplitView::progress() const {
    double least = 1.0;
    for (const auto& technique : techniques_) least = std::min(least, technique->progress());
    return least;
}

bool SplitView::measurable() const {
    constexpr int kSmallest = 11;  // of SSIM
    return picture_ && std::min(picture_->width(), picture_->height()) >= kSmallest;
}

void SplitView::forget() {
    measured_.reset();
    outdated_ = true;
}

void SplitView::measure(const FrameMaker& maker) {
    if (measuring_.valid()) {
        if (measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
        const Distance distance = measuring_.get();
        if (!outdated_) measured_ = distance;
    }
    if (measured_ || !measurable()) return;
    outdated_ = false;
    // Until both are of the same settings
    const Texture& composed = maker.composedTexture();
    if (composed.width() != picture_->width() || composed.height() != picture_->height()) return;
    measuring_ = std::async(std::launch::async, [a = maker.composed(), b = imageOf(*picture_)] {
        return Distance{psnr(b, a), ssim(b, a)};
    });
}

void SplitView::present(const FrameMaker& maker, const Placement& area) {
    if (!picture_) return;
    Placement place = fitted({picture_->width(), picture_->height()}, {area.width, area.height});
    place.x += area.x;
    place.y += area.y;
    if (difference_) {
        if (!subtract_.program()) subtract_ = FullscreenPass("present/difference.frag.glsl");
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glViewport(place.x, place.y, place.width, place.height);
        maker.composedTexture().bind(0);
        picture_->bind(1);
        subtract_.program().set("origin", glm::vec2(place.x, place.y));
        subtract_.program().set("size", glm::vec2(place.width, place.height));
        subtract_.draw();
        return;
    }
    const int left = static_cast<int>(std::lround(line_ * place.width));
    glEnable(GL_SCISSOR_TEST);
    glScissor(place.x + left, place.y, place.width - left, place.height);
    PassLog unread;
    compositor_.present(area, unread);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace dioptre
