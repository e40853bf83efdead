#include "viewer/history.hpp"

#include <gtest/gtest.h>

namespace dioptre {
namespace {

/// Settings that are edited as the panel does it.
struct Edited {
    Settings now;
    SettingsHistory history;

    void set(std::string_view name, std::string_view text, bool goesOn = false) {
        const Settings before = now;
        applySetting(now, name, text);
        history.edited(before, now, goesOn);
    }
    void undo() {
        now = history.undone(now);
        history.undo();
    }
    void redo() {
        now = history.redone(now);
        history.redo();
    }
};

TEST(SettingsHistoryTest, TakesEditsBackOneByOneAndMakesThemAgain) {
    Edited e;
    EXPECT_FALSE(e.history.canUndo());
    e.set("ipd-mm", "70");
    e.set("technique", "pinhole");
    e.undo();
    EXPECT_EQ(e.now.render.technique, Settings().render.technique);
    EXPECT_EQ(e.now.view.ipdMm, 70.0);
    e.undo();
    EXPECT_TRUE(sameSettings(e.now, {}));
    EXPECT_FALSE(e.history.canUndo());
    e.redo();
    e.redo();
    EXPECT_EQ(e.now.view.ipdMm, 70.0);
    EXPECT_FALSE(sameSettings(e.now, {}));
    EXPECT_FALSE(e.history.canRedo());
}

TEST(SettingsHistoryTest, ADragIsOneEdit) {
    Edited e;
    e.set("ipd-mm", "64");
    e.set("ipd-mm", "65", true);
    e.set("ipd-mm", "66", true);
    e.set("exposure", "1", true);  // of another value: no part of it
    e.undo();
    EXPECT_EQ(e.now.view.ipdMm, 66.0);
    e.undo();
    EXPECT_EQ(e.now.view.ipdMm, 63.0);
    EXPECT_FALSE(e.history.canUndo());
    e.redo();
    EXPECT_EQ(e.now.view.ipdMm, 66.0);
}

TEST(SettingsHistoryTest, WhatWasMovedByHandStays) {
    Edited e;
    e.set("ipd-mm", "70");
    applySetting(e.now, "pose", "1,2,3,0,0,0,1");
    e.undo();
    EXPECT_EQ(e.now.view.ipdMm, 63.0);
    EXPECT_TRUE(e.now.view.pose.has_value());
}

TEST(SettingsHistoryTest, AnEditForgetsWhatWasTakenBack) {
    Edited e;
    e.set("ipd-mm", "70");
    e.undo();
    e.set("ipd-mm", "60");
    EXPECT_FALSE(e.history.canRedo());
    e.undo();
    EXPECT_EQ(e.now.view.ipdMm, 63.0);
}

TEST(SettingsHistoryTest, NothingDifferentIsNoEdit) {
    Edited e;
    e.set("ipd-mm", "63");
    EXPECT_FALSE(e.history.canUndo());
}

TEST(SettingsHistoryTest, AFileOfSettingsIsOneEdit) {
    Edited e;
    const Settings before = e.now;
    parseSettings(R"({"view": {"ipd-mm": 60, "swap-eyes": true}, "lens": {"aperture-mm": 5}})", "file", e.now);
    e.history.edited(before, e.now);
    e.undo();
    EXPECT_TRUE(sameSettings(e.now, {}));
}

}  // namespace
}  // namespace dioptre
