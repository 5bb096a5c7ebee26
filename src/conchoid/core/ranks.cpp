#include "conchoid/core/ranks.hpp"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <thread>

#include "conchoid/core/interrupt.hpp"

namespace conchoid {
namespace {

constexpr std::chrono::milliseconds kBetweenPolls{2};

template <class Function>
Function* function(const char* name) {
  return module_function<Function>(kRanksModule, name, "a job of several ranks cannot be joined");
}

}  // namespace

bool Ranks::launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1) return true;
  return false;
}

Ranks::Ranks()
    : exceptions_(std::uncaught_exceptions()),
      send_(function<RanksSend>("conchoid_ranks_send")),
      poll_(function<RanksPoll>("conchoid_ranks_poll")) {
  function<RanksBegin>("conchoid_ranks_begin")(rank_, size_);
}

Ranks::~Ranks() {
  if (std::uncaught_exceptions() == exceptions_) function<RanksEnd>("conchoid_ranks_end")();
}

void Ranks::send(int to, const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  send_(to, bytes);
}

std::optional<Ranks::Message> Ranks::poll() {
  const std::lock_guard lock(mutex_);
  Message message{-1, {}};
  if (!poll_(message.from, message.bytes)) return std::nullopt;
  return message;
}

Ranks::Message Ranks::receive() {
  for (;;) {
    if (std::optional<Message> message = poll()) return *std::move(message);
    throw_if_interrupted();
    std::this_thread::sleep_for(kBetweenPolls);
  }
}

}  // namespace conchoid
