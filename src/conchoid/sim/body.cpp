#include "conchoid/sim/body.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/carry_attributes.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/examine.hpp"
#include "conchoid/remesh/pinches.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/remesh/weld.hpp"
#include "conchoid/sim/kept_surface.hpp"

namespace conchoid {
namespace {

void scale(TriMesh& mesh, double factor) {
  for (Vec3& x : mesh.positions)
    x = factor * x;
}

// The detailed surface and everything else at their final size; boundary elements by remeshing it.
Body with_settings(Body body, const BodySettings& settings) {
  scale(body.detailed, settings.scale);
  for (TriMesh& crack : body.cracks)
    scale(crack, settings.scale);
  body.surface = body.detailed;
  if (!settings.remesh || body.infinite()) return body;
  TriMesh elements = kept_remesh(body.detailed, *settings.remesh, settings.elements, settings.cache.get());
  return with_elements(std::move(body), std::move(elements));
}

constexpr double kCrumb = 1e-9;  // × volume: below what the volumes of pieces add up to

// Without its slits, parts of a surface may touch in a node that lay between them. What encloses nothing goes.
// @param faces  one thing per triangle
void take_apart(TriMesh& surface, std::vector<TriId>& faces) {
  std::vector<TriId> halved;
  if (split_pinches(surface) + part_edges(surface, halved) == 0) return;
  for (const TriId t : halved)
    faces.push_back(faces[t.index()]);
  std::vector<TriId> kept, kept_faces;
  const double volume = enclosed_volume(surface);
  for (const SurfacePart& part : surface_parts(surface))
    if (std::abs(part.volume) > kCrumb * volume)
      kept.insert(kept.end(), part.triangles.begin(), part.triangles.end());
  std::sort(kept.begin(), kept.end());
  for (const TriId t : kept)
    kept_faces.push_back(faces[t.index()]);
  surface = submesh(surface, kept);
  faces = std::move(kept_faces);
}

}  // namespace

Body with_elements(Body body, TriMesh surface) {
  const ClosestPointTree tree(body.surface);
  const IdVector<TriId, int> region_of = region_of_triangles(body.surface, body.regions);
  for (Region& r : body.regions)
    r.triangles.clear();
  if (!body.regions.empty())
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
      const int region = region_of[tree.closest(centroid(surface, TriId(t))).triangle];
      if (region >= 0) body.regions[region].triangles.push_back(TriId(t));
    }
  body.surface = std::move(surface);
  return body;
}

Body body_from_file(const std::filesystem::path& path, const BodySettings& settings) {
  WeldReport weld;
  AttributedMesh read = kept_welded_if_it_helps(read_surface(path), weld, settings.cache.get());
  try {
    if (!weld.bounds_body) require_valid_body(read.mesh, path.string());
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "\n  conchoid check " + path.string() +
                     " --repair --out FIXED.ply mends what can be mended");
  }
  Body body;
  body.name = path.string();
  const auto warn = [&](const std::string& text) {
    body.warnings.push_back(path.string() + ": " + text);
    warning(body.warnings.back());
  };
  if (weld.nodes > 0) warn(weld.text());
  const Box box = bounding_box(read.mesh);
  const UnitGuess unit = guess_unit((box.high - box.low).maxCoeff());
  if (settings.guess_unit && unit.scale != 1)
    warn(unit.why + "; set body.scale = " + shortest(unit.scale) +
         ", or body.scale = 1.0 if they are metres");
  body.detailed = std::move(read.mesh);
  body.attributes = std::move(read.attributes);
  return with_settings(std::move(body), settings);
}

Body body_from_model(const std::string& name, const BodySettings& settings) {
  BodyModel model = built_in_model(name);
  Body body;
  body.name = name;
  body.detailed = std::move(model.mesh);
  body.regions = std::move(model.regions);
  if (!model.crack.corners.empty()) body.cracks.push_back(std::move(model.crack));
  return with_settings(std::move(body), settings);
}

Body body_from_fragment(const Fragment& fragment, const MaterialFrame& material,
                        const BodySettings& settings) {
  const bool slits = !fragment.unfinished.solid.corners.empty();
  Body body;
  body.name = "piece";
  body.detailed = slits ? fragment.unfinished.solid : fragment.mesh;
  std::vector<TriId> faces = fragment.unfinished.solid_face;
  if (!slits)
    for (std::size_t t = 0; t < fragment.mesh.triangle_count(); ++t)
      faces.emplace_back(t);
  take_apart(body.detailed, faces);
  require_valid_body(body.detailed, body.name);
  body.attributes = attributes_of(fragment.attributes, faces);
  body.regions = {{"original", {}}, {"fracture", {}}};
  for (std::size_t t = 0; t < faces.size(); ++t)
    body.regions[fragment.face_kind[faces[t].index()] == FaceKind::fracture ? 1 : 0].triangles.push_back(
        TriId(t));
  body.cracks = fragment.unfinished.sheets;
  body.material = material;
  return with_settings(std::move(body), settings);
}

MaterialFrame frame_of_pieces(const Body& body) {
  MaterialFrame frame = body.material;
  if (!frame.center) frame.center = bounding_box(body.detailed).center();
  return frame;
}

}  // namespace conchoid
