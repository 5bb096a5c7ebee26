#include <ostream>

#include "conchoid/core/numbers.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"

namespace conchoid {
namespace {

constexpr char comment = '#';

std::size_t count(TextScanner& scan, const char* what, std::size_t file_size) {
  const std::int64_t n = scan.integer(scan.next_word_across(comment, what), what);
  if (n < 0) scan.fail(std::string(what) + " is negative");
  // Every element takes at least two characters: anything larger is damaged, and must not be allocated.
  if (static_cast<std::size_t>(n) > file_size / 2)
    scan.fail(std::string(what) + " " + std::to_string(n) +
              " does not fit into the file; it is truncated or damaged");
  return static_cast<std::size_t>(n);
}

}  // namespace

TriMesh read_off(std::string_view bytes, const std::string& file) {
  TextScanner scan(bytes, file);
  const std::string_view magic = scan.next_line(comment) ? scan.next_word() : std::string_view();
  if (magic != "OFF" && magic != "COFF")
    fail_in_file(file, "does not start with OFF; it is not an ascii .off file of vertices and faces");
  const std::size_t vertices = count(scan, "number of vertices", bytes.size());
  const std::size_t faces = count(scan, "number of faces", bytes.size());
  scan.next_word();  // number of edges: optional and unused

  TriMesh mesh;
  mesh.positions.reserve(vertices);
  for (std::size_t n = 0; n < vertices; ++n) {
    if (!scan.next_line(comment))
      scan.fail("the file ends before vertex " + std::to_string(n) + "; it is truncated");
    Vec3 x;
    for (int k = 0; k < 3; ++k)
      x[k] = scan.number(scan.next_word(), "vertex coordinate");
    mesh.positions.push_back(x);
  }
  std::vector<NodeId> polygon;
  SkippedElements skipped(file);
  for (std::size_t f = 0; f < faces; ++f) {
    if (!scan.next_line(comment))
      scan.fail("the file ends before face " + std::to_string(f) + "; it is truncated");
    const std::int64_t corners = scan.integer(scan.next_word(), "number of corners");
    if (corners < 1) scan.fail("face " + std::to_string(f) + " has no corners");
    polygon.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t index = scan.integer(scan.next_word(), "vertex index");
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        scan.fail("face " + std::to_string(f) + ": vertex index " + std::to_string(index) +
                  " is out of range 0 … " + std::to_string(static_cast<std::int64_t>(vertices) - 1));
      polygon.push_back(NodeId(static_cast<std::size_t>(index)));
    }
    if (corners < 3)
      skipped.add("faces of fewer than three vertices");
    else
      add_polygon(mesh, polygon);
  }
  skipped.warn();
  return mesh;
}

void write_off(std::ostream& out, const TriMesh& mesh) {
  out << "OFF\n" << mesh.node_count() << ' ' << mesh.triangle_count() << " 0\n";
  for (const Vec3& x : mesh.positions)
    out << shortest(x.x()) << ' ' << shortest(x.y()) << ' ' << shortest(x.z()) << '\n';
  for (const auto& c : mesh.corners)
    out << "3 " << c[0].value << ' ' << c[1].value << ' ' << c[2].value << '\n';
}

}  // namespace conchoid
