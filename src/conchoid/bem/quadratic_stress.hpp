#pragma once

#include "conchoid/bem/quadratic_body.hpp"

namespace conchoid {

/// Stress [Pa] on the surface at barycentric coordinates of a triangle, the load's ambient field included: (T1) with
/// the gradient of the quadratic displacement there.
Mat3 surface_stress(const QuadraticSolution& solution, TriId triangle, const Vec3& barycentric);

/// Corner values of the linear function that has the gradient of a quadratic one, given in its six nodes, at
/// barycentric coordinates l: Σ u_k ∂φ_k/∂N_j.
std::array<Vec3, 3> tangent_of(const std::array<Vec3, 6>& u, const Vec3& l);

/// A solution as a field that is known all over the body: loads on cracks are its tractions there (B7), so that a crack
/// may be put into a body, of linear or quadratic elements, and feel what the quadratic ones computed.
/// Stress: on the surface as above; inside (T2) of what is left when the linear displacement that touches the solution
/// in the nearest point of the surface is taken off; nearer to the surface than 1/50 of its elements, between the two.
/// Displacement: exact on the surface, inside by that linear one. What was computed is kept, by place.
AmbientField field_of(QuadraticSolution solution);

/// A load on a body of quadratic elements as its solution, a field, with nothing else prescribed: what is left to find is how
/// the body answers to the opening of cracks. Errors: as QuadraticBody::solve().
LoadCase as_field(const QuadraticBody& body, const LoadCase& load);

}  // namespace conchoid
