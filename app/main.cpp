// dioptre: the program. Parses the command line, runs one command, turns errors into one line and an exit code.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include "commands.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "interrupt.hpp"

namespace dioptre {

namespace {

void run(const Command& command) {
    if (command.printConfig) {
        std::fputs(printSettings(command.settings).c_str(), stdout);
        return;
    }
    switch (command.which) {
        case Command::Which::nothingToDo:
            break;
        case Command::Which::view:
            runView(command);
            break;
        case Command::Which::render:
            runRender(command);
            break;
        case Command::Which::inspect:
            runInspect(command);
            break;
        case Command::Which::compare:
            runCompare(command);
            break;
        case Command::Which::exportScene:
            runExport(command);
            break;
        case Command::Which::measure:
            runMeasure(command);
            break;
        case Command::Which::budget:
            runBudget(command);
            break;
    }
}

}  // namespace
}  // namespace dioptre

int main(int argc, char** argv) {
    dioptre::handleSignals();
    try {
        dioptre::run(dioptre::parseCommandLine(argc, argv));
        // A full disk shows only when what was printed is written out.
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw dioptre::RunError(std::string("standard output: ") + std::strerror(errno));
        return 0;
    } catch (const dioptre::InputError& error) {
        dioptre::logError(error.what());
        return 2;
    } catch (const std::bad_alloc&) {
        dioptre::logError("out of memory");
        return 1;
    } catch (const std::exception& error) {
        dioptre::logError(error.what());
        return 1;
    }
}
