// The two kinds of headless context, each in a file of its own.
#pragma once

#include <memory>

#include "gl/context.hpp"

namespace dioptre {

std::unique_ptr<Context> createOsmesaContext();
std::unique_ptr<Context> createEglContext();

}  // namespace dioptre
