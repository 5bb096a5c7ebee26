#include "conchoid/formats/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"
#include "conchoid/formats/ply.hpp"

namespace conchoid {
namespace {

struct Format {
  std::string_view ending;
  AttributedMesh (*read)(std::string_view, const std::string&);
  void (*write)(std::ostream&, const TriMesh&);  ///< null: read only
};

AttributedMesh read_ply_surface(std::string_view bytes, const std::string& file) {
  PlyMesh ply = read_ply(bytes, file);
  return {std::move(ply.mesh), std::move(ply.attributes)};
}
void write_ply_mesh(std::ostream& out, const TriMesh& mesh) {
  PlyMesh ply;
  ply.mesh = mesh;
  write_ply(out, ply);
}

/// A format that knows shapes only.
template <TriMesh (*read)(std::string_view, const std::string&)>
AttributedMesh bare(std::string_view bytes, const std::string& file) {
  return {read(bytes, file), {}};
}

constexpr std::array<Format, 5> formats = {{{".ply", read_ply_surface, write_ply_mesh},
                                            {".obj", read_obj, write_obj},
                                            {".stl", bare<read_stl>, write_stl},
                                            {".off", bare<read_off>, write_off},
                                            {".glb", read_glb, nullptr}}};

const Format& format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats)
    if (format.ending == ending) return format;
  fail_in_file(path.string(),
               "unknown mesh format '" + ending + "'; use .ply, .obj, .stl, .off or, to read, .glb");
}

}  // namespace

AttributedMesh read_surface(const std::filesystem::path& path) {
  const Format& format = format_of(path);
  const std::string bytes = read_bytes(path);
  const std::string file = path.string();
  if (bytes.empty()) fail_in_file(file, "the mesh file is empty");
  AttributedMesh surface = format.read(bytes, file);
  const TriMesh& mesh = surface.mesh;
  if (mesh.triangle_count() == 0)
    fail_in_file(file, "the mesh has no triangles; export it as a triangulated surface");
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (!mesh.positions[NodeId(n)].allFinite())
      fail_in_file(file, "vertex " + std::to_string(n) + " has a coordinate that is not finite; repair it");
  return surface;
}

TriMesh read_mesh(const std::filesystem::path& path) {
  return read_surface(path).mesh;
}

void write_surface(const std::filesystem::path& path, const AttributedMesh& surface) {
  if (format_of(path).write != write_ply_mesh) return write_mesh(path, surface.mesh);
  PlyMesh ply;
  ply.mesh = surface.mesh;
  ply.attributes = surface.attributes;
  write_ply(path, ply);
}

void write_mesh(const std::filesystem::path& path, const TriMesh& mesh) {
  const Format& format = format_of(path);
  if (!format.write)
    fail_in_file(path.string(), "surfaces are read from, not written as, " + std::string(format.ending) +
                                    "; use .ply, .obj, .stl or .off");
  AtomicFile file(path);
  format.write(file.stream(), mesh);
  file.commit();
}

}  // namespace conchoid
