#include "conchoid/io/run_folder.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/formats/ply.hpp"
#include "conchoid/io/level_set.hpp"

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

/// Whether a file of a run folder is this one, or what is left of it where the program was killed.
bool is_or_was_to_be(const fs::path& file, const std::string& name) {
  const std::string found = file.filename().string();
  return found == name || found.starts_with(name + ".tmp-");
}

bool holds_run(const fs::path& path) {
  const fs::directory_iterator entries(path);
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    return is_or_was_to_be(entry.path(), "run.json") || is_or_was_to_be(entry.path(), "run.pvd");
  });
}

/// Deletes what an earlier run wrote, run.json first so that a half emptied folder is not taken for a
/// finished run. run.pvd stays: by it the folder is known.
void remove_earlier_run(const fs::path& path) {
  fs::remove(path / "run.json");
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.path().filename().string().starts_with("run.pvd.tmp-")) old.push_back(entry.path());
    for (const char* name :
         {"run.json", "front.csv", "crack.ply", "fragments.glb", "fragments.vdb", "hulls.obj"})
      if (is_or_was_to_be(entry.path(), name)) old.push_back(entry.path());
  }
  for (const auto& [folder, prefix] : {std::pair("frames", "frame_"), std::pair("fragments", "fragment_")}) {
    if (!fs::is_directory(path / folder)) continue;
    for (const auto& entry : fs::directory_iterator(path / folder))
      if (entry.path().filename().string().starts_with(prefix)) old.push_back(entry.path());
  }
  for (const fs::path& file : old)
    fs::remove(file);
}

/// Body and crack as one mesh: the crack's nodes and triangles follow the body's; `part` is 0 on the body,
/// 1 on the crack and, where it is shown as two faces, 2 on the one its normal points away from.
class FrameMesh {
 public:
  explicit FrameMesh(const FrameData& data)
      : data_(data), two_(data.exaggeration > 0 && !data.opening.empty()) {
    check_lengths();
    out_.mesh = data.body;
    add_face(data.crack, false);
    if (two_) add_face(data.crack, true);
    add_node_fields();
    add_triangle_fields();
    if (data.exaggeration > 0) displace();
  }

  VtuMesh take() { return std::move(out_); }

 private:
  void check_lengths() const;

  void add_face(const TriMesh& crack, bool turned) {
    const std::size_t first = out_.mesh.node_count();
    for (const Vec3& x : crack.positions)
      out_.mesh.positions.add(x);
    for (auto corners : crack.corners) {
      for (NodeId& c : corners)
        c = NodeId(c.index() + first);
      if (turned) std::swap(corners[1], corners[2]);
      out_.mesh.corners.add(corners);
    }
  }

  /// Values on the body, then on the crack, once or twice; zero where a list is empty.
  template <class T>
  std::vector<T> joined(const std::vector<T>& body, std::size_t body_size, const std::vector<T>& crack,
                        std::size_t crack_size, const T& zero) const {
    std::vector<T> all = body;
    all.resize(body_size, zero);
    for (int face = 0; face < (two_ ? 2 : 1); ++face) {
      all.insert(all.end(), crack.begin(), crack.end());
      all.resize(body_size + static_cast<std::size_t>(face + 1) * crack_size, zero);
    }
    return all;
  }

  void add_node_fields() {
    const std::size_t body = data_.body.node_count(), crack = data_.crack.node_count();
    const Vec3 zero = Vec3::Zero();
    displacement_ = joined<Vec3>(data_.displacement, body, {}, crack, zero);
    if (two_)
      for (std::size_t n = 0; n < crack; ++n) {
        displacement_[body + n] = 0.5 * data_.opening[NodeId(n)];
        displacement_[body + crack + n] = -0.5 * data_.opening[NodeId(n)];
      }
    if (!data_.displacement.empty() || two_)
      out_.node_fields.push_back(vector_field("displacement", displacement_));
    if (!data_.opening.empty())
      out_.node_fields.push_back(vector_field("opening", joined<Vec3>({}, body, data_.opening, crack, zero)));
    if (!data_.intensity.empty())
      out_.node_fields.push_back(vector_field("K", joined<Vec3>({}, body, data_.intensity, crack, zero)));
  }

  void add_triangle_fields() {
    const std::size_t body = data_.body.triangle_count(), crack = data_.crack.triangle_count();
    const Vec3 zero = Vec3::Zero();
    std::vector<double> part(body, 0.0);
    part.resize(body + crack, 1.0);
    if (two_) part.resize(body + 2 * crack, 2.0);
    out_.triangle_fields.push_back(scalar_field("part", part));
    if (!data_.traction.empty())
      out_.triangle_fields.push_back(
          vector_field("traction", joined<Vec3>(data_.traction, body, {}, crack, zero)));
    if (!data_.principal_stress.empty())
      out_.triangle_fields.push_back(
          vector_field("principal_stress", joined<Vec3>(data_.principal_stress, body, {}, crack, zero)));
    if (!data_.stress.empty())
      out_.triangle_fields.push_back(
          tensor_field("stress", joined<Mat3>(data_.stress, body, {}, crack, Mat3::Zero())));
  }

  void displace() {
    for (std::size_t n = 0; n < out_.mesh.node_count(); ++n)
      out_.mesh.positions[NodeId(n)] += data_.exaggeration * displacement_[n];
  }

  const FrameData& data_;
  bool two_;
  std::vector<Vec3> displacement_;
  VtuMesh out_;
};

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

std::vector<FaceKind> face_kinds(const std::vector<int>& numbers) {
  std::vector<FaceKind> kinds;
  for (const int number : numbers)
    kinds.push_back(number == 0 ? FaceKind::original : FaceKind::fracture);
  return kinds;
}

std::vector<TriId> triangle_ids(const std::vector<int>& numbers) {
  std::vector<TriId> ids;
  for (const int number : numbers)
    ids.push_back(TriId(number));
  return ids;
}

void FrameMesh::check_lengths() const {
  const std::size_t body_nodes = data_.body.node_count(), body_triangles = data_.body.triangle_count();
  check_length("displacement", data_.displacement.size(), body_nodes);
  check_length("traction", data_.traction.size(), body_triangles);
  check_length("principal_stress", data_.principal_stress.size(), body_triangles);
  check_length("stress", data_.stress.size(), body_triangles);
  check_length("opening", data_.opening.size(), data_.crack.node_count());
  check_length("intensity", data_.intensity.size(), data_.crack.node_count());
}

}  // namespace

RunFolder::RunFolder(const fs::path& path) : path_(path) {
  try {
    if (fs::exists(path) && !fs::is_directory(path))
      refuse_folder(path, "is a file, not a folder; give another name with --out");
    if (fs::exists(path) && !fs::is_empty(path) && !holds_run(path))
      refuse_folder(path,
                    "holds files that are not a run's (no run.json, no run.pvd); give an empty or a new "
                    "folder with --out");
    fs::create_directories(path);
    remove_earlier_run(path);
    write_pvd(path_ / "run.pvd", frames_);
    fs::create_directories(path / "frames");
  } catch (const fs::filesystem_error& error) {
    refuse_folder(path, "cannot be written (" + error.code().message() +
                            "); check the permissions or give another folder with --out");
  }
}

void RunFolder::write_frame(int frame, const FrameData& data) {
  const std::string name = numbered("frames/frame_%04d.vtu", frame);
  const VtuMesh vtu = FrameMesh(data).take();
  write_vtu(path_ / name, vtu.mesh, vtu.node_fields, vtu.triangle_fields);
  std::erase_if(frames_, [&](const PvdEntry& entry) { return entry.file == name; });
  frames_.push_back({data.time, name});
  write_pvd(path_ / "run.pvd", frames_);
}

void RunFolder::write_front_csv(const std::vector<FrontRow>& rows) {
  conchoid::write_front_csv(path_ / "front.csv", rows);
}

void RunFolder::write_crack(const TriMesh& crack, const std::vector<int>& frame) {
  PlyMesh ply;
  ply.mesh = crack;
  ply.frame = frame;
  write_ply(path_ / "crack.ply", ply);
}

void RunFolder::write_fragments(const std::vector<Fragment>& fragments, const FragmentFormats& formats,
                                const std::vector<FragmentContact>& contacts, double voxel) {
  try {
    if (formats.ply || formats.obj || formats.stl) fs::create_directories(path_ / "fragments");
  } catch (const fs::filesystem_error& error) {
    refuse_folder(path_ / "fragments",
                  "cannot be created (" + error.code().message() + "); check the permissions");
  }
  std::vector<std::function<void()>> files;
  if (formats.glb)
    files.push_back([&] { write_fragments_glb(path_ / "fragments.glb", fragments, contacts); });
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Fragment& f = fragments[i];
    const std::string name = (path_ / "fragments" / fragment_name(i)).string();
    if (formats.obj) files.push_back([&f, name] { write_fragment_obj(name + ".obj", f); });
    if (formats.ply) files.push_back([&f, name] { write_fragment_ply(name + ".ply", f); });
    if (formats.stl) files.push_back([&f, name] { write_mesh(name + ".stl", f.mesh); });
  }
  parallel_for(files.size(), 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      files[i]();
  });
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
    if (ply.mesh.triangle_count() != record.triangles || ply.kind.size() != record.triangles)
      refuse_folder(file, "has " + std::to_string(ply.mesh.triangle_count()) +
                              " triangles where run.json says " + std::to_string(record.triangles) +
                              "; run the scene again with --out");
    run.fragments.push_back({std::move(ply.mesh),
                             face_kinds(ply.kind),
                             triangle_ids(ply.source),
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
