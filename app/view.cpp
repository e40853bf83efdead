// dioptre view: the scene in a window.
#include "commands.hpp"
#include "core/file.hpp"
#include "frame/sequence.hpp"
#include "interrupt.hpp"
#include "viewer/viewer.hpp"

namespace dioptre {

void runView(const Command& command) {
    if (!command.log.empty()) requireWritableName(command.log);
    Viewer viewer(command);
    watchInterrupts();
    const std::vector<FrameReport> shown = viewer.run();
    if (!command.log.empty()) writeFileAtomically(command.log, frameLogCsv(shown));
}

}  // namespace dioptre
