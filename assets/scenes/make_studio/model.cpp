// Small helpers of model.hpp.
#include "model.hpp"

namespace studio {

Object& Object::add(Patches more, const Paint& paint, float detail) {
    for (Patch& patch : more) {
        patch.paint = paint;
        patch.detail *= detail;
        patch.seed = hash(static_cast<std::uint32_t>(patches.size()),
                          static_cast<std::uint32_t>(name.size()) * 31u + static_cast<std::uint32_t>(name[0]));
        patches.push_back(std::move(patch));
    }
    return *this;
}

std::size_t Object::triangleCount() const {
    std::size_t count = 0;
    for (const Patch& p : patches) count += static_cast<std::size_t>(2 * (p.columns - 1) * (p.rows - 1));
    return count;
}

Object& Model::add(const std::string& name, Finish finish, int textureWidth, int textureHeight) {
    Object object;
    object.name = name;
    object.finish = finish;
    object.textureWidth = textureWidth;
    object.textureHeight = textureHeight;
    objects.push_back(std::move(object));
    return objects.back();
}

}  // namespace studio
