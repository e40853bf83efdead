#include "viewer/scene_loader.hpp"

#include <chrono>
#include <utility>

#include "gl/pass.hpp"

namespace dioptre {

namespace {

// Thrown out of a load that nobody wants any more. No std::exception: nothing that handles errors may take it for one.
struct Unwanted {};

}  // namespace

SceneLoader::~SceneLoader() {
    if (progress_) progress_->unwanted = true;
}

void SceneLoader::load(const Command& command) {
    name_ = command.scene.empty() ? "builtin:studio" : command.scene;
    began_ = nowMilliseconds();
    if (!running()) return start(command);
    progress_->unwanted = true;
    next_ = command;
}

void SceneLoader::start(const Command& command) {
    progress_ = std::make_shared<Progress>();
    loading_ = std::async(std::launch::async, [command, progress = progress_] {
        return loadScene(command, [&progress](double share) {
            if (progress->unwanted) throw Unwanted();
            progress->share = share;
        });
    });
}

bool SceneLoader::ready() const {
    return running() && !next_ && loading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

double SceneLoader::seconds() const {
    return (nowMilliseconds() - began_) * 1e-3;
}

void SceneLoader::goOn() {
    if (!next_ || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    // Nobody wants that one any more, nor its errors.
    loading_ = {};
    start(*std::exchange(next_, std::nullopt));
}

std::optional<Scene> SceneLoader::take() {
    if (!ready()) return std::nullopt;
    return loading_.get();
}

}  // namespace dioptre
