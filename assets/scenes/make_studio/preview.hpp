// A ray-cast picture of the finished scene, textures as they are written, shaded as the viewer does.
#pragma once

#include "textures.hpp"

namespace studio {

struct PreviewOptions {
    int width = 640, height = 480, samples = 9;
    std::size_t camera = 0;
    float apertureDiameter = 0.0f;  // metres; 0: pinhole
    float focusDistance = 1.0f;     // metres along the view axis
};

Picture renderPreview(const Model& model, const std::vector<ObjectPictures>& pictures, const PreviewOptions& options);

}  // namespace studio
