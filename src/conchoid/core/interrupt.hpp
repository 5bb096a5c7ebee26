#pragma once

namespace conchoid {

/// Whether somebody asked the current context to stop (ExecutionContext::request_stop); never outside of any.
bool interrupted();
/// Throws Interrupted after that. Long loops call it between steps, when what is finished is safe.
void throw_if_interrupted();

}  // namespace conchoid
