#pragma once

#include <string_view>

namespace conchoid {

/// One line to the sink of the current context (core/context.hpp); nowhere outside of any.
void message(std::string_view text);
/// The result may not be what the user expects, and what to do about it. What a run warns of is in its report,
/// too.
void warning(std::string_view text);

}  // namespace conchoid
