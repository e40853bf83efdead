// Settings as JSON with comments. The library reports events without positions; it is fed through an iterator that
// tells how far it has read, so that every error can name its line.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/settings.hpp"
#include "core/text.hpp"

namespace dioptre {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxFileBytes = 1U << 20;  // a full tree takes 5 kB

// Reads characters and notes where it stands; the library reads at most one character past a value.
class TrackedIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TrackedIterator(const char* at, const char** seen) : at_(at), seen_(seen) {}
    reference operator*() const { return *at_; }
    TrackedIterator& operator++() {
        *seen_ = ++at_;
        return *this;
    }
    TrackedIterator operator++(int) {
        TrackedIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const TrackedIterator& other) const { return at_ == other.at_; }

  private:
    const char* at_;
    const char** seen_;
};

// Receives the events of { "group": { "name": value } } and sets each value at once.
class SettingsReader : public nlohmann::json_sax<Json> {
  public:
    SettingsReader(std::string_view json, std::string_view where, Settings& settings)
        : json_(json), where_(where), seen_(json.data()), settings_(settings) {}

    bool parse() {
        const char* end = json_.data() + json_.size();
        return Json::sax_parse(TrackedIterator(json_.data(), &seen_), TrackedIterator(end, &seen_), this,
                               Json::input_format_t::json, true, true);
    }

    bool key(string_t& name) override {
        keyLine_ = line();  // a key ends where the library stands; its value may already reach into the next line
        return depth_ == 1 ? openGroup(name) : openSetting(name);
    }
    bool start_object(std::size_t) override {
        if (depth_ == 0) keyLine_ = line();
        if (depth_ == 2) wrongType("an object");
        ++depth_;
        return true;
    }
    bool end_object() override {
        --depth_;
        return true;
    }
    bool start_array(std::size_t) override { wrongType("an array"); }
    bool end_array() override { return true; }

    bool null() override {
        if (!atValue() || !setting_->optional) wrongType("null");
        return assign("");
    }
    bool boolean(bool value) override {
        if (!atValue() || setting_->kind != SettingKind::boolean) wrongType(value ? "true" : "false");
        return assign(value ? "true" : "false");
    }
    bool number_integer(number_integer_t value) override { return number(std::to_string(value)); }
    bool number_unsigned(number_unsigned_t value) override { return number(std::to_string(value)); }
    bool number_float(number_float_t, const string_t& text) override { return number(text); }
    bool string(string_t& value) override {
        const bool takesText =
            atValue() && (setting_->kind == SettingKind::text || setting_->kind == SettingKind::choice);
        if (!takesText) wrongType(quote(value));
        return assign(value);
    }
    bool binary(binary_t&) override { return false; }

    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        // "[json.exception.parse_error.101] parse error at line 3, column 5: ...": the line is ours.
        std::string what = error.what();
        if (const auto bracket = what.find("] "); bracket != std::string::npos) what.erase(0, bracket + 2);
        if (const auto colon = what.find(": "); what.starts_with("parse error at") && colon != std::string::npos)
            what.erase(0, colon + 2);
        fail(line(), "broken JSON: " + what);
    }

  private:
    bool openGroup(const std::string& name) {
        group_ = name;
        std::vector<std::string_view> names;
        for (const Setting& setting : settingsTable())
            if (names.empty() || names.back() != setting.group) names.push_back(setting.group);
        if (std::find(names.begin(), names.end(), name) == names.end()) unknown("group", name, names);
        rejectRepeated(name);
        return true;
    }

    bool openSetting(const std::string& name) {
        const std::string path = group_ + "." + name;
        std::vector<std::string_view> names;
        for (const Setting& setting : settingsTable()) {
            if (setting.name == name && setting.group != group_)
                fail(keyLine_, path + ": this setting belongs into group " + quote(setting.group));
            if (setting.name == name) setting_ = &setting;
            names.push_back(setting.name);
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) unknown("setting", path, names, name);
        rejectRepeated(path);
        return true;
    }

    void rejectRepeated(const std::string& path) {
        for (const auto& [seenPath, seenLine] : seenKeys_)
            if (seenPath == path) fail(keyLine_, path + ": given twice, first in line " + std::to_string(seenLine));
        seenKeys_.emplace_back(path, keyLine_);
    }

    bool atValue() const { return depth_ == 2; }

    bool number(const std::string& text) {
        // A text may be a number too: a focus in metres, a camera's index.
        const bool takesNumber =
            atValue() && setting_->kind != SettingKind::boolean && setting_->kind != SettingKind::choice;
        if (!takesNumber) wrongType(text);
        return assign(text);
    }

    bool assign(std::string_view text) {
        try {
            setting_->set(settings_, *setting_, text);
        } catch (const InputError& error) {
            fail(keyLine_, group_ + "." + error.what());
        }
        return true;
    }

    [[noreturn]] void wrongType(const std::string& value) {
        if (depth_ == 0) fail(line(), value + " in place of an object { \"group\": { \"name\": value } }");
        if (depth_ == 1) fail(keyLine_, group_ + ": " + value + " in place of an object { \"name\": value }");
        fail(keyLine_, group_ + "." + std::string(setting_->name) + ": " + value + " is of the wrong type, it takes " +
                           setting_->rangeText() + (setting_->optional ? ", or null" : ""));
    }

    [[noreturn]] void unknown(const char* what, const std::string& name, const std::vector<std::string_view>& names,
                              std::string_view compared = {}) {
        const std::string_view nearest = nearestName(compared.empty() ? name : compared, names);
        fail(keyLine_, "unknown " + std::string(what) + " " + quote(name) +
                           (nearest.empty() ? "" : ", did you mean " + quote(nearest)));
    }

    [[noreturn]] void fail(std::ptrdiff_t atLine, const std::string& what) {
        throw InputError(std::string(where_) + ":" + std::to_string(atLine) + ": " + what);
    }

    std::ptrdiff_t line() const { return 1 + std::count(json_.data(), seen_, '\n'); }

    std::string_view json_, where_;
    const char* seen_;
    Settings& settings_;
    int depth_ = 0;
    std::ptrdiff_t keyLine_ = 1;
    std::string group_;
    const Setting* setting_ = nullptr;
    std::vector<std::pair<std::string, std::ptrdiff_t>> seenKeys_;
};

Json valueOf(const Setting& setting, const std::string& text) {
    if (setting.optional && text.empty()) return nullptr;
    if (setting.kind == SettingKind::boolean) return text == "true";
    if (setting.kind == SettingKind::integer) return *parseInteger(text);
    return text;
}

}  // namespace

void parseSettings(std::string_view json, std::string_view where, Settings& settings) {
    Settings changed = settings;  // an error leaves the settings as they were
    SettingsReader reader(json, where, changed);
    reader.parse();
    settings = std::move(changed);
}

void loadSettings(const std::filesystem::path& path, Settings& settings) {
    parseSettings(readFile(path, kMaxFileBytes), path.string(), settings);
}

std::string printSettings(const Settings& settings) {
    std::string json = "{";
    std::string_view group;
    for (const Setting& setting : settingsTable()) {
        const std::string text = setting.get(settings, setting);
        if (setting.group != group) {
            json += (group.empty() ? "\n    \"" : "\n    },\n    \"") + std::string(setting.group) + "\": {\n";
            group = setting.group;
        } else {
            json += ",\n";
        }
        json += "        \"" + std::string(setting.name) + "\": ";
        // Numbers keep the shortest text that reads back to the same bits.
        const bool plainNumber = setting.kind == SettingKind::number && !text.empty();
        json += plainNumber ? text : valueOf(setting, text).dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    return json + "\n    }\n}\n";
}

}  // namespace dioptre
