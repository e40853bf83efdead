// Used only by settings.cpp: between the text of a setting and its member, one reader and one writer per type.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/settings.hpp"
#include "core/text.hpp"

namespace dioptre::values {

inline constexpr double kNearestFocus = 0.001, kFarthestFocus = 1e9;  // metres; beyond: "inf"
inline constexpr int kLargestSide = 16384;                            // px, what every OpenGL 4.5 gives
inline constexpr int kDeepestPyramidLevel = 12;

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

// "1,2.5,-3": exactly N finite numbers.
template <std::size_t N>
std::optional<std::array<double, N>> parseNumbers(std::string_view text) {
    std::array<double, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == N)) return std::nullopt;
        const auto number = parseNumber(text.substr(0, comma));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    return numbers;
}

template <std::size_t N>
std::string printNumbers(const std::array<double, N>& numbers) {
    std::string text;
    for (const double number : numbers) {
        if (!text.empty()) text += ',';
        text += printNumber(number);
    }
    return text;
}

inline std::size_t choiceIndex(const Setting& setting, std::string_view text) {
    std::size_t i = 0;
    while (i < setting.choices.size() && setting.choices[i] != text) ++i;
    return i;
}

// The stages of `show` without a level; pyramid follows them.
inline constexpr std::string_view kShowNames[] = {"none", "vergence", "coc", "dob", "don", "level", "lod"};

// ---- One reader per type of member: false where the text is not allowed. ----

inline bool read(const Setting& setting, std::string_view text, double& value) {
    const auto number = parseNumber(text);
    // Also false for NaN.
    if (!number || !(*number >= setting.min && *number <= setting.max)) return false;
    if (setting.minExclusive && *number == setting.min) return false;
    value = *number;
    return true;
}

inline bool read(const Setting& setting, std::string_view text, int& value) {
    const auto number = parseInteger(text);
    if (!number) return false;
    if (setting.choices.empty() ? *number < setting.min || *number > setting.max
                                : choiceIndex(setting, std::to_string(*number)) == setting.choices.size())
        return false;
    value = *number;
    return true;
}

inline bool read(const Setting&, std::string_view text, bool& value) {
    if (text != "true" && text != "false") return false;
    value = text == "true";
    return true;
}

inline bool read(const Setting& setting, std::string_view text, std::string& value) {
    if (text.empty() && !setting.optional) return false;
    value = text;
    return true;
}

template <class Enum>
requires std::is_enum_v<Enum>
inline bool read(const Setting& setting, std::string_view text, Enum& value) {
    const std::size_t i = choiceIndex(setting, text);
    if (i == setting.choices.size()) return false;
    value = static_cast<Enum>(i);
    return true;
}

inline bool read(const Setting&, std::string_view text, FocusChoice& value) {
    if (text == "gaze" || text == "inf") {
        value = {text == "gaze" ? FocusMode::gaze : FocusMode::infinity, 0.0};
        return true;
    }
    const auto metres = parseNumber(text);
    if (!metres || !(*metres >= kNearestFocus && *metres <= kFarthestFocus)) return false;
    value = {FocusMode::metres, *metres};
    return true;
}

inline bool read(const Setting&, std::string_view text, std::array<double, 2>& value) {
    const auto numbers = parseNumbers<2>(text);
    if (!numbers) return false;
    for (const double x : *numbers)
        if (x < 0.0 || x > 1.0) return false;
    value = *numbers;
    return true;
}

inline bool read(const Setting&, std::string_view text, std::array<double, 7>& value) {
    const auto numbers = parseNumbers<7>(text);
    if (!numbers) return false;
    const auto& [x, y, z, qx, qy, qz, qw] = *numbers;
    if (!std::isnormal(qx * qx + qy * qy + qz * qz + qw * qw)) return false;  // no direction
    value = *numbers;
    return true;
}

inline bool read(const Setting&, std::string_view text, PictureSize& value) {
    const std::size_t times = text.find('x');
    if (times == std::string_view::npos) return false;
    const auto width = parseInteger(text.substr(0, times)), height = parseInteger(text.substr(times + 1));
    if (!width || !height || *width < 1 || *height < 1 || *width > kLargestSide || *height > kLargestSide) return false;
    value = {*width, *height};
    return true;
}

inline bool read(const Setting&, std::string_view text, ShowStage& value) {
    constexpr std::string_view kPyramid = "pyramid:";
    if (text.starts_with(kPyramid)) {
        const auto level = parseInteger(text.substr(kPyramid.size()));
        if (!level || *level < 0 || *level > kDeepestPyramidLevel) return false;
        value = {ShowChoice::pyramid, *level};
        return true;
    }
    for (std::size_t i = 0; i < std::size(kShowNames); ++i) {
        if (kShowNames[i] != text) continue;
        value = {static_cast<ShowChoice>(i), 0};
        return true;
    }
    return false;
}

/// The first choice is "auto": none.
inline bool read(const Setting& setting, std::string_view text, std::optional<TechniqueChoice>& value) {
    const std::size_t i = choiceIndex(setting, text);
    if (i == setting.choices.size()) return false;
    value = i == 0 ? std::nullopt : std::optional(static_cast<TechniqueChoice>(i - 1));
    return true;
}

template <class T>
bool read(const Setting& setting, std::string_view text, std::optional<T>& value) {
    if (text.empty()) {
        value.reset();
        return true;
    }
    T inner{};
    if (!read(setting, text, inner)) return false;
    value = inner;
    return true;
}

// ---- And one writer. ----

inline std::string write(const Setting&, double value) {
    return printNumber(value);
}
inline std::string write(const Setting&, int value) {
    return std::to_string(value);
}
inline std::string write(const Setting&, bool value) {
    return value ? "true" : "false";
}
inline std::string write(const Setting&, const std::string& value) {
    return value;
}
template <class Enum>
requires std::is_enum_v<Enum> std::string write(const Setting& setting, Enum value) {
    return std::string(setting.choices[static_cast<std::size_t>(value)]);
}
inline std::string write(const Setting&, const FocusChoice& value) {
    if (value.mode == FocusMode::metres) return printNumber(value.metres);
    return value.mode == FocusMode::gaze ? "gaze" : "inf";
}
template <std::size_t N>
std::string write(const Setting&, const std::array<double, N>& value) {
    return printNumbers(value);
}
inline std::string write(const Setting&, const PictureSize& value) {
    return std::to_string(value.width) + "x" + std::to_string(value.height);
}
inline std::string write(const Setting&, const ShowStage& value) {
    if (value.stage == ShowChoice::pyramid) return "pyramid:" + std::to_string(value.level);
    return std::string(kShowNames[static_cast<std::size_t>(value.stage)]);
}
inline std::string write(const Setting& setting, const std::optional<TechniqueChoice>& value) {
    return std::string(setting.choices[value ? static_cast<std::size_t>(*value) + 1 : 0]);
}
template <class T>
std::string write(const Setting& setting, const std::optional<T>& value) {
    return value ? write(setting, *value) : std::string();
}

}  // namespace dioptre::values
