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
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

}  // namespace

bool drawKeyList() {
    const ImVec2 all = windowSize();
    ImGui::SetNextWindowPos({0.5f * all.x, 0.5f * all.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, all);
    ImGui::Begin("Keys and mouse", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::SetWindowFocus();
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const KeyBinding& binding : keyMap()) {
            cell(binding.keys);
            cell(binding.what);
        }
        ImGui::EndTable();
    }
    ImGui::Spacing();
    const bool closed = ImGui::Button("Close");
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
