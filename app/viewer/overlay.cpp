#include "viewer/overlay.hpp"

#include <imgui.h>

#include <algorithm>

#include "viewer/keymap.hpp"

namespace dioptre {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

ImVec2 windowSize() {
    return ImGui::GetIO().DisplaySize;
}

void cell(std::string_view text) {
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
}

}  // namespace

bool drawKeyList() {
    const ImVec2 all = windowSize();
    ImGui::SetNextWindowPos({0.5f * all.x, 0.5f * all.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const float width = std::min(all.x, 40.0f * ImGui::GetFontSize());
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, all.y});
    ImGui::Begin("Keys and mouse", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::SetWindowFocus();
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 0.32f);
        ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.68f);
        for (const KeyBinding& binding : keyMap()) {
            ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.56f, 0.80f, 0.98f, 1.0f));
            cell(binding.keys);
            ImGui::PopStyleColor();
            cell(binding.what);
        }
        ImGui::EndTable();
    }
    ImGui::Spacing();
    const bool closed = ImGui::Button("Close", {-1.0f, 0.0f});
    ImGui::End();
    return !closed;
}

void drawProgress(const Progress& progress, int place) {
    const ImVec2 all = windowSize();
    const float em = ImGui::GetFontSize(), width = std::min(all.x, 26.0f * em), height = 3.6f * em;
    ImGui::SetNextWindowPos({0.5f * (all.x - width), std::max(0.0f, all.y - height * static_cast<float>(place + 1))});
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::Begin(place == 0 ? "Progress" : "More progress", nullptr, kFixed | ImGuiWindowFlags_NoInputs);
    ImGui::TextUnformatted(progress.what.c_str());
    ImGui::ProgressBar(static_cast<float>(progress.share), {-1.0f, 0.0f});
    ImGui::End();
}

void drawLabel(const Label& label, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 0.35f * ImGui::GetFontSize();
    const float x = label.x + (1.0f - 2.0f * label.align) * 2.0f * pad - label.align * size.x, y = label.y + 2.0f * pad;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({x - pad, y - 0.5f * pad}, {x + size.x + pad, y + size.y + 0.5f * pad},
                       IM_COL32(15, 17, 20, 190), pad);
    list.AddText({x, y}, IM_COL32(225, 228, 235, 255), text.c_str());
}

void drawNotice(const std::string& text) {
    const ImVec2 all = windowSize();
    ImGui::SetNextWindowPos({all.x, all.y}, ImGuiCond_Always, {1.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {all.x, all.y});
    ImGui::Begin("Notice", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    ImGui::PushTextWrapPos(0.9f * all.x);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

bool drawError(const std::string& text) {
    const ImVec2 all = windowSize();
    const float width = std::min(all.x, 36.0f * ImGui::GetFontSize());
    ImGui::SetNextWindowPos({0.5f * all.x, 0.5f * all.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, all.y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.30f, 0.09f, 0.09f, 0.97f));
    ImGui::Begin("Error", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PopStyleColor();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    const bool read = ImGui::Button("Go on");
    ImGui::End();
    return !read;
}

}  // namespace dioptre
