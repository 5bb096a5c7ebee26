#pragma once

#include <memory>
#include <span>
#include <vector>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/bem/contact.hpp"
#include "conchoid/bem/crack_system.hpp"
#include "conchoid/bem/interior_stress.hpp"
#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

class RowStore;

/// Stress [Pa] in the two faces of a crack; its traction part is the same in both.
struct CrackFaceStress {
  Mat3 plus, minus;  ///< on the side the crack's normal points to, and on the other
};

/// An elastic body with cracks under a load, by the symmetric Galerkin boundary element method
/// (docs/theory.md §2–4).
/// The uncracked body is a BodyOperator, which many cracked bodies may share; with quadratic elements (BemSettings)
/// loads come as fields, as_field(). A crack adds unknowns at the end
/// of its system, and when it grows only what is new is assembled: functions whose support did not change are
/// recognised and kept.
///
///   auto body = make_body_operator(surface, data, material);
///   CrackedBody cracked(body, load_case(surface, data));
///   cracked.set_crack(corefine(surface, sheet, {.merge = 0.1}));
///   cracked.solve();
///   cracked.opening()[node]              // Δu = u⁺ − u⁻ at the nodes of the cut complex
///   cracked.set_load(another);           // no matrix is touched
///   cracked.solve();
class CrackedBody {
 public:
  /// A body without a crack. Errors: InputError when the load does not fit the operator.
  CrackedBody(std::shared_ptr<const BodyOperator> body, LoadCase load);
  ~CrackedBody();
  CrackedBody(CrackedBody&&) noexcept;
  CrackedBody& operator=(CrackedBody&&) noexcept;

  /// Where the rows of set_crack() are looked for before they are integrated, and kept after; must outlive
  /// the body. None at first.
  void keep_rows(RowStore* store);
  /// Replaces the crack. Errors: SingularSystem when a piece has come off.
  /// @param division  of the surface before it was cut; empty: none
  void set_crack(const CutComplex& cut, const CutDivision& division = {});
  /// Replaces the load, on body and crack; call solve() before anything is read. Errors: InputError when it
  /// does not fit; the load is then as before.
  void set_load(LoadCase load);
  /// Finds opening, displacement and traction; contact() says whether the faces were kept apart.
  void solve();
  /// Openings of several loads on the crack as it stands, as set_load() and solve() would give them; the
  /// body's own load and solution stay.
  std::vector<IdVector<NodeId, Vec3>> openings(std::span<const LoadCase> loads);

  const BodyOperator& body() const;
  const LoadCase& load() const;

  /// Full opening Δu [m] per node of the cut complex; zero on the front and off the crack.
  const IdVector<NodeId, Vec3>& opening() const;
  /// Displacement [m] of the surface's nodes (mean of the two sides at a mouth; up to a rigid motion if
  /// nothing is held).
  IdVector<NodeId, Vec3> displacement() const;
  /// Traction [Pa] per surface triangle.
  std::vector<Vec3> traction() const;
  /// Stress [Pa] per surface triangle, from displacement gradient and traction; mean over its pieces where
  /// the crack cuts it.
  std::vector<Mat3> surface_stress() const;
  /// Stress [Pa] at points inside the body and off the crack.
  std::vector<Mat3> interior_stress(std::span<const Vec3> points) const;
  Mat3 interior_stress(const Vec3& point) const { return interior_stress(std::span(&point, 1))[0]; }
  /// Stress in both faces of some triangles of the cut complex's sheet, at their centroids. Meant for
  /// triangles away from the front, where it is singular. docs/theory.md (T3)
  std::vector<CrackFaceStress> crack_face_stress(const std::vector<TriId>& pieces) const;
  const AppendStatistics& statistics() const;
  /// How the last solve() ended where faces touch.
  const ContactReport& contact() const;
  /// ½ fᵀx [J], up to a part that depends on the load alone: how it changes with the crack is the energy that
  /// growth releases under constant load.
  double energy() const;

 private:
  std::vector<LoadedPanel> loaded_panels() const;
  std::vector<QuadraticLoadedPanel> quadratic_panels() const;
  std::vector<Mat3> stress_on_pieces() const;
  std::vector<Mat3> stress_inside(std::span<const Vec3> points) const;
  struct State;
  std::unique_ptr<State> state_;
};

/// Operator and load of a body that is used once.
CrackedBody make_cracked_body(TriMesh surface, const BoundaryData& data, const ElasticConstants& m,
                              AmbientField ambient = {}, const BemSettings& settings = {});

}  // namespace conchoid
