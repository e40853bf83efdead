// What each family's README says, asked of one of its models by name.
#pragma once

#include "models_common.hpp"

namespace dioptre::test {

void checkInterleaved(const std::string& name);
void checkAlphaBlend(const std::string& name);
void checkAlphaMask(const std::string& name);
void checkMaterial(const std::string& name);
void checkPrimitivesUv(const std::string& name);
void checkSampler(const std::string& name);

}  // namespace dioptre::test
