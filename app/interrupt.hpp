// Ctrl-C and its kin: SIGINT, SIGTERM, SIGHUP.
#pragma once

namespace dioptre {

/// For the start of the program: these signals end it, as they would, but leave no half-written file; one that it was
/// started to ignore stays ignored. A file that grows too large (SIGXFSZ) becomes an error of the write.
void handleSignals();

/// From here on the first of these signals only sets interrupted(), for an end in good order. A later one, more than
/// 0.1 s after it, ends the program at once.
void watchInterrupts();
bool interrupted();

}  // namespace dioptre
