// Loads a scene on a thread of its own while the window goes on.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"

namespace dioptre {

class SceneLoader {
  public:
    SceneLoader() = default;
    /// Gives up what is being loaded, soon: it asks itself with each mesh.
    ~SceneLoader();
    SceneLoader(const SceneLoader&) = delete;
    SceneLoader& operator=(const SceneLoader&) = delete;

    /// Begins with `command`'s scene, once one that is being loaded was given up, which goOn() sees.
    void load(const Command& command);
    void goOn();

    bool running() const { return loading_.valid(); }
    /// It is there, or what went wrong with it.
    bool ready() const;
    /// What is being loaded, as the user named it.
    const std::string& name() const { return name_; }
    /// 0..1; 0 also where nobody knows.
    double progress() const { return progress_ ? progress_->share.load() : 0.0; }
    double seconds() const;  // since load()

    /// The scene once it is there; throws what went wrong with it. Does not wait.
    std::optional<Scene> take();
    /// The same, and waits. Only while running().
    Scene wait() { return loading_.get(); }

  private:
    void start(const Command& command);

    std::string name_;
    double began_ = 0.0;
    struct Progress {
        std::atomic<double> share = 0.0;
        std::atomic<bool> unwanted = false;
    };
    std::shared_ptr<Progress> progress_;  // of what is being loaded
    std::optional<Command> next_;
    std::future<Scene> loading_;  // waits when it goes away
};

}  // namespace dioptre
