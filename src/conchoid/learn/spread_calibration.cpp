#include "conchoid/learn/spread_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kMostGroups = 10, kLeastSamples = 50;  // of a group

bool is_positive(double x) {
  return x > 0 && std::isfinite(x);
}

}  // namespace

SpreadCalibration::SpreadCalibration(std::vector<Knot> knots) : knots_(std::move(knots)) {
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const bool rises =
        i == 0 || (knots_[i].stated > knots_[i - 1].stated && knots_[i].found >= knots_[i - 1].found);
    if (!is_positive(knots_[i].stated) || !is_positive(knots_[i].found) || !rises)
      throw InputError("the calibration of the spread does not rise");
  }
}

SpreadCalibration SpreadCalibration::measure(std::span<const double> stated, std::span<const double> errors) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < stated.size(); ++i)
    if (is_positive(stated[i])) order.push_back(i);
  if (order.size() < kLeastSamples)
    throw InputError(
        fmt::format("a calibration needs at least {} samples of which a spread is stated, there are {}; "
                    "give more runs",
                    kLeastSamples, order.size()));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stated[a] < stated[b]; });
  const std::size_t groups = std::min(kMostGroups, order.size() / kLeastSamples);
  std::vector<Knot> knots;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t begin = g * order.size() / groups, end = (g + 1) * order.size() / groups;
    double of_stated = 0, of_errors = 0;
    for (std::size_t k = begin; k < end; ++k) {
      of_stated += stated[order[k]] * stated[order[k]];
      of_errors += errors[order[k]] * errors[order[k]];
    }
    const auto count = static_cast<double>(end - begin);
    Knot knot{std::sqrt(of_stated / count), std::sqrt(of_errors / count)};
    if (!knots.empty()) knot.found = std::max(knot.found, knots.back().found);
    const bool rises = knots.empty() || knot.stated > knots.back().stated;
    if (rises && knot.found > 0) knots.push_back(knot);
  }
  if (knots.empty())
    throw InputError("a calibration needs samples that the regressor errs on; there are none");
  return SpreadCalibration(std::move(knots));
}

double SpreadCalibration::operator()(double stated) const {
  if (empty() || !(stated > 0)) return stated;
  if (stated <= knots_.front().stated) return knots_.front().found;
  if (stated >= knots_.back().stated) return knots_.back().found * (stated / knots_.back().stated);
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), stated,
                                     [](double x, const Knot& knot) { return x < knot.stated; });
  const Knot &a = *(next - 1), &b = *next;
  const double t = std::log(stated / a.stated) / std::log(b.stated / a.stated);
  return a.found * std::pow(b.found / a.found, t);
}

}  // namespace conchoid
