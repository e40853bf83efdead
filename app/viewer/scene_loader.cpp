#include "viewer/scene_loader.hpp"

#include <chrono>

#include "gl/pass.hpp"

namespace dioptre {

void SceneLoader::load(const Command& command) {
    name_ = command.scene.empty() ? "builtin:studio" : command.scene;
    began_ = nowMilliseconds();
    if (running())
        next_ = command;
    else
        start(command);
}

void SceneLoader::start(const Command& command) {
    share_ = std::make_shared<std::atomic<double>>(0.0);
    loading_ = std::async(std::launch::async, [command, share = share_] {
        return loadScene(command, [&share](double done) { share->store(done); });
    });
}

double SceneLoader::seconds() const {
    return (nowMilliseconds() - began_) * 1e-3;
}

std::optional<Scene> SceneLoader::take() {
    if (!running() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    if (!next_) return loading_.get();
    // Nobody wants this one any more, nor its errors.
    loading_ = {};
    start(*next_);
    next_.reset();
    return std::nullopt;
}

}  // namespace dioptre
