// The settings as a panel at the window's left side: every row of the settings' table, grouped as a person thinks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/settings.hpp"
#include "viewer/panel_value.hpp"

namespace dioptre {

/// What the panel shows.
struct PanelView {
    const Settings& settings;
    const ValueHints& hints;
    bool canUndo = false, canRedo = false;
    bool waits = false;           // nothing can be set now
    std::string status, warning;  // below the groups; empty: nothing
    /// Below the settings of a group, its pictures; by the group's title.
    const std::function<void(std::string_view)>& pictures;
};

/// What was done to it in this frame.
struct PanelEdit {
    std::optional<Settings> settings;  // other ones
    bool goesOn = false;               // by the same movement of the mouse as before
    bool undo = false, redo = false;
    std::string load, save;  // a file of settings; empty: none
};

class Panel {
  public:
    /// Its width in a window, in the window's coordinates.
    static double width(double windowWidth, double textHeight);

    PanelEdit draw(const PanelView& view);

    /// Shown until the next edit; empty: nothing.
    void complain(const std::string& problem) { problem_ = problem; }
    /// The next frame puts the keyboard into the search box.
    void search() { focusSearch_ = true; }

  private:
    struct Group;
    static const Group kGroups[7];

    void drawHead(const PanelView& view, PanelEdit& edit);
    void drawGroup(const PanelView& view, const Group& group, PanelEdit& edit);
    void drawRow(const PanelView& view, const Setting& setting, PanelEdit& edit);
    void runSearch(const PanelView& view, PanelEdit& edit);
    void set(const PanelView& view, const Setting& setting, const std::string& text, PanelEdit& edit);
    bool found(const Setting& setting) const;

    std::string search_, presetFile_ = "settings.json", problem_;
    bool focusSearch_ = false;
    ValueEditor values_;
};

}  // namespace dioptre
