#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <string_view>

namespace conchoid {

/// Why a run ended.
enum class StopReason {
  arrested,     ///< no front can move
  separated,    ///< the body has come apart
  frame_limit,  ///< the wanted number of frames is reached
  intact,       ///< nothing cracked
  singular,     ///< a later frame could not be solved: mostly a piece hangs by a ligament too thin to resolve
  interrupted   ///< on request; what was computed is kept
};

inline constexpr std::array kStopReasons = {StopReason::arrested,    StopReason::separated,
                                            StopReason::frame_limit, StopReason::intact,
                                            StopReason::singular,    StopReason::interrupted};

/// As in run.json: "arrested", "separated", "frame-limit", …
constexpr std::string_view name(StopReason reason) {
  switch (reason) {
    case StopReason::arrested:
      return "arrested";
    case StopReason::separated:
      return "separated";
    case StopReason::frame_limit:
      return "frame-limit";
    case StopReason::intact:
      return "intact";
    case StopReason::singular:
      return "singular";
    case StopReason::interrupted:
      break;
  }
  return "interrupted";
}

/// The reason of that name, or none.
constexpr std::optional<StopReason> stop_reason_from_name(std::string_view text) {
  for (const StopReason reason : kStopReasons)
    if (name(reason) == text) return reason;
  return std::nullopt;
}

/// Whether more frames could follow: the run was stopped and did not end by itself.
constexpr bool may_go_on(StopReason reason) {
  return reason == StopReason::frame_limit || reason == StopReason::interrupted;
}

std::ostream& operator<<(std::ostream& out, StopReason reason);

}  // namespace conchoid
