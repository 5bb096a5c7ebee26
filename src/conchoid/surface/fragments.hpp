#pragma once

#include <optional>
#include <vector>

#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

enum class FaceKind : std::uint8_t { original, fracture };

/// Cracks that end in a piece. Its mesh shows them as slits: pairs of coincident faces.
struct UnfinishedCracks {
  std::vector<TriMesh> sheets;  ///< boundary element meshes; they may stick out of the piece
  TriMesh solid;  ///< the piece's surface without the slits; without triangles if there are none
  std::vector<TriId> solid_face;  ///< per triangle of `solid`: that of the piece's mesh
};

/// One piece of the broken body: closed, oriented outward. Inertia for density 1 kg/m³ is not kept: multiply
/// by ρ beforehand.
struct Fragment {
  TriMesh mesh;
  std::vector<FaceKind> face_kind;  ///< per triangle
  std::vector<TriId> source;  ///< per triangle: triangle of the input surface (original) or of the sheets
                              ///< (fracture), counted through all sheets in their order
  double volume = 0;          ///< [m³]
  double mass = 0;            ///< [kg]
  Vec3 center_of_mass = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass [kg m²]
  bool watertight = false;
  SurfaceAttributes
      attributes;  ///< normals, texture coordinates, materials: empty before transfer_attributes()
  UnfinishedCracks unfinished = {};  ///< empty in pieces read from files
};

struct FragmentSettings {
  double density = 1000;  ///< kg/m³
  double minimum_volume_fraction =
      1e-4;  ///< pieces below this share of the body's volume join the neighbour they share most area with
  std::size_t maximum_count =
      0;  ///< the smallest pieces are joined likewise until there are so few; 0: all stay
};

/// What a cut finds on its way.
struct CutFindings {
  std::optional<TriMesh> inside;  ///< of the sheet: its part inside of the body; none of several sheets
};

/// Cuts a closed surface by crack sheets (fine meshes; they may stick out of the body and stop at each other)
/// into watertight pieces, largest first. A sheet, or a part of one, that does not separate leaves a slit: a
/// pair of coincident fracture faces, tagged and visible (open_slits() draws them apart). Triangles lower
/// than 3·10⁻⁴ of a sheet's mean edge are taken out of its cut where that can be (remove_slivers()).
std::vector<Fragment> cut_into_fragments(const TriMesh& surface, const std::vector<TriMesh>& sheets,
                                         const FragmentSettings& settings, CutFindings* findings = nullptr);

/// Cuts the pieces of a body once more, but only where the surface parts one of them: what of it would be a slit is
/// left out.
/// @param first_triangle  number of its first triangle among the sources of the faces
std::vector<Fragment> part_fragments(const std::vector<Fragment>& pieces, const TriMesh& surface,
                                     std::size_t first_triangle, const FragmentSettings& settings);

}  // namespace conchoid
