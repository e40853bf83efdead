// The two kinds of error that leave a function by exception (a programmer's mistake asserts instead).
// A message is one line: what, where, the value, the limit.
#pragma once

#include <stdexcept>

namespace dioptre {

/// Wrong usage or bad input (a file, an option, a setting): the program ends with exit code 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The machine or the run failed (no GL context, a write that failed): the program ends with exit code 1.
struct RunError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace dioptre
