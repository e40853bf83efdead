#include "viewer/show.hpp"

#include <utility>

namespace dioptre {

Show::Show(Scene&& shown, const Settings& settings) : scene_(std::move(shown)), maker_(scene_, settings) {
    wantLevels();
}

void Show::change(const Settings& settings) {
    maker_.change(scene_, settings);
    wantLevels();
}

void Show::wantLevels() {
    if (!maker_.mayUseLevels() || levels_ || haveLevels_) return;
    levels_ = std::make_unique<LodBuilder>(scene_, LodOptions{.folder = lodFolder(), .background = true});
}

bool Show::takeLevels() {
    if (!levels_) return false;
    const bool last = levels_->finished();
    const std::vector<BuiltLevel> ready = levels_->take();
    maker_.addLevels(ready);
    if (last) {
        levels_.reset();
        haveLevels_ = true;
        scene_.releaseBulk();
    }
    return !ready.empty() || last;
}

}  // namespace dioptre
