#include "conchoid/sim/load_report.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace conchoid {
namespace {

std::optional<double> largest_ratio(const std::vector<FrontDecision>& decisions) {
  std::optional<double> largest;
  for (const FrontDecision& d : decisions)
    largest = std::max(largest.value_or(0), d.drive / d.toughness);
  return largest;
}

StressPeak largest_stress(const Fracture& fracture) {
  if (!fracture.solved()) return {};
  return conchoid::largest_stress(fracture.body(), fracture.crack(), fracture.solution());
}

}  // namespace

std::optional<LoadReport::Peak> LoadReport::peak(const Fracture& fracture, const StressPeak& stress) {
  if (!(stress.ratio > 0)) return std::nullopt;
  return Peak{stress.ratio, stress.position + fracture.body().origin};
}

std::string LoadReport::text(const Peak& peak) {
  return fmt::format("{:.3g} times the strength, at ({:.4g}, {:.4g}, {:.4g})", peak.ratio, peak.position[0],
                     peak.position[1], peak.position[2]);
}

void LoadReport::on_opening(const Fracture& fracture) {
  last_K_ = largest_ratio(fracture.decisions());
  apart_ = false;
  if (fracture.frame() > 1 || fracture.new_cracks() > 0) return;
  first_K_ = last_K_;
  stress_ = peak(fracture, largest_stress(fracture));
}

void LoadReport::on_step(const Fracture& fracture, const StepReport& step) {
  if (step.frame <= 1 && !stress_ && step.new_cracks > 0) stress_ = peak(fracture, step.start);
  new_cracks_ += step.new_cracks;
  if (!step.stop) return;
  apart_ = step.stop == StopReason::separated;
  if (!apart_ && last_K_) resting_K_ = std::max(resting_K_.value_or(0), *last_K_);
  cut_through_ = step.stop == StopReason::arrested && fracture.crack().fronts.empty();
  if (step.stop == StopReason::arrested) stress_left_ = peak(fracture, largest_stress(fracture));
  if (step.stop == StopReason::intact && fracture.settings().max_cracks > 0)
    stress_ = peak(fracture, largest_stress(fracture));
}

std::optional<double> LoadReport::stress_over_strength() const {
  return stress_ ? std::optional(stress_->ratio) : std::nullopt;
}

std::optional<double> LoadReport::largest_K_over_Kc() const {
  if (apart_) return resting_K_ ? resting_K_ : last_K_;
  return last_K_ && resting_K_ ? std::max(last_K_, resting_K_) : last_K_ ? last_K_ : resting_K_;
}

bool LoadReport::all_cracks_used(const RunSpec& run) const {
  return new_cracks_ >= static_cast<std::size_t>(run.max_cracks);
}

std::vector<std::string> LoadReport::warnings(StopReason stop, const RunSpec& run) const {
  std::vector<std::string> out;
  const std::string advice =
      ": at such an overload cracks would start all over the body at once; lower the load for a fracture "
      "that "
      "can be trusted";
  if (stress_ && stress_->ratio > kOverload)
    out.push_back("the largest stress is " + text(*stress_) + advice);
  else if (first_K_ && *first_K_ > kOverload)
    out.push_back(fmt::format("the largest K of the initial cracks is {:.3g} times K_c", *first_K_) + advice);
  if (stop == StopReason::arrested && cut_through_)
    out.push_back(fmt::format("the crack has cut through, and the body hangs together elsewhere: {} (now {})",
                              all_cracks_used(run) ? "raise run.max_cracks, and it can break there, too"
                                                   : "run.max_cracks allows more, but the stress is below "
                                                     "the strength",
                              run.max_cracks));
  return out;
}

std::string LoadReport::details(StopReason stop, const RunSpec& run) const {
  if (stop == StopReason::intact)
    return stress_
               ? "the largest stress is " + text(*stress_)
               : fmt::format("there is no crack, and run.max_cracks = {} lets none start", run.max_cracks);
  if (stop != StopReason::arrested) return {};
  std::string out = cut_through_
                        ? "no crack has a front any more"
                        : fmt::format("the largest K is {:.3g} times K_c", largest_K_over_Kc().value_or(0));
  if (stress_left_ && stress_left_->ratio > 1 && all_cracks_used(run))
    out += "; the stress is " + text(*stress_left_) +
           fmt::format(", but run.max_cracks = {} lets no more cracks start", run.max_cracks);
  return out;
}

}  // namespace conchoid
