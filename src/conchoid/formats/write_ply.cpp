#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <string>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/byte_order.hpp"
#include "conchoid/formats/ply.hpp"

namespace conchoid {
namespace {

void write_header(std::ostream& out, const PlyMesh& ply) {
  const auto properties = [&](bool there, const char* type, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (there) out << "property " << type << ' ' << name << '\n';
  };
  const char *real_list = "list uchar float", *index_list = "list uchar int";
  out << "ply\nformat binary_little_endian 1.0\ncomment conchoid, lengths in metres\n"
      << "element vertex " << ply.mesh.node_count() << '\n';
  properties(true, "double", {"x", "y", "z"});
  properties(!ply.node_normal.empty(), "float", {"nx", "ny", "nz"});
  out << "element face " << ply.mesh.triangle_count() << '\n';
  properties(true, index_list, {"vertex_indices"});
  properties(!ply.color.empty(), "uchar", {"red", "green", "blue"});
  properties(!ply.kind.empty(), "uchar", {"kind"});
  properties(!ply.source.empty(), "int", {"source"});
  properties(!ply.frame.empty(), "int", {"frame"});
  properties(!ply.attributes.material.empty(), "int", {"material"});
  properties(!ply.attributes.uv.empty(), real_list, {"texcoord"});
  properties(!ply.attributes.normal.empty(), real_list, {"normals"});
  out << "end_header\n";
}

/// The vectors of the three corners as one list of single precision.
template <class T>
void append_list(std::string& bytes, const std::array<T, 3>& corners) {
  append_bytes(bytes, static_cast<std::uint8_t>(3 * T::RowsAtCompileTime));
  for (const T& corner : corners)
    for (const double component : corner)
      append_bytes(bytes, static_cast<float>(component));
}

void append_vertex(std::string& bytes, const PlyMesh& ply, NodeId n) {
  for (const double component : ply.mesh.positions[n])
    append_bytes(bytes, component);
  if (ply.node_normal.empty()) return;
  for (const double component : ply.node_normal[n])
    append_bytes(bytes, static_cast<float>(component));
}

void append_face(std::string& bytes, const PlyMesh& ply, std::size_t t) {
  append_bytes(bytes, std::uint8_t{3});
  for (const NodeId corner : ply.mesh.corners[TriId(t)])
    append_bytes(bytes, corner.value);
  if (!ply.color.empty())
    for (const std::uint8_t component : ply.color[t])
      append_bytes(bytes, component);
  if (!ply.kind.empty()) append_bytes(bytes, static_cast<std::uint8_t>(ply.kind[t]));
  for (const std::vector<int>* list : {&ply.source, &ply.frame, &ply.attributes.material})
    if (!list->empty()) append_bytes(bytes, std::int32_t{(*list)[t]});
  if (!ply.attributes.uv.empty()) append_list(bytes, ply.attributes.uv[t]);
  if (!ply.attributes.normal.empty()) append_list(bytes, ply.attributes.normal[t]);
}

}  // namespace

void write_ply(std::ostream& out, const PlyMesh& ply) {
  write_header(out, ply);
  std::string bytes;
  bytes.reserve(36 * ply.mesh.node_count() + 32 * ply.mesh.triangle_count());
  for (std::size_t n = 0; n < ply.mesh.node_count(); ++n)
    append_vertex(bytes, ply, NodeId(n));
  for (std::size_t t = 0; t < ply.mesh.triangle_count(); ++t)
    append_face(bytes, ply, t);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void write_ply(const std::filesystem::path& path, const PlyMesh& ply) {
  AtomicFile file(path);
  write_ply(file.stream(), ply);
  file.commit();
}

}  // namespace conchoid
