#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"
#include "conchoid/mesh/place.hpp"

namespace conchoid {
namespace {

constexpr std::size_t header_size = 80, record_size = 50;

TriMesh read_binary(std::string_view bytes, const std::string& file) {
  const auto count = from_bytes<std::uint32_t>(bytes.substr(header_size));
  TriMesh mesh;
  NodeWelder merge(mesh);  // STL repeats every vertex in each of its triangles
  mesh.corners.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    std::string_view record = bytes.substr(header_size + 4 + t * record_size + 12);
    std::array<NodeId, 3> corners;
    for (NodeId& corner : corners) {
      Vec3 x;
      for (int k = 0; k < 3; ++k)
        x[k] = from_bytes<float>(record.substr(4 * static_cast<std::size_t>(k)));
      if (!x.allFinite())
        fail_in_file(file,
                     "triangle " + std::to_string(t) + " has a coordinate that is not finite; repair it");
      corner = merge(x);
      record = record.substr(12);
    }
    mesh.corners.push_back(corners);
  }
  return mesh;
}

char small_letter(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Whether a word of the file is this one, in any case of letters.
bool is(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return small_letter(a) == b; });
}

/// Programs write "solid" into the header of binary files too: those have bytes that are no text.
bool is_text(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && is(bytes.substr(first, 5), "solid") &&
         bytes.find('\0') == std::string_view::npos;
}

TriMesh read_ascii(std::string_view bytes, const std::string& file) {
  TriMesh mesh;
  NodeWelder merge(mesh);
  TextScanner scan(bytes, file);
  std::vector<NodeId> loop;
  bool ended = false, inside = false;
  while (scan.next_line()) {
    const std::string_view keyword = scan.next_word();
    if (is(keyword, "outer")) {
      loop.clear();
      inside = true;
    } else if (is(keyword, "vertex")) {
      if (!inside) scan.fail("a vertex outside of 'outer loop'");
      Vec3 x;
      for (int k = 0; k < 3; ++k)
        x[k] = scan.number(scan.next_word(), "vertex coordinate");
      loop.push_back(merge(x));
    } else if (is(keyword, "endloop")) {
      if (loop.size() != 3)
        scan.fail("a facet has " + std::to_string(loop.size()) + " vertices instead of three");
      add_polygon(mesh, loop);
      inside = false;
    } else if (is(keyword, "endsolid")) {
      ended = true;
    } else if (is(keyword, "solid")) {
      ended = false;
    } else if (!is(keyword, "facet") && !is(keyword, "endfacet")) {
      scan.fail("an unknown keyword; the file is not an ascii .stl or it is damaged");
    }
  }
  if (!ended || inside) scan.fail("the file ends without 'endsolid'; it is truncated");
  return mesh;
}

}  // namespace

TriMesh read_stl(std::string_view bytes, const std::string& file) {
  const bool has_count = bytes.size() >= header_size + 4;
  const std::uint64_t count = has_count ? from_bytes<std::uint32_t>(bytes.substr(header_size)) : 0;
  const std::uint64_t promised = header_size + 4 + count * record_size;
  // The size that the triangle count implies decides before any word does.
  if (has_count && bytes.size() == promised) return read_binary(bytes, file);
  if (is_text(bytes)) return read_ascii(bytes, file);
  if (has_count && count > 0 && bytes.size() > promised) {
    warning(file + ": " + std::to_string(bytes.size() - promised) + " bytes after the last of its " +
            std::to_string(count) + " triangles are not read");
    return read_binary(bytes, file);
  }
  if (!has_count) fail_in_file(file, "is too short to be a .stl file; it is truncated or of another format");
  fail_in_file(file, "the header promises " + std::to_string(count) +
                         " triangles but the file has room for " +
                         std::to_string((bytes.size() - header_size - 4) / record_size) +
                         "; it is truncated, damaged or not a .stl file");
}

void write_stl(std::ostream& out, const TriMesh& mesh) {
  std::string bytes = "binary STL, written by conchoid";
  bytes.resize(header_size, '\0');
  bytes.reserve(header_size + 4 + record_size * mesh.triangle_count());
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangle_count()));
  const auto append_vector = [&](const Vec3& x) {
    for (const double component : x)
      append_bytes(bytes, static_cast<float>(component));
  };
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    append_vector(unit_normal(mesh, TriId(t)));
    for (const Vec3& x : mesh.triangle(TriId(t)))
      append_vector(x);
    append_bytes(bytes, std::uint16_t{0});
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace conchoid
