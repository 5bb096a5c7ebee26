#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/bordered_cholesky.hpp"
#include "conchoid/bem/crack_host.hpp"
#include "conchoid/bem/enrichment.hpp"

namespace conchoid {

class RowStore;

/// What the last set_crack() had to do.
struct AppendStatistics {
  std::size_t functions = 0;   ///< enrichment functions in the system
  std::size_t assembled = 0;   ///< of these, assembled anew
  std::size_t refactored = 0;  ///< of these, eliminated anew
};

/// The crack's border of the body's system: unknown coefficients a of the enrichment functions, beside the
/// body's unknowns x = (q, u).
///   | A  B | |x|   |f|       R = (K_aᵀ  D_au) one row per component of a, B = (−K_a ; D_ua)
///   | R  D | |a| = |g|       S = D − R A⁻¹ B ,   S a = g − R A⁻¹ f ,   x = A⁻¹ (f − B a)   docs/theory.md (B6)
/// A is only ever solved with, so any CrackHost will do, and by halves: with A⁻¹ = Pᵀ M P J (HalfSolver) and Yᵀ = P J B,
///   R A⁻¹ B = Y M Yᵀ ,   S a = g − Y z ,   x = Pᵀ (z − M Yᵀ a) ,   z = M P J f ,
/// where Y takes the place of R and each function's columns are solved with once, and half. S is symmetric positive definite; its Cholesky
/// factor grows and shrinks at its end with the crack.
/// Memory for m functions: 36 m² bytes for S, twice as much for its factor, 72 bytes per function and source,
/// 24 bytes per function and body unknown.
class CrackSystem {
 public:
  /// An enrichment function that is in the system.
  struct Function {
    EnrichmentKind kind;
    NodeId node;
    std::vector<double> key;
    DenseMatrix rows;            ///< 3 × body unknowns, of Y
    DenseMatrix sources;         ///< 3 × 3·sources
    DenseMatrix stiffness;       ///< 3 × 3·(functions up to this one), of S
    Vec3 normal = Vec3::Zero();  ///< of the crack, as far as it may open along it
    bool carries_opening() const { return kind != EnrichmentKind::hat; }
  };

  explicit CrackSystem(std::shared_ptr<const BodyOperator> body);

  /// Replaces the crack. Functions whose support did not change keep their rows, in the order they had; new
  /// ones come after them. Errors: SingularSystem when a piece has come off.
  /// @param store  may be null
  void set_crack(const CutComplex& cut, const CutDivision& division, RowStore* store);
  /// Makes the columns of sources that are not there yet, for every function.
  void need_sources(std::span<const LoadSource> sources);

  const CrackHost& host() const { return *host_; }
  const EnrichedSpace& space() const { return space_; }
  const std::vector<Function>& functions() const { return functions_; }
  std::size_t size() const { return 3 * functions_.size(); }
  /// Position in functions() of each function of the space.
  const std::vector<std::size_t>& position() const { return position_; }
  const AppendStatistics& statistics() const { return statistics_; }

  /// g: the crack's own right-hand side, whose sources must be there.
  std::vector<double> right_hand_side(const LoadCase& load) const;
  /// g − Y z.
  void subtract_load(const double* z, std::vector<double>& g) const;
  /// x = Pᵀ (z − M Yᵀ a).
  std::vector<double> body_unknowns(std::vector<double> z, const std::vector<double>& a) const;
  /// S⁻¹ in place.
  void solve(double* b, std::size_t count = 1) const { factor_.solve(b, count); }

 private:
  struct Plan;
  Plan plan_replacement() const;
  void append(const Plan& plan, std::vector<EnrichmentRows> rows);
  std::vector<double> rows_of(std::size_t first, std::size_t last) const;
  void reduce_rows(std::size_t first);
  void keep_stiffness(const Plan& plan, std::size_t i);
  DenseMatrix couplings(std::size_t first) const;
  void eliminate();

  std::shared_ptr<const BodyOperator> body_;
  std::unique_ptr<const CrackHost> host_;
  EnrichedSpace space_;
  PairMemory pairs_;
  std::vector<LoadSource> sources_;
  std::vector<Function> functions_;
  std::vector<std::size_t> position_;
  BorderedCholesky factor_;
  std::size_t factored_ = 0;  // functions eliminated
  AppendStatistics statistics_;
};

}  // namespace conchoid
