#include "conchoid/learn/exclusion.hpp"

#include <sstream>

namespace conchoid {

std::string exclusion_reason(const RunSummary& run, const ExclusionSettings& settings) {
  std::ostringstream reason;
  if (run.alpha > settings.alpha_limit)
    reason << "force near 90 degrees: alpha = " << run.alpha << " > " << settings.alpha_limit;
  else if (run.cracks == 0)
    reason << "no crack started";
  else if (!run.stopped || run.frames > settings.frame_limit)
    reason << "did not stop within " << settings.frame_limit << " frames";
  else if (run.cracks >= settings.many_cracks && run.largest_growth < settings.tiny_growth * run.resolution)
    reason << "only tiny cracks: " << run.cracks << " cracks, none grew by " << settings.tiny_growth
           << " crack edges";
  return reason.str();
}

}  // namespace conchoid
