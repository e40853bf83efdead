// One setting's value to be seen and changed, by its kind.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings.hpp"

namespace dioptre {

/// What the table of settings does not say.
struct ValueHints {
    /// For a setting that is not set, where to begin; empty: nobody knows.
    std::function<std::string(const Setting&)> first;
    /// What stands in for one that is not set, "auto 4.32"; empty: nothing does.
    std::function<std::string(const Setting&)> standIn;
    /// Of texts: values to choose from, beside those that the table names.
    std::function<std::vector<std::string>(const Setting&)> choices;
};

class ValueEditor {
  public:
    struct Edit {
        std::string text;
        bool goesOn = false;  // by the movement of the mouse that made the edit before
    };
    /// Draws it, as wide as there is room; what it was changed to.
    std::optional<Edit> draw(const Setting& setting, const std::string& value, const ValueHints& hints);

  private:
    std::optional<std::string> drawNumber(const Setting& setting, const std::string& value);
    std::optional<std::string> drawText(const Setting& setting, const std::string& value, const ValueHints& hints);

    const Setting* dragged_ = nullptr;
    const Setting* typed_ = nullptr;  // and not yet entered
    std::string typedText_;
};

}  // namespace dioptre
