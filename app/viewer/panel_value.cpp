#include "viewer/panel_value.hpp"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "viewer/wording.hpp"

namespace dioptre {

namespace {

// A drag of so many pixels goes through the whole of a logarithmic range.
constexpr double kWholeRangePixels = 1500.0;
constexpr double kIntegerPerPixel = 0.01;  // of the value
// A range of more than that is logarithmic.
constexpr double kWideRange = 1e5;

std::optional<std::string> drawCheck(const std::string& value) {
    bool on = value == "true";
    if (!ImGui::Checkbox("##value", &on)) return std::nullopt;
    return on ? "true" : "false";
}

std::optional<std::string> drawChoice(const Setting& setting, const std::string& value) {
    std::optional<std::string> chosen;
    if (!ImGui::BeginCombo("##value", value.c_str(), ImGuiComboFlags_HeightLarge)) return chosen;
    for (const std::string_view choice : setting.choices) {
        const std::string text(choice);
        if (ImGui::Selectable(text.c_str(), text == value)) chosen = text;
    }
    ImGui::EndCombo();
    return chosen;
}

/// The words of a form with alternatives: "inf" and "gaze" of "METRES|inf|gaze", but nothing that stands for something
/// else.
std::vector<std::string> wordsOf(std::string_view form) {
    std::vector<std::string> words;
    if (form.find('|') == std::string_view::npos) return words;
    while (!form.empty()) {
        const std::size_t bar = std::min(form.find('|'), form.size());
        const std::string_view word = form.substr(0, bar);
        const bool plain = std::all_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
        if (plain) words.emplace_back(word);
        form.remove_prefix(std::min(bar + 1, form.size()));
    }
    return words;
}

}  // namespace

std::optional<ValueEditor::Edit> ValueEditor::draw(const Setting& setting, const std::string& value,
                                                   const ValueHints& hints) {
    ImGui::SetNextItemWidth(-1.0f);
    const auto once = [](std::optional<std::string> text) {
        return text ? std::optional(Edit{*text, false}) : std::nullopt;
    };
    const bool hasChoices = !setting.choices.empty();
    const bool isNumber = (setting.kind == SettingKind::number || setting.kind == SettingKind::integer) && !hasChoices;
    if (setting.kind == SettingKind::boolean) return once(drawCheck(value));
    if (hasChoices && !(setting.optional && value.empty())) return once(drawChoice(setting, value));
    if ((isNumber || hasChoices) && value.empty()) {
        const std::string standIn = hints.standIn(setting);
        if (ImGui::Button(standIn.empty() ? "not set" : standIn.c_str(), {-1.0f, 0.0f})) {
            if (hasChoices) return Edit{std::string(setting.choices.front()), false};
            const std::string first = hints.first(setting);
            return Edit{first.empty() ? printNumber(std::clamp(1.0, setting.min, setting.max)) : first, false};
        }
        return std::nullopt;
    }
    if (!isNumber) return once(drawText(setting, value, hints));
    const auto changed = drawNumber(setting, value);
    const bool same = dragged_ == &setting;
    if (changed) dragged_ = &setting;
    if (same && !ImGui::IsItemActive()) dragged_ = nullptr;
    return changed ? std::optional(Edit{*changed, same}) : std::nullopt;
}

std::optional<std::string> ValueEditor::drawNumber(const Setting& setting, const std::string& value) {
    if (setting.kind == SettingKind::integer) {
        int number = parseInteger(value).value_or(0);
        const int least = static_cast<int>(setting.min), most = static_cast<int>(setting.max);
        const auto speed = static_cast<float>(std::max(std::abs(number), 8) * kIntegerPerPixel);
        if (!ImGui::DragInt("##value", &number, speed, least, most, "%d", ImGuiSliderFlags_AlwaysClamp))
            return std::nullopt;
        return std::to_string(number);
    }
    double number = parseNumber(value).value_or(0.0);
    const bool logarithmic = setting.min > 0.0 && setting.max / setting.min > kWideRange;
    const double step = logarithmic ? (setting.max - setting.min) / kWholeRangePixels : dragStep(setting, number);
    // What was typed is shown as it was; what is dragged comes in short numbers.
    const bool dragged = dragged_ == &setting;
    const std::string format = !dragged ? "%.6g" : logarithmic ? "%.3g" : dragFormat(number, step);
    ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    if (logarithmic) flags |= ImGuiSliderFlags_Logarithmic;
    const bool changed = ImGui::DragScalar("##value", ImGuiDataType_Double, &number, static_cast<float>(step),
                                           &setting.min, &setting.max, format.c_str(), flags);
    return changed ? std::optional(printNumber(number)) : std::nullopt;
}

std::optional<std::string> ValueEditor::drawText(const Setting& setting, const std::string& value,
                                                 const ValueHints& hints) {
    std::vector<std::string> choices = wordsOf(setting.form);
    for (std::string& choice : hints.choices(setting)) choices.push_back(std::move(choice));
    const float menu = choices.empty() ? 0.0f : ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(choices.empty() ? -1.0f : -menu);
    std::string text = typed_ == &setting ? typedText_ : value;
    const std::string hint(setting.form);
    if (ImGui::InputTextWithHint("##value", hint.c_str(), &text)) {
        typed_ = &setting;
        typedText_ = text;
    }
    std::optional<std::string> entered;
    if (ImGui::IsItemDeactivatedAfterEdit() && typed_ == &setting) entered = typedText_;
    if (ImGui::IsItemDeactivated() && typed_ == &setting) typed_ = nullptr;
    if (choices.empty()) return entered;
    ImGui::SameLine(0.0f, 0.0f);
    if (ImGui::BeginCombo("##choices", nullptr, ImGuiComboFlags_NoPreview | ImGuiComboFlags_HeightLarge)) {
        for (const std::string& choice : choices)
            if (ImGui::Selectable(choice.c_str(), choice == value)) entered = choice;
        ImGui::EndCombo();
    }
    return entered;
}

}  // namespace dioptre
