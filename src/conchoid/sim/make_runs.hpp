#pragma once

#include <functional>
#include <memory>
#include <span>

#include "conchoid/learn/run_part.hpp"
#include "conchoid/sim/database_spec.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// Runs of a database, in parallel, without files: begun in their order, each handed on as soon as it is finished. A
/// body is prepared once for all of its runs. A run that cannot be computed, or whose body cannot be made, is handed on
/// as excluded, with the message as the reason. Throws Interrupted after Ctrl-C, and InputError for a scene that is wrong.
/// @param keep  may be called from several threads
void make_runs(const DatabaseSpec& spec, std::span<const std::int32_t> runs,
               const std::function<void(RunPart)>& keep);

/// A run of a specification made ready for any method.
struct PreparedRun {
  Scene scene;
  std::shared_ptr<const PreparedBody> body;
  RunRecord record;  ///< what was drawn; nothing of the outcome
};

/// @param body  of the specification's scene, prepared; not looked at where there is a world
PreparedRun prepare_run(const DatabaseSpec& spec, const std::shared_ptr<const PreparedBody>& body,
                        std::int32_t run);

/// One run alone.
PreparedRun prepare_run(const DatabaseSpec& spec, std::int32_t run);

}  // namespace conchoid
