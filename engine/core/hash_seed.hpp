// The seed of hash tables over what a file holds, another one in each process: whoever wrote the file cannot make all
// of it fall into one place. Nothing that is kept or drawn may hang on it.
#pragma once

#include <cstdint>
#include <random>

namespace dioptre {

inline std::uint64_t hashSeed() {
    static const std::uint64_t seed = [] {
        std::random_device device;
        return std::uint64_t{device()} << 32 | device();
    }();
    return seed;
}

}  // namespace dioptre
