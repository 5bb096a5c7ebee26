#include "conchoid/bem/contact.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace conchoid {
namespace {

constexpr double kPenetrationTolerance = 1e-6;  // of the largest opening

double normal_opening(const std::vector<double>& x, const OpeningConstraint& c) {
  return c.normal[0] * x[c.first] + c.normal[1] * x[c.first + 1] + c.normal[2] * x[c.first + 2];
}

// Columns S⁻¹ gᵢ, computed when a constraint first becomes active.
class Responses {
 public:
  Responses(std::size_t n, const std::vector<OpeningConstraint>& constraints,
            const std::function<void(double*, std::size_t)>& solve)
      : n_(n), constraints_(constraints), solve_(solve) {}

  const std::vector<double>& of(std::size_t i) {
    auto [entry, is_new] = columns_.try_emplace(i);
    if (is_new) {
      entry->second.assign(n_, 0.0);
      for (int k = 0; k < 3; ++k)
        entry->second[constraints_[i].first + k] = constraints_[i].normal[k];
      solve_(entry->second.data(), 1);
    }
    return entry->second;
  }

 private:
  std::size_t n_;
  const std::vector<OpeningConstraint>& constraints_;
  const std::function<void(double*, std::size_t)>& solve_;
  std::map<std::size_t, std::vector<double>> columns_;
};

// Pressures on the active constraints; those that pull are released until none does.
// @return x with the pressures on it
std::vector<double> press(const std::vector<double>& free_solution,
                          const std::vector<OpeningConstraint>& constraints, Responses& responses,
                          std::vector<char>& active) {
  while (true) {
    std::vector<std::size_t> set;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (active[i]) set.push_back(i);
    const auto k = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd compliance(k, k);
    Eigen::VectorXd gap(k);
    for (Eigen::Index a = 0; a < k; ++a) {
      gap[a] = -normal_opening(free_solution, constraints[set[a]]);
      for (Eigen::Index b = 0; b < k; ++b)
        compliance(b, a) = normal_opening(responses.of(set[a]), constraints[set[b]]);
    }
    const Eigen::VectorXd pressure = compliance.ldlt().solve(gap);  // no roots: the same bits in other units
    bool released = false;
    for (Eigen::Index a = 0; a < k; ++a)
      if (pressure[a] < 0) {
        active[set[a]] = 0;
        released = true;
      }
    if (released && k > 1) continue;
    std::vector<double> x = free_solution;
    for (Eigen::Index a = 0; a < k; ++a) {
      if (pressure[a] <= 0) continue;
      const std::vector<double>& response = responses.of(set[a]);
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += pressure[a] * response[i];
    }
    return x;
  }
}

}  // namespace

ContactReport close_penetrating_faces(std::vector<double>& x,
                                      const std::vector<OpeningConstraint>& constraints,
                                      const std::function<void(double*, std::size_t)>& solve,
                                      int most_sweeps) {
  const std::vector<double> free_solution = x;
  ContactReport report;
  for (const OpeningConstraint& c : constraints)
    for (int k = 0; k < 3; ++k)
      report.largest_opening = std::max(report.largest_opening, std::abs(x[c.first + k]));
  const double tolerance = kPenetrationTolerance * report.largest_opening;
  Responses responses(x.size(), constraints, solve);
  std::vector<char> active(constraints.size(), 0);
  while (true) {
    bool changed = false;
    report.penetration = 0;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      const double opening = normal_opening(x, constraints[i]);
      report.penetration = std::max(report.penetration, -opening);
      if (!active[i] && opening < -tolerance) active[i] = changed = true;
    }
    report.converged = !changed;
    if (!changed || report.sweeps == most_sweeps) return report;
    x = press(free_solution, constraints, responses, active);
    ++report.sweeps;
  }
}

std::string contact_warning(const ContactReport& report) {
  char text[256];
  std::snprintf(text, sizeof text,
                "contact: after %d sweeps the crack's faces still pass through each other by %.2g m (%.2g of "
                "the largest opening); where they touch, openings are uncertain by as much",
                report.sweeps, report.penetration, report.penetration / report.largest_opening);
  return text;
}

}  // namespace conchoid
