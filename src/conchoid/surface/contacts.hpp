#pragma once

#include <vector>

#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Two pieces that lie against each other.
struct FragmentContact {
  std::size_t first = 0, second = 0;  ///< indices, first < second
  double area = 0;                    ///< of the fracture between them, one side of it [m²]
};

/// Which pieces share which fracture area, in the order (first, second). Faces of a sheet triangle that look
/// at each other overlap where both pieces were there: how either side has been cut further does not matter.
/// A slit within one piece is no contact.
std::vector<FragmentContact> fragment_contacts(const std::vector<Fragment>& fragments);

/// Area that two triangles have in common, both taken as lying in the plane with this unit normal.
double common_area(const Triangle& a, const Triangle& b, const Vec3& normal);

}  // namespace conchoid
