#include "viewer/depth_view.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "viewer/sharp_range.hpp"

namespace dioptre {

namespace {

constexpr int kSurveyWidth = 96;   // pixels: enough for a histogram
constexpr double kLeastTop = 2.0;  // dioptres: half a metre is always on the axis
constexpr ImU32 kFrame = IM_COL32(30, 32, 38, 255), kText = IM_COL32(200, 205, 215, 255),
                kFaint = IM_COL32(110, 115, 125, 255), kBars = IM_COL32(125, 130, 140, 255),
                kFocusColor = IM_COL32(90, 200, 250, 255), kSharpColor = IM_COL32(80, 190, 120, 70),
                kRays = IM_COL32(90, 200, 250, 60);

std::string metres(Dioptres depth) {
    return depth.value > 1e-3 ? fmt::format("{:.3g} m", distance(depth).value) : "infinity";
}

}  // namespace

void DepthView::survey(const GpuScene& scene, const View& head) {
    View small = head;
    small.width = kSurveyWidth;
    small.height = std::max(1, kSurveyWidth * head.height / head.width);
    if (!depth_ || depth_.height() != small.height) {
        depth_ = Texture({GL_DEPTH_COMPONENT32F, small.width, small.height, 1, 0}, "depth of the panel");
        target_ = Framebuffer({}, &depth_, "depth of the panel");
    }
    target_.bind();
    const float infinitelyFar = 0.0f;
    glClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &infinitelyFar);
    constexpr double kDetailPx = 1.0;
    scene.drawDepth(small, kDetailPx);

    // Stored depth is near × vergence.
    std::vector<float> depths = readTexture(depth_, GL_DEPTH_COMPONENT, 1);
    for (float& depth : depths) depth = static_cast<float>(static_cast<double>(depth) / head.near.value);
    std::sort(depths.begin(), depths.end());
    const std::size_t end = depths.size() / 100;
    range_.reset();
    if (depths.back() > 0.0f)
        range_ = Range{static_cast<double>(depths[depths.size() - 1 - end]), static_cast<double>(depths[end])};
    top_ = std::max(kLeastTop, 1.2 * (range_ ? range_->nearest : 0.0));
    shares_.fill(0.0);
    for (const float depth : depths) {
        const auto bin = static_cast<std::size_t>(static_cast<double>(depth) / top_ * kBins);
        shares_[std::min<std::size_t>(bin, kBins - 1)] += 1.0 / static_cast<double>(depths.size());
    }
}

/// The nearest is at the left, before the eye, infinity at the right; the axis is linear in dioptres, as blur is.
void DepthView::draw(const FrameReport& report, const View& head) const {
    const float line = ImGui::GetTextLineHeight(), em = ImGui::GetFontSize();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 to(from.x + ImGui::GetContentRegionAvail().x, from.y + 7.0f * line);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::Dummy({to.x - from.x, to.y - from.y});
    list.AddRectFilled(from, to, kFrame);
    list.PushClipRect(from, to, true);

    const float eyeX = from.x + 1.2f * em, left = from.x + 2.6f * em, right = to.x - 0.6f * em;
    const float bottom = to.y - 1.3f * line, middle = 0.5f * (from.y + bottom);
    const auto at = [&](double vergence) {
        return right - static_cast<float>(std::clamp(vergence / top_, 0.0, 1.0)) * (right - left);
    };
    // Sharp range, then what is there
    const Lens& lens = report.lens.lens;
    const SharpRange sharp = sharpRange(lens, focalLengthPixels(head).x);
    list.AddRectFilled({at(sharp.nearest.value), from.y},
                       {std::max(at(sharp.farthest.value), at(sharp.nearest.value) + 1.0f), bottom}, kSharpColor);
    const double most = *std::max_element(shares_.begin(), shares_.end());
    for (int bin = 0; bin < kBins && most > 0.0; ++bin) {
        // Small shares are seen, too
        const auto height =
            static_cast<float>(std::sqrt(shares_[static_cast<std::size_t>(bin)] / most)) * (bottom - from.y - line);
        list.AddRectFilled({at((bin + 1) * top_ / kBins), bottom - height}, {at(bin * top_ / kBins) - 1.0f, bottom},
                           kBars);
    }
    // Eye, its pupil's rays, the focal plane
    const float focusX = at(lens.focus.value), pupil = 0.45f * em;
    list.AddLine({eyeX + 0.6f * em, middle - pupil}, {focusX, middle}, kRays, 1.5f);
    list.AddLine({eyeX + 0.6f * em, middle + pupil}, {focusX, middle}, kRays, 1.5f);
    list.AddCircle({eyeX, middle}, 0.8f * em, kText, 0, 1.5f);
    list.AddLine({eyeX + 0.6f * em, middle - pupil}, {eyeX + 0.6f * em, middle + pupil}, kFocusColor, 3.0f);
    list.AddLine({focusX, from.y}, {focusX, bottom}, kFocusColor, 2.0f);
    // Distances, where there is room
    float written = to.x + em;
    for (const double vergence : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
        const std::string label = vergence > 0.0 ? fmt::format("{:g}", 1.0 / vergence) : "inf";
        const float width = ImGui::CalcTextSize(label.c_str()).x,
                    x = std::min(at(vergence) - 0.5f * width, to.x - width);
        if (vergence > top_ || x + width + 0.5f * em > written) continue;
        list.AddText({x, bottom + 0.15f * line}, kFaint, label.c_str());
        list.AddLine({at(vergence), bottom}, {at(vergence), bottom + 3.0f}, kFaint);
        written = x;
    }
    list.AddText({from.x + 0.2f * em, bottom + 0.15f * line}, kFaint, "m");
    list.PopClipRect();
    const std::string text =
        fmt::format("focus {}, sharp from {} to {}", metres(lens.focus), metres(sharp.nearest), metres(sharp.farthest));
    ImGui::TextUnformatted(text.c_str());
    ImGui::Text("pupil %.2f mm", report.lens.apertureDiameter.value * 1e3);
}

}  // namespace dioptre
