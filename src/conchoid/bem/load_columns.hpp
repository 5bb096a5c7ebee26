#pragma once

#include <compare>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "conchoid/bem/body_entries.hpp"
#include "conchoid/bem/load_case.hpp"
#include "conchoid/core/byte_cache.hpp"
#include "conchoid/core/bytes.hpp"

namespace conchoid {

enum class Prescribed : unsigned char { traction, displacement };

/// A place where a value is prescribed: a triangle's traction, or a node's displacement.
struct LoadSource {
  Prescribed kind;
  std::size_t index;
  friend auto operator<=>(const LoadSource&, const LoadSource&) = default;
};

/// Where a load case is not zero: triangles, then nodes.
std::vector<LoadSource> sources_of(const LoadCase& load);
Vec3 value_at(const LoadCase& load, const LoadSource& source);

/// What the values of each source contribute to the right-hand side of the uncracked body,
///   f_D = −V g_N + (½M + K) g_D      per unknown traction
///   f_N = (½M − Kᵀ) g_N − D g_D      per unknown displacement                         docs/theory.md (B1)
/// in the directions that are unknown (g_N prescribed traction, g_D displacement, M the mass matrix between the
/// two). The three columns of a
/// source are integrated when it first occurs and kept: a load on the same places costs no integration,
/// another place costs its own pairs only. 24 bytes per source and unknown component. Safe to use from
/// several threads.
class LoadColumns {
 public:
  explicit LoadColumns(const BodyEntries& entries) : entries_(entries) {}

  /// f_D, then f_N: as long as the unknowns.
  std::vector<double> right_hand_side(const LoadCase& load);
  std::size_t bytes() const;

  /// Columns as they are in memory, and back: what is taken stays where it is.
  void put(ByteWriter& out) const;
  void take(const KeptBytes& kept);

 private:
  std::vector<double> integrate(const LoadSource& source) const;
  std::vector<const double*> columns(std::span<const LoadSource> sources);
  void add_mass(const LoadCase& load, std::vector<double>& f) const;

  const BodyEntries& entries_;
  mutable std::mutex mutex_;
  std::map<LoadSource, std::shared_ptr<const double>> kept_;  // three columns, without ½M
};

}  // namespace conchoid
