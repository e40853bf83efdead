// dioptre export: a scene that comes with the program, as a binary glTF file.
#include <fmt/format.h>

#include "commands.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "scene/builtin.hpp"

namespace dioptre {

void runExport(const Command& command) {
    requireWritableName(command.out);
    const std::string bytes = builtinGlb(command.scene);
    writeFileAtomically(command.out, bytes);
    logInfo(fmt::format("{}: {:.1f} MB", command.out.string(), static_cast<double>(bytes.size()) / 1e6));
}

}  // namespace dioptre
