#pragma once

#include <array>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A point where a crack may start: a triangle of the body's surface, or a face of a crack, under its largest
/// principal stress.
struct InitiationCandidate {
  Vec3 position;            ///< centroid of the triangle [m]
  double principal_stress;  ///< σ₁ [Pa], tension positive
  Vec3 direction;           ///< unit, of σ₁; its sign does not matter
  Vec3 inward_normal;       ///< unit, into the body
  double strength;          ///< S_c [Pa] there
  TriId triangle;           ///< decides between equals, the lowest first
  std::array<Vec3, 3>
      corners;  ///< of the triangle, in ascending order of their node ids: fixes signs (see CrackSite)
  double remoteness = 0;  ///< [m] of two equally severe candidates the one with less of it goes first
                          ///< (differences below 1e-6 do not count), e.g. the distance from the body's centre
  bool on_crack = false;  ///< on a face of a crack: what starts there is a branch
};

/// A new crack: a disc normal to σ₁, around a point of the body's surface; a branch starts beneath the face
/// of its crack, whole but so close that its near side runs into the face with the first advance. Signs come
/// from the triangle alone, so that they turn and mirror with the body: `normal` is ±direction with the first
/// of corner₀ − position, corner₁ − position, inward normal that it is not perpendicular to (1e-6) on its
/// positive side; `side` likewise. `inward` is the inward surface normal in the disc's plane; where the disc
/// lies along the surface (σ₁ normal to it) the direction of the first corner takes its place.
struct CrackSite {
  TriId triangle;
  Vec3 center;      ///< a tenth of the radius outside of the surface; of a branch 1.15 radii within
  Vec3 normal;      ///< unit
  Vec3 inward;      ///< unit, ⟂ normal, into the body
  Vec3 side;        ///< unit, ⟂ both: normal × inward or its opposite
  double radius;    ///< r̄ [m]
  double severity;  ///< σ₁ / S_c
};

struct InitiationSettings {
  double resolution = 0;  ///< r̄ [m]
  double min_distance =
      0;                 ///< from existing crack nodes (branches: from front nodes), and between new ones [m]
  std::size_t most = 1;  ///< new cracks at this call
};

/// Where cracks start: σ₁ > S_c, in order of σ₁/S_c. Candidates within 0.1 % of the largest one left count as
/// equal, then the lowest triangle id goes first: round-off cannot change the choice.
/// A branch also has its centre no closer than 0.95 radii to any crack node.
/// @param crack_nodes  nodes of the cracks that are there
/// @param front_nodes  of these, the ones on fronts
std::vector<CrackSite> choose_sites(const std::vector<InitiationCandidate>& candidates,
                                    const std::vector<Vec3>& crack_nodes, const InitiationSettings& settings,
                                    const std::vector<Vec3>& front_nodes = {});

/// The disc: two rings of triangles (24, edges ≈ r̄/2), one node at the centre on the surface so that about
/// half of it sticks out; mirror-symmetric about the plane of `normal` and `inward`, oriented along `normal`.
/// Node ids run from `inward` towards `side`.
TriMesh disc_sheet(const CrackSite& site);

}  // namespace conchoid
