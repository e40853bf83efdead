#include "viewer/history.hpp"

#include <algorithm>

namespace dioptre {

void SettingsHistory::edited(const Settings& before, const Settings& after, bool goesOn) {
    Edit edit;
    for (const Setting& setting : settingsTable()) {
        Value value{&setting, setting.get(before, setting), setting.get(after, setting)};
        if (value.before != value.after) edit.push_back(std::move(value));
    }
    if (edit.empty()) return;
    edits_.resize(done_);
    if (goesOn && !edits_.empty() && edits_.back().size() == 1 && edit.size() == 1 &&
        edits_.back().front().setting == edit.front().setting) {
        edits_.back().front().after = edit.front().after;
        return;
    }
    edits_.push_back(std::move(edit));
    ++done_;
}

Settings SettingsHistory::undone(const Settings& now) const {
    Settings settings = now;
    for (const Value& value : edits_[done_ - 1]) value.setting->set(settings, *value.setting, value.before);
    return settings;
}

Settings SettingsHistory::redone(const Settings& now) const {
    Settings settings = now;
    for (const Value& value : edits_[done_]) value.setting->set(settings, *value.setting, value.after);
    return settings;
}

bool sameSettings(const Settings& a, const Settings& b) {
    const auto table = settingsTable();
    return std::all_of(table.begin(), table.end(),
                       [&](const Setting& setting) { return setting.get(a, setting) == setting.get(b, setting); });
}

}  // namespace dioptre
