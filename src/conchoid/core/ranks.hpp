#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "conchoid/core/ranks_module.hpp"

namespace conchoid {

/// The processes of one job, started together by mpirun, this one among them. They send each other bytes; those of
/// one sender arrive in their order. At most one object in the life of a process. All may be called from several threads.
class Ranks {
 public:
  /// Whether a launcher of MPI started this process as one of several; it says so in the environment.
  static bool launched();

  /// Joins the job. Throws InputError in a build without MPI.
  Ranks();
  /// Leaves the job, once all others do. While an exception ends this process it does not: the launcher ends the others
  /// then, which would wait for ever.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }  ///< of this process, from 0
  int size() const { return size_; }

  void send(int to, const std::string& bytes);

  struct Message {
    int from = 0;
    std::string bytes;
  };
  /// The next message that has arrived, if there is one.
  std::optional<Message> poll();
  /// Waits for it. Throws Interrupted after Ctrl-C.
  Message receive();

 private:
  int rank_ = 0, size_ = 1, exceptions_;
  std::mutex mutex_;
  RanksSend* send_;
  RanksPoll* poll_;
};

}  // namespace conchoid
