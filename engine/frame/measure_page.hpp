// index.html of `dioptre measure`: one file that shows all without a network.
#pragma once

#include <string>

#include "frame/measure_pictures.hpp"
#include "frame/measure_rows.hpp"

namespace dioptre {

/// assets/pages/measure.html with the measurements in it. Every row has its thumbnail; picture and error map at their
/// size has each technique's best of a view, by SSIM, while the page stays under
/// `mostBytes` (paper-like blurs first).
std::string measurePage(const Measurements& all, const PictureFolder& pictures,
                        std::size_t mostBytes = std::size_t{14} << 20);

}  // namespace dioptre
