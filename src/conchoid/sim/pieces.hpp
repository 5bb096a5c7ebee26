#pragma once

#include <string>
#include <vector>

#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/output_spec.hpp"
#include "conchoid/surface/contacts.hpp"

namespace conchoid {

/// What a fracture leaves: the detailed body in pieces and the crack surface inside it, in the body's
/// coordinates.
struct Pieces {
  std::vector<Fragment> fragments;  ///< largest first; one if the body holds together
  std::vector<FragmentContact> contacts;
  TriMesh crack;  ///< the visible crack surface, trimmed to the body
  std::vector<std::string> warnings;
};

/// Cuts the body by its cracks as they stand: pieces with mass, attributes as `output` asks for, and the
/// cracks that end in them, so that each can be a body of its own (body_from_fragment()). Pieces too small are
/// joined to neighbours as the run's settings say. The infinite body has no pieces.
/// @param shift  of the visible cracks [m], out of the way of what they graze; with one the body is cut anew, whatever has
///               parted it
Pieces cut_into_pieces(const Fracture& fracture, const OutputSpec& output = {},
                       const Vec3& shift = Vec3::Zero());

/// Largest first, with contacts and attributes made anew, for pieces that were cut one after the other.
/// @param pieces  in the body's coordinates, Fragment::source leads back to `body`
void arrange_pieces(Pieces& pieces, const PreparedBody& body, const OutputSpec& output);

/// The visible crack surface alone, trimmed to the body: for runs whose pieces nobody asks for.
TriMesh crack_surface(const Fracture& fracture);

/// The same as it was swept, neither trimmed nor unfolded: for runs that were stopped.
TriMesh swept_crack(const Fracture& fracture);

}  // namespace conchoid
