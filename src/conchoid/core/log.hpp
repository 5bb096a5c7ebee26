#pragma once

#include <string_view>

namespace conchoid {

/// Turns messages and progress off (warnings stay). Set once by the program; never changes a result.
void set_quiet(bool quiet);
bool quiet();

/// One line on stderr. The library never writes to stdout.
void message(std::string_view text);
/// "warning: …" on stderr: the result may not be what the user expects, and what to do about it.
void warning(std::string_view text);

}  // namespace conchoid
