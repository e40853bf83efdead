#include "viewer/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "viewer/wording.hpp"

namespace dioptre {

struct Panel::Group {
    std::string_view title;
    bool open = false;  // at first
};
const Panel::Group Panel::kGroups[] = {
    {"Look", true}, {"Eye and lens", true}, {"Focus", true}, {"Display"}, {"Budget"}, {"Scene"}, {"Measure"}};

namespace {

constexpr ImU32 kUnchanged = IM_COL32(168, 176, 189, 255), kWarning = IM_COL32(255, 191, 89, 255),
                kProblem = IM_COL32(255, 140, 115, 255);

/// Where a person looks for a setting. A new one is found where its neighbours of the command line are.
std::string_view groupOf(const Setting& setting) {
    const auto is = [&](auto... names) { return ((setting.name == names) || ...); };
    if (is("ui-scale", "monitor")) return "Display";
    if (is("camera", "pose", "time") || setting.group == "system") return "Scene";
    if (is("budget-ms")) return "Budget";
    if (is("show")) return "Measure";
    if (setting.group == "lens") return "Eye and lens";
    if (setting.group == "focus") return "Focus";
    return setting.group == "view" ? "Display" : "Look";
}

bool sameLetter(char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool contains(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(), sameLetter) != text.end();
}

/// What follows `name` and a blank; none where `text` does not begin so.
std::optional<std::string> valueBehind(std::string_view text, std::string_view name) {
    const bool begins = text.size() > name.size() && std::equal(name.begin(), name.end(), text.begin(), sameLetter);
    if (!begins || text[name.size()] != ' ') return std::nullopt;
    const std::size_t value = text.find_first_not_of(' ', name.size());
    return value == std::string_view::npos ? std::nullopt : std::optional<std::string>(text.substr(value));
}

bool disabledButton(const char* label, bool enabled, float width) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label, {width, 0.0f});
    ImGui::EndDisabled();
    return pressed;
}

struct Line {
    ImU32 color;
    const std::string& text;
};

/// At the bottom, so that nothing moves under the mouse where one comes or goes.
float heightOf(std::span<const Line> lines) {
    float height = 0.0f;
    for (const Line& line : lines)
        if (!line.text.empty())
            height += ImGui::CalcTextSize(line.text.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y +
                      ImGui::GetStyle().ItemSpacing.y;
    return height;
}

void drawLines(std::span<const Line> lines) {
    for (const Line& line : lines) {
        if (line.text.empty()) continue;
        ImGui::PushStyleColor(ImGuiCol_Text, line.color);
        ImGui::TextWrapped("%s", line.text.c_str());
        ImGui::PopStyleColor();
    }
}

void tip(const char* text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(26.0f * ImGui::GetFontSize());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

std::vector<std::string> presetsHere() {
    std::vector<std::string> files;
    std::error_code unreadable;
    for (const auto& entry : std::filesystem::directory_iterator(".", unreadable))
        if (entry.path().extension() == ".json") files.push_back(entry.path().filename().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// An arrow that goes back around, in a frame's square; pressed?
bool resetButton() {
    const float side = ImGui::GetFrameHeight();
    const bool pressed = ImGui::InvisibleButton("reset", {side, side});
    const ImVec2 from = ImGui::GetItemRectMin(), middle(from.x + 0.5f * side, from.y + 0.5f * side);
    const ImU32 color = ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    const float radius = 0.24f * side, head = 0.15f * side;
    constexpr float kFrom = -2.2f, kTo = 3.0f;  // radians, clockwise from the right
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PathArcTo(middle, radius, kFrom, kTo);
    list.PathStroke(color, 0, std::max(1.5f, 0.07f * side));
    const ImVec2 end(middle.x + radius * std::cos(kFrom), middle.y + radius * std::sin(kFrom));
    list.AddTriangleFilled({end.x - 1.3f * head, end.y + 0.3f * head}, {end.x + 0.9f * head, end.y - 1.1f * head},
                           {end.x + 0.7f * head, end.y + 1.1f * head}, color);
    return pressed;
}

void explain(const Setting& setting) {
    if (!ImGui::IsItemHovered()) return;
    std::string text(setting.help);
    if (const std::string range = setting.rangeText(); setting.kind != SettingKind::boolean && !range.empty())
        text += "\n" + range;
    text += "\ndefault: " + (setting.defaultText.empty() ? "not set" : setting.defaultText);
    text += fmt::format("\n--{}", setting.name);
    if ((setting.kind == SettingKind::number || setting.kind == SettingKind::integer) && setting.choices.empty())
        text += "\ndrag the value, with Shift faster, with Alt finer; double-click to type it";
    tip(text.c_str());
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
    ImGui::BeginDisabled(view.waits);
    drawHead(view, edit);
    const Line lines[] = {{kProblem, problem_}, {kWarning, view.warning}, {kUnchanged, view.status}};
    ImGui::BeginChild("groups", {0.0f, -heightOf(lines)}, false, ImGuiWindowFlags_AlwaysVerticalScrollbar);
    for (const Group& group : kGroups) drawGroup(view, group, edit);
    ImGui::EndChild();
    ImGui::EndDisabled();
    drawLines(lines);
    ImGui::End();
    return edit;
}

void Panel::drawHead(const PanelView& view, PanelEdit& edit) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float button = 3.4f * ImGui::GetFontSize(), gap = style.ItemSpacing.x;
    ImGui::SetNextItemWidth(-2.0f * (button + gap));
    if (focusSearch_) ImGui::SetKeyboardFocusHere();
    focusSearch_ = false;
    if (ImGui::InputTextWithHint("##search", "search, or NAME VALUE and Enter", &search_,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
        runSearch(view, edit);
    tip("words of a setting's name or meaning; with a value behind its name, Enter sets it: ipd 60");
    ImGui::SameLine();
    edit.undo = disabledButton("Undo", view.canUndo, button);
    tip("take back the last edit (Ctrl Z)");
    ImGui::SameLine();
    edit.redo = disabledButton("Redo", view.canRedo, button);
    tip("make it again (Ctrl Y)");

    const float arrow = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(-2.0f * (button + gap) - arrow);
    ImGui::InputTextWithHint("##preset", "preset: a .json file", &presetFile_);
    tip("a file of settings: type its name, or choose one of this folder's to load it");
    ImGui::SameLine(0.0f, 0.0f);
    if (ImGui::BeginCombo("##presets", nullptr, ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
        const std::vector<std::string> files = presetsHere();
        for (const std::string& file : files)
            if (ImGui::Selectable(file.c_str(), file == presetFile_)) edit.load = presetFile_ = file;
        if (files.empty()) ImGui::TextDisabled("no .json file in this folder");
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    if (disabledButton("Load", !presetFile_.empty(), button)) edit.load = presetFile_;
    ImGui::SameLine();
    if (disabledButton("Save", !presetFile_.empty(), button)) edit.save = presetFile_;

    ImGui::Spacing();
}

/// "aperture-mm 6": the name of a setting, or its label, and its value.
void Panel::runSearch(const PanelView& view, PanelEdit& edit) {
    if (search_.find(' ') == std::string::npos) return;
    for (const Setting& setting : settingsTable()) {
        auto value = valueBehind(search_, setting.name);
        if (!value) value = valueBehind(search_, labelOf(setting));
        if (!value) continue;
        set(view, setting, *value, edit);
        search_.clear();
        return;
    }
    problem_ = fmt::format("no setting is called {}", search_.substr(0, search_.find(' ')));
}

bool Panel::found(const Setting& setting) const {
    const std::string label = labelOf(setting);
    if (contains(setting.name, search_) || contains(label, search_) || contains(setting.help, search_)) return true;
    // With a value behind it, a name is meant.
    return valueBehind(search_, setting.name) || valueBehind(search_, label);
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
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 8.4f * em);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("unit", ImGuiTableColumnFlags_WidthFixed, 3.0f * em);
        ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, 1.4f * em);
        for (const Setting* setting : rows) drawRow(view, *setting, edit);
        ImGui::EndTable();
    }
    if (!searching) view.pictures(title);
}

void Panel::drawRow(const PanelView& view, const Setting& setting, PanelEdit& edit) {
    const std::string name(setting.name), value = setting.get(view.settings, setting);
    const bool changed = value != setting.defaultText;
    ImGui::PushID(name.c_str());
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    // What is not as it was made stands out.
    if (!changed) ImGui::PushStyleColor(ImGuiCol_Text, kUnchanged);
    ImGui::TextUnformatted(labelOf(setting).c_str());
    if (!changed) ImGui::PopStyleColor();
    explain(setting);
    ImGui::TableNextColumn();
    if (const auto edited = values_.draw(setting, value, view.hints)) {
        set(view, setting, edited->text, edit);
        edit.goesOn = edited->goesOn;
    }
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", unitOf(setting).c_str());
    ImGui::TableNextColumn();
    if (changed) {
        if (resetButton()) set(view, setting, setting.defaultText, edit);
        tip(fmt::format("back to {}", setting.defaultText.empty() ? "not set" : setting.defaultText).c_str());
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
