#include "conchoid/bem/contact.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/progress.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace conchoid {
namespace {

constexpr double kPenetrationTolerance = 1e-6;  // of the largest opening
constexpr int kBlockTries = 10;  // exchanges of all nodes of the wrong sign that do not reduce their number

double normal_opening(const double* x, const OpeningConstraint& c) {
  return c.normal[0] * x[c.first] + c.normal[1] * x[c.first + 1] + c.normal[2] * x[c.first + 2];
}

// The openings under forces on closed nodes.
class ClosedFaces {
 public:
  ClosedFaces(const std::vector<double>& free_solution, const std::vector<OpeningConstraint>& constraints,
              const std::function<void(double*, std::size_t)>& solve)
      : free_(free_solution),
        constraints_(constraints),
        solve_(solve),
        responses_(constraints.size()),
        force_(constraints.size(), 0.0),
        opening_(constraints.size()) {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      opening_[i] = normal_opening(free_.data(), constraints[i]);
  }

  double force(std::size_t i) const { return force_[i]; }
  double opening(std::size_t i) const { return opening_[i]; }

  // Forces that keep the closed nodes closed, of either sign; openings of all others.
  void press(const std::vector<char>& closed) {
    set_.clear();
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (closed[i]) set_.push_back(i);
    need_responses();
    const auto k = static_cast<Eigen::Index>(set_.size());
    Eigen::MatrixXd compliance(k, k);
    Eigen::VectorXd gap(k);
    for (Eigen::Index a = 0; a < k; ++a) {
      gap[a] = -normal_opening(free_.data(), constraints_[set_[a]]);
      for (Eigen::Index b = 0; b < k; ++b)
        compliance(b, a) = normal_opening(responses_[set_[a]].data(), constraints_[set_[b]]);
    }
    const Eigen::VectorXd force = compliance.ldlt().solve(gap);  // no roots: the same bits in other units
    std::fill(force_.begin(), force_.end(), 0.0);
    for (Eigen::Index a = 0; a < k; ++a)
      force_[set_[a]] = force[a];
    for (std::size_t i = 0; i < constraints_.size(); ++i) {
      opening_[i] = normal_opening(free_.data(), constraints_[i]);
      for (const std::size_t j : set_)
        opening_[i] += force_[j] * normal_opening(responses_[j].data(), constraints_[i]);
    }
  }

  // Faces that pull by round-off do not count.
  std::vector<double> solution() const {
    std::vector<double> x = free_;
    for (const std::size_t j : set_)
      if (force_[j] > 0)
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] += force_[j] * responses_[j][i];
    return x;
  }

 private:
  // Columns S⁻¹ gᵢ of the nodes that close for the first time, all at once.
  void need_responses() {
    std::vector<std::size_t> missing;
    for (const std::size_t i : set_)
      if (responses_[i].empty()) missing.push_back(i);
    const std::size_t n = free_.size();
    std::vector<double> columns(n * missing.size(), 0.0);
    for (std::size_t m = 0; m < missing.size(); ++m)
      for (int k = 0; k < 3; ++k)
        columns[m * n + constraints_[missing[m]].first + k] = constraints_[missing[m]].normal[k];
    if (!missing.empty()) solve_(columns.data(), missing.size());
    for (std::size_t m = 0; m < missing.size(); ++m)
      responses_[missing[m]].assign(columns.begin() + m * n, columns.begin() + (m + 1) * n);
  }

  const std::vector<double>& free_;
  const std::vector<OpeningConstraint>& constraints_;
  const std::function<void(double*, std::size_t)>& solve_;
  std::vector<std::vector<double>> responses_;  // per constraint; empty where it never closed
  std::vector<double> force_, opening_;
  std::vector<std::size_t> set_;  // closed, ascending
};

// Nodes of the wrong sign: open but through each other, or closed but pulling; ascending.
struct WrongNodes {
  std::vector<std::size_t> beyond_tolerance;
  std::vector<std::size_t> all;
};

WrongNodes wrong_nodes(const ClosedFaces& faces, const std::vector<char>& closed, double tolerance) {
  WrongNodes wrong;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (closed[i] ? faces.force(i) < 0 : faces.opening(i) < 0) wrong.all.push_back(i);
    if (closed[i] ? faces.force(i) < 0 : faces.opening(i) < -tolerance) wrong.beyond_tolerance.push_back(i);
  }
  return wrong;
}

// Exchanges all nodes of the wrong sign, or one.
class Pivots {
 public:
  void exchange(const WrongNodes& wrong, std::vector<char>& closed) {
    if (wrong.beyond_tolerance.size() < fewest_) {
      fewest_ = wrong.beyond_tolerance.size();
      blocks_left_ = kBlockTries;
    } else if (blocks_left_ > 0) {
      --blocks_left_;
    }
    if (blocks_left_ == 0) {
      closed[wrong.all.back()] = !closed[wrong.all.back()];
      return;
    }
    for (const std::size_t i : wrong.beyond_tolerance)
      closed[i] = !closed[i];
  }

 private:
  std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
  int blocks_left_ = kBlockTries;
};

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
  ClosedFaces faces(free_solution, constraints, solve);
  std::vector<char> closed(constraints.size(), 0);
  Pivots pivots;
  Progress progress("sweeps of contact, at most", static_cast<std::size_t>(std::max(0, most_sweeps)));
  while (true) {
    throw_if_interrupted();
    report.penetration = 0;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (!closed[i]) report.penetration = std::max(report.penetration, -faces.opening(i));
    const WrongNodes wrong = wrong_nodes(faces, closed, tolerance);
    report.converged = wrong.beyond_tolerance.empty();
    if (report.converged || report.sweeps == most_sweeps) break;
    pivots.exchange(wrong, closed);
    faces.press(closed);
    ++report.sweeps;
    progress.advance();
  }
  x = faces.solution();
  return report;
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
