#pragma once

#include <vector>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/front/strip.hpp"

namespace conchoid {

/// Moved nodes of a curve joined into runs; every run becomes one new node. Nodes join where the new edge
/// between them is too short or turned round, or all of them where a ring closes (StripSettings).
class StripRuns {
 public:
  StripRuns(const TriMesh& mesh, const StripCurve& curve, const std::vector<Vec3>& target,
            const std::vector<bool>& moved, const StripSettings& settings);

  std::size_t run(std::size_t i) const { return run_[i]; }
  bool merged(std::size_t i) const { return members_[run_[i]] > 1; }
  const Vec3& position(std::size_t i) const { return position_[run_[i]]; }
  bool pinned(std::size_t i) const { return pinned_[run_[i]]; }

 private:
  std::size_t next(std::size_t i) const { return next_index(i, run_.size(), curve_.closed); }
  std::size_t edges() const { return edge_count(run_.size(), curve_.closed); }
  bool shrinks() const;
  bool closes() const;
  void merge_all();
  void merge_short_edges();
  bool too_short(std::size_t i, std::size_t j) const;
  void merge(std::size_t a, std::size_t b);

  const TriMesh& mesh_;
  const StripCurve& curve_;
  const std::vector<Vec3>& target_;
  const std::vector<bool>& moved_;
  const StripSettings& settings_;
  std::vector<std::size_t> run_;
  std::vector<std::size_t> members_;
  std::vector<Vec3> position_;
  std::vector<bool> pinned_;
};

}  // namespace conchoid
