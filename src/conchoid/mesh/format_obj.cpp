#include <ostream>

#include "conchoid/mesh/format_readers.hpp"
#include "conchoid/mesh/mesh_text.hpp"

namespace conchoid {
namespace {

/// "7", "7/1", "7//3", "7/1/3", "-1": the vertex, counted from 1, or from the end where negative.
NodeId vertex_of(std::string_view word, const TextScanner& scan, std::size_t vertex_count) {
  const std::int64_t index = scan.integer(word.substr(0, word.find('/')), "vertex index");
  const auto count = static_cast<std::int64_t>(vertex_count);
  const std::int64_t zero_based = index > 0 ? index - 1 : count + index;
  if (index == 0 || zero_based < 0 || zero_based >= count)
    scan.fail("vertex index " + std::to_string(index) + " is out of range; " + std::to_string(count) +
              " vertices come before this face, counted from 1");
  return NodeId(static_cast<std::size_t>(zero_based));
}

}  // namespace

TriMesh read_obj(std::string_view bytes, const std::string& file) {
  TriMesh mesh;
  TextScanner scan(bytes, file);
  std::vector<NodeId> polygon;
  while (scan.next_line('#')) {
    const std::string_view keyword = scan.next_word();
    if (keyword == "v") {
      Vec3 x;
      for (int k = 0; k < 3; ++k)
        x[k] = scan.number(scan.next_word(), "vertex coordinate");
      mesh.positions.push_back(x);
    } else if (keyword == "f") {
      polygon.clear();
      for (std::string_view word = scan.next_word(); !word.empty(); word = scan.next_word())
        polygon.push_back(vertex_of(word, scan, mesh.node_count()));
      if (polygon.size() < 3) scan.fail("a face needs at least three vertices");
      add_polygon(mesh, polygon);
    }
  }
  if (mesh.node_count() == 0)
    fail_in_file(file, "has no vertex lines ('v x y z'); it is not an .obj surface or it is truncated");
  return mesh;
}

void write_obj(std::ostream& out, const TriMesh& mesh) {
  for (const Vec3& x : mesh.positions)
    out << "v " << shortest_text(x.x()) << ' ' << shortest_text(x.y()) << ' ' << shortest_text(x.z()) << '\n';
  for (const auto& c : mesh.corners)
    out << "f " << c[0].value + 1 << ' ' << c[1].value + 1 << ' ' << c[2].value + 1 << '\n';
}

}  // namespace conchoid
