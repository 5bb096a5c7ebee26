#pragma once

namespace conchoid {

/// From now on Ctrl-C (SIGINT) and SIGTERM are remembered instead of ending the program; a second one ends it
/// at once. Called by the program, never by the library.
void catch_interrupts();
bool interrupted();
/// Throws Interrupted after a signal. Long loops call it between steps, when what is finished is safe.
void throw_if_interrupted();

}  // namespace conchoid
