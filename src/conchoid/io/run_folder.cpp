#include "conchoid/io/run_folder.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/level_set.hpp"
#include "conchoid/io/ply.hpp"
#include "conchoid/mesh/formats.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

std::string numbered(const char* pattern, int number) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, number);
  return text;
}

[[noreturn]] void refuse_folder(const fs::path& path, const std::string& why) {
  throw InputError(path.string() + ": " + why);
}

/// Deletes what an earlier run wrote, run.json first so that a half emptied folder is not taken for a
/// finished run.
void remove_earlier_run(const fs::path& path) {
  for (const char* name :
       {"run.json", "run.pvd", "front.csv", "crack.ply", "fragments.glb", "fragments.vdb", "hulls.obj"})
    fs::remove(path / name);
  for (const auto& [folder, prefix] : {std::pair("frames", "frame_"), std::pair("fragments", "fragment_")}) {
    if (!fs::is_directory(path / folder)) continue;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path / folder))
      if (entry.path().filename().string().rfind(prefix, 0) == 0) files.push_back(entry.path());
    for (const fs::path& file : files)
      fs::remove(file);
  }
}

/// Body and crack as one mesh: the crack's nodes and triangles follow the body's.
TriMesh joined(const TriMesh& body, const TriMesh& crack) {
  TriMesh out = body;
  for (const Vec3& x : crack.positions)
    out.positions.add(x);
  for (auto corners : crack.corners) {
    for (NodeId& c : corners)
      c = NodeId(c.index() + body.node_count());
    out.corners.add(corners);
  }
  return out;
}

/// A field given on one of the two parts: zero on the other, which lies `before` or `after` it.
VtkField padded(const std::string& name, std::size_t before, const std::vector<Vec3>& values,
                std::size_t after) {
  std::vector<Vec3> all(before, Vec3::Zero());
  all.insert(all.end(), values.begin(), values.end());
  all.resize(all.size() + after, Vec3::Zero());
  return vector_field(name, all);
}

void check_length(const char* name, std::size_t length, std::size_t expected) {
  if (length != 0 && length != expected)
    throw std::logic_error(std::string("FrameData: '") + name + "' is not as long as its mesh");
}

/// Whether a run kept its pieces as PLY, as runs do unless told otherwise.
bool wrote_ply(const RunDocument& document) {
  for (const RunSetting& s : document.settings)
    if (s.name == "output.formats") {
      const std::string* names = std::get_if<std::string>(&s.value);
      return !names || names->find("ply") != std::string::npos;
    }
  return true;
}

std::vector<PvdEntry> frames_present(const fs::path& path) {
  std::vector<PvdEntry> entries;
  for (int frame = 0; frame < 100000; ++frame) {
    const std::string name = numbered("frames/frame_%04d.vtu", frame);
    if (fs::exists(path / name)) {
      entries.push_back({static_cast<double>(frame), name});
    } else if (frame > 0) {
      break;
    }
  }
  return entries;
}

}  // namespace

RunFolder::RunFolder(const fs::path& path, Earlier earlier) : path_(path) {
  try {
    if (fs::exists(path) && !fs::is_directory(path))
      refuse_folder(path, "is a file, not a folder; give another name with --out");
    const bool ours = fs::exists(path / "run.json") || fs::exists(path / "run.pvd");
    if (fs::exists(path) && !fs::is_empty(path) && !ours)
      refuse_folder(path,
                    "holds files that are not a run's (no run.json, no run.pvd); give an empty or a new "
                    "folder with --out");
    fs::create_directories(path / "frames");
    if (earlier == Earlier::replace) {
      remove_earlier_run(path);
    } else {
      fs::remove(path / "run.json");
      frames_ = frames_present(path);
    }
  } catch (const fs::filesystem_error& error) {
    refuse_folder(path, "cannot be written (" + error.code().message() +
                            "); check the permissions or give another folder with --out");
  }
  write_pvd(path_ / "run.pvd", frames_);
}

void RunFolder::write_frame(int frame, const FrameData& data) {
  const std::size_t body_nodes = data.body.node_count(), crack_nodes = data.crack.node_count();
  const std::size_t body_triangles = data.body.triangle_count(),
                    crack_triangles = data.crack.triangle_count();
  check_length("displacement", data.displacement.size(), body_nodes);
  check_length("traction", data.traction.size(), body_triangles);
  check_length("principal_stress", data.principal_stress.size(), body_triangles);
  check_length("opening", data.opening.size(), crack_nodes);
  check_length("intensity", data.intensity.size(), crack_nodes);

  std::vector<VtkField> node_fields, triangle_fields;
  if (!data.displacement.empty())
    node_fields.push_back(padded("displacement", 0, data.displacement, crack_nodes));
  if (!data.opening.empty()) node_fields.push_back(padded("opening", body_nodes, data.opening, 0));
  if (!data.intensity.empty()) node_fields.push_back(padded("K", body_nodes, data.intensity, 0));
  std::vector<double> part(body_triangles, 0.0);
  part.resize(body_triangles + crack_triangles, 1.0);
  triangle_fields.push_back(scalar_field("part", part));
  if (!data.traction.empty())
    triangle_fields.push_back(padded("traction", 0, data.traction, crack_triangles));
  if (!data.principal_stress.empty())
    triangle_fields.push_back(padded("principal_stress", 0, data.principal_stress, crack_triangles));

  const std::string name = numbered("frames/frame_%04d.vtu", frame);
  write_vtu(path_ / name, joined(data.body, data.crack), node_fields, triangle_fields);
  std::erase_if(frames_, [&](const PvdEntry& entry) { return entry.file == name; });
  frames_.push_back({data.time, name});
  write_pvd(path_ / "run.pvd", frames_);
}

void RunFolder::write_front_csv(const std::vector<FrontRow>& rows) {
  conchoid::write_front_csv(path_ / "front.csv", rows);
}

void RunFolder::write_crack(const TriMesh& crack, const std::vector<int>& frame) {
  write_ply(path_ / "crack.ply", {crack, {}, {}, frame});
}

void RunFolder::write_fragments(const std::vector<Fragment>& fragments, const FragmentFormats& formats,
                                const std::vector<FragmentContact>& contacts, double voxel) {
  try {
    if (formats.ply || formats.obj || formats.stl) fs::create_directories(path_ / "fragments");
  } catch (const fs::filesystem_error& error) {
    refuse_folder(path_ / "fragments",
                  "cannot be created (" + error.code().message() + "); check the permissions");
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const std::string name = (path_ / "fragments" / fragment_name(i)).string();
    if (formats.ply) write_fragment_ply(name + ".ply", fragments[i]);
    if (formats.obj) write_fragment_obj(name + ".obj", fragments[i]);
    if (formats.stl) write_mesh(name + ".stl", fragments[i].mesh);
  }
  if (formats.glb) write_fragments_glb(path_ / "fragments.glb", fragments, contacts);
  if (formats.vdb) write_fragments_vdb(path_ / "fragments.vdb", fragments, voxel);
  if (formats.hulls) write_hulls_obj(path_ / "hulls.obj", fragments);
}

void RunFolder::write_run_json(const RunDocument& document) {
  AtomicFile file(path_ / "run.json");
  file.stream() << run_json(document, RunJson::document) << '\n';
  file.commit();
}

RunData read_run(const fs::path& path) {
  if (!fs::is_directory(path))
    refuse_folder(path, "is not a folder; give the folder that 'conchoid run --out' wrote");
  if (!fs::exists(path / "run.json"))
    refuse_folder(
        path / "run.json",
        "is missing: this is not a run folder, or its run did not finish; run the scene again with --out");
  RunData run;
  run.document = read_run_json(path / "run.json");
  run.crack = read_ply(path / "crack.ply").mesh;
  run.front = read_front_csv(path / "front.csv");
  if (!wrote_ply(run.document)) return run;
  for (std::size_t i = 0; i < run.document.fragments.size(); ++i) {
    const fs::path file = path / "fragments" / (fragment_name(i) + ".ply");
    PlyMesh ply = read_ply(file);
    const FragmentRecord& record = run.document.fragments[i];
    if (ply.mesh.triangle_count() != record.triangles || ply.face_kind.size() != record.triangles)
      refuse_folder(file, "has " + std::to_string(ply.mesh.triangle_count()) +
                              " triangles where run.json says " + std::to_string(record.triangles) +
                              "; run the scene again with --out");
    run.fragments.push_back({std::move(ply.mesh),
                             std::move(ply.face_kind),
                             std::move(ply.source),
                             record.volume,
                             record.mass,
                             record.center_of_mass,
                             record.inertia,
                             record.watertight,
                             {}});
  }
  return run;
}

}  // namespace conchoid
