#include "viewer/instruments.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace dioptre {

namespace {

constexpr std::size_t kFrames = 160;
constexpr double kFocusSeconds = 5.0;
constexpr float kPlotLines = 6.0f;  // a plot's height, in lines of text
constexpr ImU32 kFrame = IM_COL32(30, 32, 38, 255), kText = IM_COL32(200, 205, 215, 255),
                kFaint = IM_COL32(110, 115, 125, 255), kFocusColor = IM_COL32(90, 200, 250, 255),
                kBudgetColor = IM_COL32(240, 90, 80, 255), kTargetColor = IM_COL32(250, 190, 80, 255),
                kZoneColor = IM_COL32(250, 190, 80, 40);

ImU32 colorOf(TechniqueChoice technique) {
    switch (technique) {
        case TechniqueChoice::pinhole:
            return IM_COL32(150, 155, 165, 255);
        case TechniqueChoice::mipmap:
            return IM_COL32(80, 190, 150, 255);
        case TechniqueChoice::accumulate:
            return IM_COL32(235, 150, 70, 255);
        case TechniqueChoice::reference:
            return IM_COL32(175, 120, 230, 255);
    }
    return kText;
}

struct StateLook {
    const char* name;
    ImU32 color;
};
StateLook lookOf(FocusState state) {
    switch (state) {
        case FocusState::tracking:
            return {"moving", IM_COL32(90, 200, 250, 255)};
        case FocusState::deadZone:
            return {"at rest: what is looked at is within the dead zone", IM_COL32(80, 170, 110, 255)};
        case FocusState::waiting:
            return {"waiting: a new depth was seen", IM_COL32(250, 190, 80, 255)};
        case FocusState::saccade:
            return {"held: the gaze is in flight", IM_COL32(200, 110, 220, 255)};
        case FocusState::invalid:
            return {"held: no gaze", IM_COL32(220, 90, 80, 255)};
        case FocusState::drifting:
            return {"no gaze for long: at the picture's middle", IM_COL32(130, 135, 145, 255)};
    }
    return {"", kText};
}

/// A place of full width in the panel for a picture of one's own.
struct Canvas {
    ImVec2 from, to;
    ImDrawList* list = nullptr;

    explicit Canvas(float lines) {
        from = ImGui::GetCursorScreenPos();
        const ImVec2 size(ImGui::GetContentRegionAvail().x, lines * ImGui::GetTextLineHeight());
        to = {from.x + size.x, from.y + size.y};
        list = ImGui::GetWindowDrawList();
        list->AddRectFilled(from, to, kFrame);
        ImGui::Dummy(size);
    }
    float width() const { return to.x - from.x; }
    float height() const { return to.y - from.y; }
    void text(float x, float y, ImU32 color, const std::string& what) const {
        list->AddText({x, y}, color, what.c_str());
    }
};

/// The least of 1, 2 or 5 times a power of ten that is not below `value`.
double roundUp(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * power) return step * power;
    return 10.0 * power;
}

}  // namespace

void Instruments::note(double now, const FrameReport& report, const FocusFilter& filter) {
    frames_.push_back({report.milliseconds, report.plan.technique});
    budgetMs_ = report.budgetMs;
    if (!report.decision)
        why_ = {};
    else if (!report.decision->why.empty())
        why_ = report.decision->why;
    if (frames_.size() > kFrames) frames_.pop_front();

    deadZone_ = filter.dynamics().deadZone;
    focus_.push_back({now, filter.target(), filter.focus(), filter.state()});
    while (focus_.front().time < now - kFocusSeconds) focus_.pop_front();

    stages_.clear();
    if (!report.passes.timed) return;
    for (const PassLog::Entry& entry : report.passes.entries) {
        const auto same = [&](const Stage& stage) { return stage.name == entry.name; };
        const auto found = std::find_if(stages_.begin(), stages_.end(), same);
        if (found == stages_.end())
            stages_.push_back({entry.name, entry.milliseconds});
        else
            found->milliseconds += entry.milliseconds;
    }
}

void Instruments::drawFrameTimes() const {
    if (frames_.empty()) return;
    const auto dearest = std::max_element(
        frames_.begin(), frames_.end(), [](const Frame& a, const Frame& b) { return a.milliseconds < b.milliseconds; });
    const double top = roundUp(std::max(dearest->milliseconds, 1.2 * budgetMs_));
    ImGui::Text("last frame %.1f ms, budget %.1f ms", frames_.back().milliseconds, budgetMs_);
    const Canvas canvas(kPlotLines);
    const float step = canvas.width() / static_cast<float>(kFrames);
    const auto heightOf = [&](double ms) { return static_cast<float>(std::min(ms / top, 1.0)) * canvas.height(); };
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        const float x = canvas.to.x - static_cast<float>(frames_.size() - i) * step;
        canvas.list->AddRectFilled({x, canvas.to.y - heightOf(frames_[i].milliseconds)},
                                   {x + std::max(step - 1.0f, 1.0f), canvas.to.y}, colorOf(frames_[i].technique));
    }
    const float line = canvas.to.y - heightOf(budgetMs_);
    canvas.list->AddLine({canvas.from.x, line}, {canvas.to.x, line}, kBudgetColor, 1.5f);
    canvas.text(canvas.from.x + 4.0f, canvas.from.y + 2.0f, kText, fmt::format("{:g} ms", top));
    const double fromRight = static_cast<double>((canvas.to.x - ImGui::GetIO().MousePos.x) / step);
    if (ImGui::IsItemHovered() && fromRight >= 0.0 && fromRight < static_cast<double>(frames_.size())) {
        const Frame& frame = frames_[frames_.size() - 1 - static_cast<std::size_t>(fromRight)];
        ImGui::SetTooltip("%.1f ms, %s", frame.milliseconds, std::string(techniqueName(frame.technique)).c_str());
    }
    // What the colours stand for, of those that are there
    bool first = true;
    for (const TechniqueChoice technique : kTechniques) {
        if (std::none_of(frames_.begin(), frames_.end(), [&](const Frame& f) { return f.technique == technique; }))
            continue;
        if (!first) ImGui::SameLine();
        first = false;
        const std::string name(techniqueName(technique));
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colorOf(technique)), "%s", name.c_str());
    }
    if (!why_.empty()) ImGui::TextWrapped("last choice: %.*s", static_cast<int>(why_.size()), why_.data());
}

void Instruments::drawStages() {
    ImGui::Checkbox("time the stages (frames take longer)", &timeStages_);
    if (!timeStages_ || stages_.empty()) return;
    const auto dearest = std::max_element(
        stages_.begin(), stages_.end(), [](const Stage& a, const Stage& b) { return a.milliseconds < b.milliseconds; });
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const Canvas canvas(static_cast<float>(stages_.size()) * line / ImGui::GetTextLineHeight());
    const float names = 9.0f * ImGui::GetFontSize(), numbers = 5.0f * ImGui::GetFontSize();
    const float room = std::max(canvas.width() - names - numbers, 1.0f);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
        const float y = canvas.from.y + static_cast<float>(i) * line;
        const float length = room * static_cast<float>(stages_[i].milliseconds / std::max(dearest->milliseconds, 1e-9));
        canvas.text(canvas.from.x + 4.0f, y + 1.0f, kText, std::string(stages_[i].name));
        canvas.list->AddRectFilled({canvas.from.x + names, y + 2.0f}, {canvas.from.x + names + length, y + line - 2.0f},
                                   kFocusColor);
        canvas.text(canvas.from.x + names + length + 6.0f, y + 1.0f, kText,
                    fmt::format("{:.2f} ms", stages_[i].milliseconds));
    }
}

void Instruments::drawFocus() const {
    if (focus_.size() < 2) return;
    double top = 1.0;
    for (const Focus& f : focus_) top = std::max({top, f.target.value + deadZone_.value, f.focus.value});
    top = roundUp(top);
    const Canvas canvas(kPlotLines);
    const float strip = 0.4f * ImGui::GetTextLineHeight();  // of states, below
    const double end = focus_.back().time;
    const auto at = [&](double time, Dioptres value) {
        const double y = std::clamp(value.value / top, 0.0, 1.0);
        return ImVec2(canvas.to.x - static_cast<float>((end - time) / kFocusSeconds) * canvas.width(),
                      canvas.to.y - strip - static_cast<float>(y) * (canvas.height() - strip));
    };
    for (std::size_t i = 1; i < focus_.size(); ++i) {
        const Focus &a = focus_[i - 1], &b = focus_[i];
        const ImVec2 zone = at(a.time, a.target + deadZone_), below = at(b.time, a.target - deadZone_);
        canvas.list->AddRectFilled(zone, below, kZoneColor);
    }
    for (std::size_t i = 1; i < focus_.size(); ++i) {
        const Focus &a = focus_[i - 1], &b = focus_[i];
        canvas.list->AddLine(at(a.time, a.target), at(b.time, b.target), kTargetColor, 1.5f);
        canvas.list->AddLine(at(a.time, a.focus), at(b.time, b.focus), kFocusColor, 2.0f);
        const float left = at(a.time, a.target).x, right = at(b.time, b.target).x;
        canvas.list->AddRectFilled({left, canvas.to.y - strip}, {right + 0.5f, canvas.to.y}, lookOf(b.state).color);
    }
    canvas.text(canvas.from.x + 4.0f, canvas.from.y + 2.0f, kText, fmt::format("{:g} D", top));
    const std::string span = fmt::format("the last {:g} s", kFocusSeconds);
    canvas.text(canvas.to.x - ImGui::CalcTextSize(span.c_str()).x - 4.0f, canvas.from.y + 2.0f, kFaint, span);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kFocusColor), "focus %.2f D", focus_.back().focus.value);
    ImGui::SameLine();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kTargetColor), "target %.2f D, dead zone %.2f D",
                       focus_.back().target.value, deadZone_.value);
    const StateLook look = lookOf(focus_.back().state);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(look.color), "%s", look.name);
}

}  // namespace dioptre
