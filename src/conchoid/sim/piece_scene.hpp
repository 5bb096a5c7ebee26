#pragma once

#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// A piece as a body of its own, and what acts on it.
struct PieceScene {
  Body body;
  Scene scene;
};

/// What becomes of a piece when its body has come apart. It keeps material, resolution and settings, and those
/// of the body's conditions that its surface has a share in: a boundary element of the piece has the condition
/// of the element of the body that lies there (the triangle that it comes from, Fragment::source, where the
/// body was cut as it was meshed), and is free if its face was made by fracture. A force and a
/// moment go on as the tractions that they were, weight as it is, and a rotation about the axis it had. Unless the piece is held, its loads accelerate it (inertia relief). Cracks that end in
/// it go on from where they stand. Its elements are as large as the body's, and linear where those are.
/// @param scene     of the body that it was cut from
/// @param body      that body, made ready
/// @param fragment  in the scene's coordinates, with Fragment::source into body.detailed
/// Throws InputError or ComputationError if no boundary elements can be made of it.
PieceScene scene_of_piece(const Scene& scene, const PreparedBody& body, const Fragment& fragment);

/// Whether anything strains the body: a traction, displacements that are not all the same, a rotation, or its weight
/// where it is held.
bool is_loaded(const Scene& scene);

}  // namespace conchoid
