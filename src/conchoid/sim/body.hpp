#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/mesh/regions.hpp"
#include "conchoid/mesh/surface_attributes.hpp"
#include "conchoid/remesh/local_edges.hpp"
#include "conchoid/surface/fragments.hpp"

namespace conchoid {

/// Where a body lies in the material it is made of. Fields of the material are given in the coordinates of
/// the body that was first cut from it (its rest frame), so that layers run on through pieces of pieces.
struct MaterialFrame {
  Mat3 turn = Mat3::Identity();  ///< rest position = turn · x + shift of a point x of the body
  Vec3 shift = Vec3::Zero();     ///< [m]
  std::optional<Vec3> center;    ///< of the first body, at rest [m]: where fields lie that name no place of
                                 ///< their own; none: this is the first body
};

/// A body in memory: what can be broken, and broken again. In the caller's coordinates.
struct Body {
  std::string name;              ///< for messages: file, model or "piece"
  TriMesh surface;               ///< boundary elements: closed, outward; empty: unbounded
  TriMesh detailed;              ///< what the fragments show: the same body, mostly finer
  SurfaceAttributes attributes;  ///< of `detailed`
  std::vector<Region> regions;   ///< of `surface`
  std::vector<TriMesh> cracks;   ///< sheets that are there from the start; they may stick out
  MaterialFrame material;
  std::vector<std::string> warnings;  ///< what was said when it was made

  bool infinite() const { return surface.corners.empty(); }
};

struct BodySettings {
  std::optional<int> remesh;                         ///< boundary elements wanted; none: the mesh as it is
  double scale = 1;                                  ///< factor on all coordinates
  bool guess_unit = false;                           ///< warn of a file that is hardly in metres
  std::shared_ptr<const ByteCache> cache = nullptr;  ///< of remeshed surfaces
  RemeshSettings elements = {};                      ///< where remeshing makes them short, at the final size
};

/// Reads a surface; loose seams are welded (remesh/weld.hpp), with a warning. Throws InputError for a mesh that bounds no body, with its defects.
Body body_from_file(const std::filesystem::path& path, const BodySettings& settings = {});
/// A built-in model with its regions and crack (mesh/models.hpp). Throws InputError for another name.
Body body_from_model(const std::string& name, const BodySettings& settings = {});

/// A piece as a body of its own. Cracks that end in it (Fragment::cracks) go on from where they stand: they
/// are sheets of the new body, and no slits of its surface. Faces made by fracture are the region "fracture",
/// the others "original".
/// @param material  of the body it was cut from, if the piece still lies where that lay; else with the piece's
///                  motion undone (MaterialFrame)
/// Throws InputError if the surface without its slits bounds no body.
Body body_from_fragment(const Fragment& fragment, const MaterialFrame& material = {},
                        const BodySettings& settings = {});

/// The same with another mesh of boundary elements. A triangle takes the region of the triangle of the old
/// mesh that its centre is nearest to.
Body with_elements(Body body, TriMesh surface);

/// Frame of the pieces of a body that has not been moved since: its own, or the first one's.
/// @param body  before it broke
MaterialFrame frame_of_pieces(const Body& body);

}  // namespace conchoid
