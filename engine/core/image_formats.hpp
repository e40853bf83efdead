// Used only inside engine/core: one codec per picture format, between an Image and a file's bytes. Errors name no file,
// image.cpp puts its name before them. Decoding throws InputError, encoding RunError.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace dioptre {

std::string encodePng(const Image& image);
Image decodePng(std::string_view bytes);

std::string encodeExr(const Image& image);
Image decodeExr(std::string_view bytes);

std::string encodePfm(const Image& image);
Image decodePfm(std::string_view bytes);

/// InputError where a file's size is not one that Image takes; asked before memory is reserved for it.
void requireSize(long long width, long long height, std::size_t maxPixels);

}  // namespace dioptre
