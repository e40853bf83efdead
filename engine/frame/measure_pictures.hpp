// Pictures of `dioptre measure` as a page shows them: error maps in colour, thumbnails, files in DIR/pictures.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace dioptre {

/// Box-filtered to a width, in linear light; never larger than it was.
Image smaller(const Image& image, int width);

std::string base64(std::string_view bytes);

/// "data:image/jpeg;base64,..." of a JPEG file's bytes.
std::string jpegDataUri(std::string_view jpeg);

/// Files of one view or row in a folder: KEY.jpg, KEY.flip.jpg, KEY.thumb.jpg.
class PictureFolder {
  public:
    explicit PictureFolder(std::filesystem::path folder);  // made on the first write

    void writePicture(const std::string& key, const Image& picture) const;  // with its thumbnail
    void writeErrors(const std::string& key, const Image& errors) const;    // one channel, 0..1

    /// "data:image/jpeg;base64,..."; empty where there is no such file. `kind`: "", ".flip", ".thumb".
    std::string dataUri(const std::string& key, std::string_view kind) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace dioptre
