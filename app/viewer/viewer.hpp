// dioptre view: the window, from frame to frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "viewer/depth_view.hpp"
#include "viewer/gui.hpp"
#include "viewer/history.hpp"
#include "viewer/instruments.hpp"
#include "viewer/keepsake.hpp"
#include "viewer/keymap.hpp"
#include "viewer/live_gaze.hpp"
#include "viewer/navigation.hpp"
#include "viewer/panel.hpp"
#include "viewer/scene_loader.hpp"
#include "viewer/show.hpp"
#include "viewer/split_view.hpp"
#include "viewer/stage_views.hpp"
#include "window.hpp"

namespace dioptre {

// What a picture that nobody waits for, one to be written or compared with, may take of a frame.
inline constexpr double kRefineMilliseconds = 50.0;

class Viewer {
  public:
    /// Opens the window and begins to load the scene. RunError where there is no display.
    explicit Viewer(const Command& command);
    ~Viewer();

    /// Until the window is closed; what was shown, where a log is asked for. Throws what is wrong with the first scene:
    /// there is nothing to go on with.
    std::vector<FrameReport> run();
    /// One turn of that: sleeps while there is nothing to do, then draws at most one frame; false once it is closed.
    bool step();

    /// How many frames the window showed, and how many pictures were made for them.
    struct Drawn {
        int frames = 0, pictures = 0;
    };
    const Drawn& drawn() const { return drawn_; }

  private:
    /// What was asked for since the last frame.
    struct Wish {
        Settings settings;
        bool byHand = false;  // the head was moved: no edit to be taken back
        bool edit = false, goesOn = false;
        bool picture = false;  // to be written, once all else is as wished
        int history = 0;       // -1: undo, 1: redo
    };

    void listen();
    bool closing() const;
    bool waitForWork();
    void frame();

    // What there is to see
    void takeScene();
    void takeWishes(Wish& wish);
    void apply(const Wish& wish);
    FrameMaker::Input inputNow();
    bool pictureIsStill();
    bool focusRests() const;
    void makePicture(const FrameMaker::Input& input);
    bool instrumentsDue() const;
    void drawForInstruments();
    void drawComparison();
    void drawOver();
    void showTitle();
    void say(const std::string& text);

    // Controls
    void pointerMoved(glm::dvec2 to);
    void windowMoved();
    void act(Action action, Wish& wish);
    void moveByHand(Wish& wish);
    bool moveLine();
    void drawPanel(Wish& wish);
    static void completeScreen(const ViewSettings& before, ViewSettings& after);
    void drawInstruments(std::string_view group, Wish& wish);
    std::optional<glm::dvec2> disparity() const;
    void drawDisparity() const;
    std::string disparityWarning() const;
    std::string status() const;
    ValueHints hints() const;
    bool settingsWait() const { return !show_ || wanted_; }
    static bool isSettingsFile(const std::string& file);
    void open(const std::string& file, Wish& wish);
    void toggleFullScreen();
    void fillMonitor(const std::string& monitor);
    void fitSize(Settings& settings) const;
    void nextCamera(Settings& settings) const;

    // Files
    Moment moment() const;
    void beginPicture();
    void drawPictureToBeWritten();
    void toggleRecording();
    void finishRecording();

    double sceneTime() const;
    Placement area() const;     // of the window, beside the panel; the window's coordinates, y down
    Placement picture() const;  // where the picture is in there
    std::optional<glm::dvec2> pointerGaze() const;

    Command command_;
    Settings settings_;
    SceneLoader loader_;
    std::unique_ptr<GazeInput> gazeInput_;  // none: the pointer
    std::unique_ptr<Window> window_;
    Gui gui_;
    std::unique_ptr<Show> show_;
    SettingsHistory history_;
    Panel panel_;
    Instruments instruments_;
    DepthView depths_;
    StageViews stages_;
    SplitView split_;
    bool movesLine_ = false;
    double lastSurvey_ = 0.0;
    bool panelOpen_ = false, keyListOpen_ = false;
    std::vector<FrameReport> log_;
    const FrameReport* report_ = nullptr;
    Drawn drawn_;

    // Input since the last frame
    std::vector<Action> actions_;
    std::vector<std::string> dropped_;
    bool woken_ = true;
    bool announced_ = false;  // that a scene is about to be shown
    int framesToDraw_ = 0;    // of the window, though the picture may be the same
    bool dragging_[3] = {};
    glm::dvec2 pointer_{0.0}, dragged_[3] = {};  // pixels, while each button was down
    Stance stance_;
    double lastFrame_ = 0.0;

    // Whether the picture changes
    FrameMaker::Input lastInput_;
    int stillFrames_ = 0;
    std::optional<double> heldTime_;  // of the scene, while nothing changes
    bool pictureMade_ = false;        // in this frame
    double start_ = 0.0, lastPicture_ = 0.0, changed_ = 0.0, refreshMs_ = 0.0;

    std::string error_, notice_, title_;
    double noticeUntil_ = 0.0;

    struct WantedPicture {
        std::filesystem::path name;
        Settings settings;
    };
    std::optional<WantedPicture> wanted_;  // and drawn in place of what the hand and the panel wish for
    std::optional<Recording> recording_;
};

}  // namespace dioptre
