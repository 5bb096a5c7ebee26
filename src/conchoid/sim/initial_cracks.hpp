#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// Sheet of a crack as the scene gives it, in its coordinates. @param edge  wanted [m], unless it names a
/// number of triangles. Throws InputError for a mesh file that is no sheet.
TriMesh crack_sheet(const CrackSpec& spec, double edge);

/// Boundary edges that lie on the surface are the mouth: the sheet's nodes there are drawn out beyond it, so
/// that it cuts the surface cleanly and none of its nodes lies in the surface. Nothing for a sheet outside of the body.
std::optional<TriMesh> sheet_if_in_body(const TriMesh& sheet, const TriMesh& surface);
/// The same; throws InputError, at `where`, for a sheet outside of the body.
TriMesh sheet_in_body(const TriMesh& sheet, const TriMesh& surface, const std::string& where);

}  // namespace conchoid
