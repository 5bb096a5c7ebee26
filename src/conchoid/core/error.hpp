#pragma once

#include <stdexcept>
#include <string>

namespace conchoid {

/// The user's data are wrong: what is wrong, where (file, line, element) and what to do. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation could not be done although the input was acceptable (singular system). Exit status 1.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What was computed could not be written: mostly a full disk. Exit status 1. No ComputationError: who copes with one of those
/// (a frame, a piece, an experiment that cannot be computed) does not take it for that.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The boundary elements of a body and its cracks give no system that can be solved: mostly a piece has come
/// off or hangs by a ligament too thin to resolve, or a crack runs along the surface mesh. Where earlier
/// frames are worth having, a run ends here and keeps them.
class SingularSystem : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// The user asked to stop (Ctrl-C). What is finished has been kept.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace conchoid
