#pragma once

#include <stdexcept>
#include <string>

namespace conchoid {

/// The user's data are wrong: what is wrong, where (file, line, element) and what to do. Exit status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation could not be done although the input was acceptable (singular system, full disk). Exit
/// status 1.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C). What is finished has been kept.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace conchoid
