#include "conchoid/formats/ply_header.hpp"

#include <algorithm>
#include <array>

namespace conchoid::ply {
namespace {

struct ScalarName {
  std::string_view name, other_name;
  Scalar type;
  std::size_t size;
};
constexpr std::array<ScalarName, 8> scalar_names = {{{"char", "int8", Scalar::int8, 1},
                                                     {"uchar", "uint8", Scalar::uint8, 1},
                                                     {"short", "int16", Scalar::int16, 2},
                                                     {"ushort", "uint16", Scalar::uint16, 2},
                                                     {"int", "int32", Scalar::int32, 4},
                                                     {"uint", "uint32", Scalar::uint32, 4},
                                                     {"float", "float32", Scalar::float32, 4},
                                                     {"double", "float64", Scalar::float64, 8}}};

Scalar scalar_type(std::string_view word, const TextScanner& scan) {
  for (const ScalarName& s : scalar_names)
    if (word == s.name || word == s.other_name) return s.type;
  scan.fail("unknown property type");
}

Encoding encoding_named(std::string_view name, const TextScanner& scan) {
  if (name == "ascii") return Encoding::ascii;
  if (name == "binary_little_endian") return Encoding::little_endian;
  if (name == "binary_big_endian") return Encoding::big_endian;
  scan.fail("unknown format; use ascii, binary_little_endian or binary_big_endian");
}

Element read_element(TextScanner& scan, std::size_t file_size) {
  Element element;
  element.name = scan.next_word();
  const std::int64_t count = scan.integer(scan.next_word(), "number of elements");
  if (count < 0 || static_cast<std::uint64_t>(count) > file_size)
    scan.fail("element count " + std::to_string(count) +
              " does not fit into the file; it is truncated or damaged");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

Property read_property(TextScanner& scan) {
  Property property;
  std::string_view type = scan.next_word();
  if (type == "list") {
    property.list_count = scalar_type(scan.next_word(), scan);
    type = scan.next_word();
  }
  property.type = scalar_type(type, scan);
  property.name = scan.next_word();
  return property;
}

}  // namespace

std::size_t size_of(Scalar type) {
  return scalar_names[static_cast<std::size_t>(type)].size;
}

Header read_header(TextScanner& scan, const std::string& file, std::size_t file_size) {
  if (!scan.next_line() || scan.next_word() != "ply")
    fail_in_file(file, "does not start with 'ply'; it is not a .ply file");
  Header header;
  bool has_format = false;
  while (scan.next_line()) {
    const std::string_view keyword = scan.next_word();
    if (keyword == "end_header") {
      if (!has_format) scan.fail("the header names no format");
      return header;
    } else if (keyword == "format") {
      header.encoding = encoding_named(scan.next_word(), scan);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scan, file_size));
    } else if (keyword == "property") {
      if (header.elements.empty()) scan.fail("a property before any element");
      header.elements.back().properties.push_back(read_property(scan));
    } else if (keyword != "comment" && keyword != "obj_info") {
      scan.fail("unknown keyword in the header; the file is truncated or damaged");
    }
  }
  scan.fail("the file ends before 'end_header'; it is truncated");
}

bool holds_corners(const Property& property) {
  return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

const Element& element_named(const Header& header, std::string_view name, const std::string& file) {
  for (const Element& element : header.elements)
    if (element.name == name) return element;
  fail_in_file(file,
               "has no element '" + std::string(name) + "'; export the surface with vertices and faces");
}

void require_surface(const Header& header, const std::string& file) {
  const Element& vertex = element_named(header, "vertex", file);
  for (const char* axis : {"x", "y", "z"})
    if (std::none_of(vertex.properties.begin(), vertex.properties.end(),
                     [&](const Property& p) { return p.name == axis && !p.list_count; }))
      fail_in_file(file, "its vertices have no property '" + std::string(axis) + "'");
  const auto strips = std::find_if(header.elements.begin(), header.elements.end(), holds_strips);
  const bool has_faces = std::any_of(header.elements.begin(), header.elements.end(),
                                     [](const Element& e) { return e.name == "face"; });
  const Element& face =
      !has_faces && strips != header.elements.end() ? *strips : element_named(header, "face", file);
  if (std::none_of(face.properties.begin(), face.properties.end(), holds_corners))
    fail_in_file(file, "its faces have no list 'vertex_indices'; export faces or triangle strips");
}

bool holds_strips(const Element& element) {
  return element.name == "tristrips";
}

bool comes_before(const Header& header, std::string_view first, std::string_view second) {
  for (const Element& element : header.elements) {
    if (element.name == first) return true;
    if (element.name == second) return false;
  }
  return false;
}

}  // namespace conchoid::ply
