#pragma once

/// The front door: what a program needs to break things. Everything is SI; errors are exceptions that say
/// what is wrong, where, and what to do.
///
///   Scene              what a scene file says; made by read_scene(), parse_scene() or field by field
///   Body               a body in memory: from a file, a model, or a Fragment of another
///   PreparedBody       a body under the conditions of a scene, assembled and factored once for many runs
///   LoadCase           values of the loads on it; many per body
///   Fracture           a prepared body that breaks, frame by frame: step() → StepReport, state in between
///   Breakup            the same, and its pieces after it, until nothing moves any more
///   FractureObserver   sees it happen
///   GrowthLaw          when, where to and how far cracks grow
///   Regressor          predicts how they open: load_regressor(), then a method of opening_methods()
///   Pieces, Fragment   what is left: closed meshes with mass, inertia and attributes
///   RunResult          a whole run at once: run_scene(), run_body()
///   ExecutionContext   threads, messages and stops of all that runs inside it
///   InputError, ComputationError, SingularSystem, Interrupted

#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/message_sink.hpp"
#include "conchoid/learn/regressor.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/load_report.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/pieces.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/run.hpp"
