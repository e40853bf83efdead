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
    /// Begins with `command`'s scene; one that is being loaded comes first, and is thrown away.
    void load(const Command& command);

    bool running() const { return loading_.valid(); }
    /// What is being loaded, as the user named it.
    const std::string& name() const { return name_; }
    /// 0..1; 0 also where nobody knows.
    double progress() const { return share_ ? share_->load() : 0.0; }
    double seconds() const;  // since load()

    /// The scene once it is there; throws what went wrong with it. Does not wait.
    std::optional<Scene> take();
    /// The same, and waits. Only while running().
    Scene wait() { return loading_.get(); }

  private:
    void start(const Command& command);

    std::string name_;
    double began_ = 0.0;
    std::shared_ptr<std::atomic<double>> share_;
    std::optional<Command> next_;
    std::future<Scene> loading_;  // waits when it goes away
};

}  // namespace dioptre
