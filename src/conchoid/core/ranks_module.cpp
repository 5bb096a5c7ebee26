#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include "conchoid/core/ranks_module.hpp"

#include <mpi.h>

#include <limits>
#include <type_traits>

#include "conchoid/core/error.hpp"

// A failure in here ends the job: MPI's own way with errors.

namespace {

constexpr int kTag = 0;

}  // namespace

CONCHOID_MODULE_FUNCTION void conchoid_ranks_begin(int& rank, int& size) {
  static_assert(std::is_same_v<decltype(conchoid_ranks_begin), conchoid::RanksBegin>);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED)
    throw conchoid::InputError("this MPI does not allow several threads; use one that was built for them");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
}

CONCHOID_MODULE_FUNCTION void conchoid_ranks_send(int to, const std::string& bytes) {
  static_assert(std::is_same_v<decltype(conchoid_ranks_send), conchoid::RanksSend>);
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw conchoid::ComputationError("a message between ranks is longer than 2 GiB");
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, kTag, MPI_COMM_WORLD);
}

CONCHOID_MODULE_FUNCTION bool conchoid_ranks_poll(int& from, std::string& bytes) {
  static_assert(std::is_same_v<decltype(conchoid_ranks_poll), conchoid::RanksPoll>);
  int found = 0, count = 0;
  MPI_Status status;
  MPI_Iprobe(from < 0 ? MPI_ANY_SOURCE : from, kTag, MPI_COMM_WORLD, &found, &status);
  if (found == 0) return false;
  MPI_Get_count(&status, MPI_BYTE, &count);
  bytes.resize(static_cast<std::size_t>(count));
  from = status.MPI_SOURCE;
  MPI_Recv(bytes.data(), count, MPI_BYTE, from, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return true;
}

CONCHOID_MODULE_FUNCTION void conchoid_ranks_end() {
  static_assert(std::is_same_v<decltype(conchoid_ranks_end), conchoid::RanksEnd>);
  MPI_Finalize();
}
