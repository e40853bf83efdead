#include "viewer/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "core/error.hpp"

namespace dioptre {

struct Panel::Group {
    std::string_view title;
    bool open = false;  // at first
};
const Panel::Group Panel::kGroups[] = {
    {"Look", true}, {"Eye and lens", true}, {"Focus", true}, {"Display"}, {"Budget"}, {"Scene"}, {"Measure"}};

namespace {

/// Where a person looks for a setting. A new one is found where its neighbours of the command line are.
std::string_view groupOf(const Setting& setting) {
    const auto is = [&](auto... names) { return ((setting.name == names) || ...); };
    if (is("camera", "pose", "time") || setting.group == "system") return is("ui-scale") ? "Display" : "Scene";
    if (is("budget-ms")) return "Budget";
    if (setting.group == "lens") return "Eye and lens";
    if (setting.group == "focus") return "Focus";
    return setting.group == "view" ? "Display" : "Look";
}

bool contains(std::string_view text, std::string_view part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

bool disabledButton(const char* label, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    return pressed;
}

void explain(const Setting& setting) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(26.0f * ImGui::GetFontSize());
    std::string text(setting.help);
    if (const std::string range = setting.rangeText(); setting.kind != SettingKind::boolean && !range.empty())
        text += "\n" + range;
    text += "\ndefault: " + (setting.defaultText.empty() ? "not set" : setting.defaultText);
    if (setting.kind == SettingKind::number || setting.kind == SettingKind::integer)
        text += "\ndrag, or double-click to type";
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

double Panel::width(double windowWidth, double textHeight) {
    return std::min(windowWidth, 26.0 * textHeight);
}

PanelEdit Panel::draw(const PanelView& view) {
    PanelEdit edit;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(
        {static_cast<float>(width(static_cast<double>(all.x), static_cast<double>(ImGui::GetFontSize()))), all.y});
    ImGui::Begin("Settings", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    drawHead(view, edit);
    ImGui::BeginChild("groups");
    for (const Group& group : kGroups) drawGroup(view, group, edit);
    ImGui::EndChild();
    ImGui::End();
    return edit;
}

void Panel::drawHead(const PanelView& view, PanelEdit& edit) {
    const float button = 3.6f * ImGui::GetFontSize();
    ImGui::SetNextItemWidth(-2.0f * button);
    if (focusSearch_) ImGui::SetKeyboardFocusHere();
    focusSearch_ = false;
    if (ImGui::InputTextWithHint("##search", "search, or NAME VALUE and Enter", &search_,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
        runSearch(view, edit);
    ImGui::SameLine();
    edit.undo = disabledButton("Undo", view.canUndo);
    ImGui::SameLine();
    edit.redo = disabledButton("Redo", view.canRedo);

    ImGui::SetNextItemWidth(-2.0f * button);
    ImGui::InputTextWithHint("##preset", "file of settings, .json", &presetFile_);
    ImGui::SameLine();
    if (disabledButton("Load", !presetFile_.empty())) edit.load = presetFile_;
    ImGui::SameLine();
    if (disabledButton("Save", !presetFile_.empty())) edit.save = presetFile_;

    if (problem_.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.55f, 0.45f, 1.0f));
    ImGui::TextWrapped("%s", problem_.c_str());
    ImGui::PopStyleColor();
}

/// "aperture-mm 6": the name of a setting and its value.
void Panel::runSearch(const PanelView& view, PanelEdit& edit) {
    const std::size_t blank = search_.find(' ');
    if (blank == std::string::npos) return;
    const std::string name = search_.substr(0, blank);
    for (const Setting& setting : settingsTable()) {
        if (setting.name != name) continue;
        set(view, setting, search_.substr(search_.find_last_of(' ') + 1), edit);
        search_.clear();
        return;
    }
    problem_ = fmt::format("no setting is called {}", name);
}

bool Panel::found(const Setting& setting) const {
    // With a value behind it, a name is meant.
    const std::size_t blank = std::min(search_.find(' '), search_.size());
    const std::string_view word = std::string_view(search_).substr(0, blank);
    return contains(setting.name, word) || (blank == search_.size() && contains(setting.help, word));
}

void Panel::drawGroup(const PanelView& view, const Group& group, PanelEdit& edit) {
    const std::string_view title = group.title;
    std::vector<const Setting*> rows;
    bool changed = false;
    for (const Setting& setting : settingsTable()) {
        if (groupOf(setting) != title || !found(setting)) continue;
        rows.push_back(&setting);
        changed = changed || setting.get(view.settings, setting) != setting.defaultText;
    }
    const bool searching = !search_.empty();
    const bool hasPictures = title == "Measure" || title == "Budget";
    if (rows.empty() && (searching || !hasPictures)) return;

    // What a search opens is not what was open before it.
    const std::string id = std::string(group.title) + (searching ? "##found" : "");
    ImGui::SetNextItemOpen(searching || group.open, ImGuiCond_Once);
    const bool open = ImGui::CollapsingHeader(id.c_str(), ImGuiTreeNodeFlags_AllowItemOverlap);
    if (changed && !searching) {
        ImGui::SameLine(ImGui::GetContentRegionMax().x - 4.0f * ImGui::GetFontSize());
        if (ImGui::SmallButton(("Reset##" + id).c_str())) {
            Settings settings = view.settings;
            for (const Setting* setting : rows) setting->set(settings, *setting, setting->defaultText);
            edit.settings = settings;
        }
    }
    if (!open) return;
    constexpr ImGuiTableFlags kTable = ImGuiTableFlags_SizingFixedFit;
    if (!rows.empty() && ImGui::BeginTable(id.c_str(), 4, kTable)) {
        const float em = ImGui::GetFontSize();
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 9.6f * em);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("unit", ImGuiTableColumnFlags_WidthFixed, 3.6f * em);
        ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.4f * em);
        for (const Setting* setting : rows) drawRow(view, *setting, edit);
        ImGui::EndTable();
    }
    if (!searching) view.pictures(title);
}

void Panel::drawRow(const PanelView& view, const Setting& setting, PanelEdit& edit) {
    const std::string name(setting.name), unit(setting.unit), value = setting.get(view.settings, setting);
    ImGui::PushID(name.c_str());
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name.c_str());
    explain(setting);
    ImGui::TableNextColumn();
    if (const auto changed = values_.draw(setting, value, view.hints)) {
        set(view, setting, changed->text, edit);
        edit.goesOn = changed->goesOn;
    }
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", unit.c_str());
    ImGui::TableNextColumn();
    if (value != setting.defaultText) {
        if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0.0f})) set(view, setting, setting.defaultText, edit);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("back to %s", setting.defaultText.empty() ? "not set" : setting.defaultText.c_str());
    }
    ImGui::PopID();
}

void Panel::set(const PanelView& view, const Setting& setting, const std::string& text, PanelEdit& edit) {
    try {
        Settings settings = view.settings;
        setting.set(settings, setting, text);
        edit.settings = settings;
        problem_.clear();
    } catch (const InputError& error) {
        problem_ = error.what();
    }
}

}  // namespace dioptre
