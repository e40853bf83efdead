// Edits of settings that can be taken back, one at a time. Only what an edit changed is kept: where the head was moved to
// by hand meanwhile stays.
#pragma once

#include <string>
#include <vector>

#include "core/settings.hpp"

namespace dioptre {

class SettingsHistory {
  public:
    /// Notes what is different in `after`, as one edit; what was taken back before is forgotten. Nothing different is no
    /// edit. With `goesOn` it is part of the last one: a value that is being dragged.
    void edited(const Settings& before, const Settings& after, bool goesOn = false);

    bool canUndo() const { return done_ > 0; }
    bool canRedo() const { return done_ < edits_.size(); }
    /// The settings as they were before the last edit, or after the next one.
    Settings undone(const Settings& now) const;
    Settings redone(const Settings& now) const;
    /// Once these are in use.
    void undo() { --done_; }
    void redo() { ++done_; }

  private:
    struct Value {
        const Setting* setting = nullptr;
        std::string before, after;
    };
    using Edit = std::vector<Value>;

    std::vector<Edit> edits_;
    std::size_t done_ = 0;  // of edits_; the others can be redone
};

/// Whether two trees hold the same values.
bool sameSettings(const Settings& a, const Settings& b);

}  // namespace dioptre
