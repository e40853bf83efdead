#include "viewer/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

namespace dioptre {

std::string labelOf(const Setting& setting) {
    // What is no word
    constexpr std::string_view kShort[] = {"ipd", "ui", "msaa"};
    constexpr std::string_view kUnits[] = {"mm", "ms", "mb", "deg"};
    const auto oneOf = [](std::string_view word, const auto& words) {
        return std::find(std::begin(words), std::end(words), word) != std::end(words);
    };
    std::string label;
    std::string_view rest = setting.name;
    while (!rest.empty()) {
        const std::size_t dash = std::min(rest.find('-'), rest.size());
        std::string word(rest.substr(0, dash));
        rest.remove_prefix(std::min(dash + 1, rest.size()));
        if (rest.empty() && !setting.unit.empty() && oneOf(word, kUnits)) break;
        const bool initials = oneOf(word, kShort);
        for (std::size_t i = 0; i < word.size(); ++i)
            if (initials || (label.empty() && i == 0))
                word[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[i])));
        label += (label.empty() ? "" : " ") + word;
    }
    return label;
}

std::string unitOf(const Setting& setting) {
    if (setting.unit == "deg" || setting.unit == "degrees") return "\u00b0";
    if (setting.unit == "cd/m^2") return "cd/m\u00b2";
    return std::string(setting.unit);
}

double dragStep(const Setting& setting, double value) {
    constexpr double kShare = 0.003, kLargest = 5.0, kOfRange = 0.1;
    const double least = std::min(kLargest, kOfRange * (setting.max - setting.min));
    const double about = kShare * std::max(std::abs(value), least);
    const double power = std::pow(10.0, std::floor(std::log10(about)));
    for (const double step : {5.0, 2.0})
        if (step * power <= about) return step * power;
    return power;
}

std::string dragFormat(double value, double step) {
    if (step >= 1.0) return "%.0f";
    const auto place = [](double x) { return static_cast<int>(std::floor(std::log10(x) + 1e-9)); };
    const int highest = std::abs(value) >= step ? place(std::abs(value)) : place(step);
    return fmt::format("%.{}g", std::max(1, highest - place(step) + 1));
}

}  // namespace dioptre
