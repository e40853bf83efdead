// Alone in its file: it is compiled anew with every commit.
#include "commands.hpp"

#ifndef DIOPTRE_COMMIT
#define DIOPTRE_COMMIT "unknown"
#endif

namespace dioptre {

std::string sourceCommit() {
    return DIOPTRE_COMMIT;
}

}  // namespace dioptre
