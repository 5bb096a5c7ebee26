#include "conchoid/sim/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/core/hash.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/sim/frame_loop.hpp"
#include "conchoid/sim/run_identity.hpp"
#include "conchoid/surface/move_fragment.hpp"
#include "conchoid/surface/open_slits.hpp"

namespace conchoid {
namespace {

constexpr double kRunOut =
    0.5;  // × r̄: how far a crack that separates the coarse body is run on through the detailed one

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void move_back(TriMesh& mesh, const Vec3& origin) {
  for (Vec3& x : mesh.positions)
    x += origin;
}

TriMesh join(const std::vector<TriMesh>& sheets) {
  TriMesh all;
  for (const TriMesh& sheet : sheets) {
    const std::size_t first = all.node_count();
    all.positions.insert(all.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (const auto& c : sheet.corners)
      all.corners.push_back(
          {NodeId(c[0].index() + first), NodeId(c[1].index() + first), NodeId(c[2].index() + first)});
  }
  return all;
}

// Nodes that no triangle uses are dropped.
TriMesh used_part(const CutComplex& cut) {
  TriMesh out;
  std::vector<NodeId> moved(cut.positions.size());
  for (const auto& c : cut.sheet) {
    std::array<NodeId, 3> corners;
    for (int k = 0; k < 3; ++k) {
      NodeId& to = moved[c[k].index()];
      if (!to.valid()) to = out.positions.add(cut.positions[c[k]]);
      corners[k] = to;
    }
    out.corners.push_back(corners);
  }
  return out;
}

std::vector<TriMesh> run_on(std::vector<TriMesh> sheets, double length) {
  for (TriMesh& sheet : sheets)
    sheet = unfolded_part(extend_sheet_beyond(sheet, boundary_edges(sheet), length));
  return sheets;
}

AttributeSettings attribute_settings(const Scene& scene, const BodySetup& setup) {
  AttributeSettings settings;
  settings.projection = scene.output.projection;
  settings.texture_size = scene.output.texture_size.value_or(std::cbrt(enclosed_volume(setup.detailed)));
  settings.crease_angle = scene.output.crease_angle * std::numbers::pi / 180;
  return settings;
}

// Far below what can be seen, far above what single precision rounds away.
constexpr double kSlitWidth = 2e-4;  // of the crack surface's edge length

// The detailed body in pieces, and the crack surface inside it.
void cut_body(const Scene& scene, const FrameLoop& loop, bool fragments, RunResult& result) {
  const BodySetup& setup = loop.setup();
  std::vector<TriMesh> sheets = loop.fine_sheets();
  if (setup.infinite()) {
    result.crack = join(sheets);
    return;
  }
  const FragmentSettings settings{scene.material.density, scene.run.smallest_fragment,
                                  static_cast<std::size_t>(scene.run.max_fragments)};
  try {
    if (fragments) result.fragments = cut_into_fragments(setup.detailed, sheets, settings);
    if (result.document.stop == "separated" && fragments && settings.maximum_count != 1 &&
        result.fragments.size() < 2) {
      std::vector<TriMesh> longer = run_on(sheets, kRunOut * setup.crack_edge);
      std::vector<Fragment> pieces = cut_into_fragments(setup.detailed, longer, settings);
      if (pieces.size() > 1) {
        sheets = std::move(longer);
        result.fragments = std::move(pieces);
      }
    }
    result.crack = used_part(corefine(setup.detailed, join(sheets)));
  } catch (const std::runtime_error&
               error) {  // a crack surface folded over itself: the frames are still worth having
    result.document.warnings.push_back(
        fmt::format("the body could not be cut by the fine crack surface ({}); crack.ply holds the surface "
                    "as swept, the body is left whole",
                    error.what()));
    warning(result.document.warnings.back());
    result.crack = join(sheets);
    if (fragments) result.fragments = cut_into_fragments(setup.detailed, {}, settings);
  }
  // The coarse crack may end a triangle short of where the fine one has cut through.
  if (result.document.stop == "arrested" && result.fragments.size() > 1) result.document.stop = "separated";
  result.document.contacts = fragment_contacts(result.fragments);
  for (Fragment& f : result.fragments)
    open_slits(f, kSlitWidth * setup.surface_edge);
  transfer_attributes(result.fragments, setup.detailed, setup.attributes, attribute_settings(scene, setup));
  for (Fragment& f : result.fragments) {
    move_fragment(f, setup.origin, setup.detailed, setup.scene_positions);
    result.document.fragments.push_back(fragment_record(f));
  }
  move_back(result.crack, setup.origin);
}

std::string result_hash(const RunResult& result) {
  ContentHash hash;
  hash.add(result.document.stop);
  add_mesh(hash, result.crack);
  for (const Fragment& f : result.fragments)
    add_mesh(hash, f.mesh);
  for (const FrontRow& row : result.front) {
    hash.add(std::array{row.position[0], row.position[1], row.position[2]});
    hash.add(std::array{row.intensity[0], row.intensity[1], row.intensity[2]});
    hash.add(std::array{row.opening[0], row.opening[1], row.opening[2]});
  }
  return hash.hex();
}

void describe(const Scene& scene, const FrameLoop& loop, const RunOptions& options, RunDocument& doc) {
  doc.scene_file = scene.file;
  doc.scene_text = scene.text;
  doc.method = name(options.method);
  const BodySetup& setup = loop.setup();
  doc.settings = {
      {"resolution.crack", setup.crack_edge},
      {"resolution.surface", setup.surface_edge},
      {"run.quadrature_tolerance", scene.run.quadrature_tolerance},
      {"run.frames", static_cast<std::int64_t>(options.frames.value_or(scene.run.frames))},
      {"run.max_cracks", static_cast<std::int64_t>(scene.run.max_cracks)},
      {"run.sif", std::string(scene.run.sif == SifSource::two_point ? "two-point" : "one-point")},
      {"output.formats", fmt::format("{}", fmt::join(options.formats.value_or(scene.output.formats), ","))}};
  doc.versions = {{"conchoid", std::string(CONCHOID_VERSION)}, {"compiler", std::string("g++ " __VERSION__)}};
  if (setup.infinite()) return;
  Box box = bounding_box(setup.detailed);
  box.low += setup.origin;
  box.high += setup.origin;
  doc.body = box;
  doc.body_volume = enclosed_volume(setup.detailed);
}

// Where a run is written.
struct Places {
  std::optional<RunFolder> folder;
  std::optional<Checkpoint> checkpoint;
};

// A checkpoint is read before anything in the folder is touched.
Places open_places(const Scene& scene, const BodySetup& setup, const RunOptions& options) {
  Places places;
  if (!options.folder) return places;
  const std::string identity = run_identity(scene, setup, options);
  if (options.resume) places.checkpoint.emplace(*options.folder, identity, Checkpoint::Earlier::keep);
  places.folder.emplace(*options.folder);
  if (!options.resume) places.checkpoint.emplace(*options.folder, identity, Checkpoint::Earlier::remove);
  if (places.checkpoint->frames() > 0)
    message(fmt::format("{}: goes on after frame {}", options.folder->string(), places.checkpoint->frames()));
  return places;
}

bool may_go_on(const RunDocument& document) {
  return document.stop == "frame-limit" || document.stop == "interrupted";
}

void write_results(const RunResult& result, const FragmentFormats& formats, double voxel, RunFolder& folder) {
  folder.write_front_csv(result.front);
  folder.write_crack(result.crack);
  if (!result.fragments.empty())
    folder.write_fragments(result.fragments, formats, result.document.contacts, voxel);
  folder.write_run_json(result.document);
}

}  // namespace

Method method_from_name(const std::string& text) {
  for (Method m : {Method::bem, Method::forest, Method::steady})
    if (name(m) == text) return m;
  throw InputError(fmt::format("method '{}' is not known; use bem, forest or steady", text));
}

std::string name(Method method) {
  return method == Method::bem ? "bem" : method == Method::forest ? "forest" : "steady";
}

RunResult run_scene(const Scene& scene, const RunOptions& options) {
  if (options.method == Method::forest && !options.forest)
    throw InputError("method 'forest' needs a trained forest: --database FOREST");
  const FragmentFormats formats = formats_from_names(options.formats.value_or(scene.output.formats),
                                                     options.formats ? "--format" : scene.output.where);
  const auto start = std::chrono::steady_clock::now();
  RunResult result;
  RunDocument& doc = result.document;
  FrameLoop loop(scene, options);
  Places places = open_places(scene, loop.setup(), options);
  if (places.checkpoint) doc.resumed_after = places.checkpoint->frames();
  describe(scene, loop, options, doc);
  const std::size_t body_triangles = loop.setup().surface.triangle_count();
  std::size_t crack_triangles = 0;
  for (const TriMesh& crack : loop.setup().cracks)
    crack_triangles += crack.triangle_count();
  doc.initial_triangles = body_triangles + crack_triangles;
  loop.run(result, places.folder ? &*places.folder : nullptr,
           places.checkpoint ? &*places.checkpoint : nullptr);
  doc.final_triangles = body_triangles + loop.crack_triangles();
  cut_body(scene, loop, options.fragments, result);
  doc.hash = result_hash(result);
  doc.total_seconds = seconds_since(start);
  doc.other_seconds = doc.total_seconds - doc.opening_seconds - doc.fracture_seconds;
  if (doc.frames > 0) doc.opening_seconds_per_frame = doc.opening_seconds / doc.frames;
  if (places.folder) write_results(result, formats, loop.setup().surface_edge, *places.folder);
  if (places.checkpoint && !may_go_on(doc)) places.checkpoint->remove();
  return result;
}

}  // namespace conchoid
