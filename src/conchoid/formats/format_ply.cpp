#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "conchoid/formats/format_bytes.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"

namespace conchoid {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

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

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> list_count;  ///< type of the length of a list; a single value otherwise
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

Scalar scalar_type(std::string_view word, const TextScanner& scan) {
  for (const ScalarName& s : scalar_names)
    if (word == s.name || word == s.other_name) return s.type;
  scan.fail("unknown property type");
}

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
      const std::string_view name = scan.next_word();
      has_format = true;
      if (name == "ascii")
        header.encoding = Encoding::ascii;
      else if (name == "binary_little_endian")
        header.encoding = Encoding::little_endian;
      else if (name == "binary_big_endian")
        header.encoding = Encoding::big_endian;
      else
        scan.fail("unknown format; use ascii, binary_little_endian or binary_big_endian");
    } else if (keyword == "element") {
      Element element;
      element.name = scan.next_word();
      const std::int64_t count = scan.integer(scan.next_word(), "number of elements");
      if (count < 0 || static_cast<std::uint64_t>(count) > file_size)
        scan.fail("element count " + std::to_string(count) +
                  " does not fit into the file; it is truncated or damaged");
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) scan.fail("a property before any element");
      Property property;
      std::string_view type = scan.next_word();
      if (type == "list") {
        property.list_count = scalar_type(scan.next_word(), scan);
        type = scan.next_word();
      }
      property.type = scalar_type(type, scan);
      property.name = scan.next_word();
      header.elements.back().properties.push_back(std::move(property));
    } else if (keyword != "comment" && keyword != "obj_info") {
      scan.fail("unknown keyword in the header; the file is truncated or damaged");
    }
  }
  scan.fail("the file ends before 'end_header'; it is truncated");
}

/// Hands out the values of the body one after the other.
class Body {
 public:
  Body(Encoding encoding, TextScanner& scan, const std::string& file)
      : encoding_(encoding), scan_(scan), file_(file), bytes_(scan.rest()) {}

  void at(const Element& element, std::uint64_t index) {
    element_ = &element;
    index_ = index;
  }

  double next(Scalar type) {
    if (encoding_ == Encoding::ascii)
      return scan_.number(scan_.next_word_across('\0', place().c_str()), "value");
    const std::endian order = encoding_ == Encoding::little_endian ? std::endian::little : std::endian::big;
    if (bytes_.size() < size_of(type)) fail("the file ends here; it is truncated");
    const std::string_view raw = bytes_;
    bytes_ = bytes_.substr(size_of(type));
    switch (type) {
      case Scalar::int8:
        return from_bytes<std::int8_t>(raw, order);
      case Scalar::uint8:
        return from_bytes<std::uint8_t>(raw, order);
      case Scalar::int16:
        return from_bytes<std::int16_t>(raw, order);
      case Scalar::uint16:
        return from_bytes<std::uint16_t>(raw, order);
      case Scalar::int32:
        return from_bytes<std::int32_t>(raw, order);
      case Scalar::uint32:
        return from_bytes<std::uint32_t>(raw, order);
      case Scalar::float32:
        return from_bytes<float>(raw, order);
      case Scalar::float64:
        return from_bytes<double>(raw, order);
    }
    return 0;
  }

  /// Length of a list: a whole number no larger than what the file can still hold.
  std::uint64_t next_length(const Property& property) {
    const double length = next(*property.list_count);
    const std::size_t left = encoding_ == Encoding::ascii ? scan_.rest().size() + 4096 : bytes_.size();
    if (!(length >= 0) || length != std::floor(length)) fail("the length of its list is not a count");
    if (length > static_cast<double>(left))
      fail("its list is longer than the file; it is truncated or damaged");
    return static_cast<std::uint64_t>(length);
  }

  [[noreturn]] void fail(const std::string& message) const {
    if (encoding_ == Encoding::ascii) scan_.fail(place() + ": " + message);
    fail_in_file(file_, place() + ": " + message);
  }

 private:
  std::string place() const { return element_->name + " " + std::to_string(index_); }

  Encoding encoding_;
  TextScanner& scan_;
  const std::string& file_;
  std::string_view bytes_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0;
};

void skip(Body& body, const Property& property) {
  const std::uint64_t values = property.list_count ? body.next_length(property) : 1;
  for (std::uint64_t k = 0; k < values; ++k)
    body.next(property.type);
}

/// What the vertices of a file carry besides their place.
struct VertexAttributes {
  std::vector<Vec3> normal;
  std::vector<Vec2> uv;
};

/// 0, 1, 2 for the place of `name` in one of the groups, −1 otherwise.
int component(std::string_view name, std::initializer_list<std::array<std::string_view, 3>> groups) {
  for (const auto& group : groups)
    for (int k = 0; k < 3; ++k)
      if (name == group[static_cast<std::size_t>(k)]) return k;
  return -1;
}
int position_component(const Property& p) {
  return p.list_count ? -1 : component(p.name, {{"x", "y", "z"}});
}
int normal_component(const Property& p) {
  return p.list_count ? -1 : component(p.name, {{"nx", "ny", "nz"}});
}
int uv_component(const Property& p) {
  return p.list_count ? -1
                      : component(p.name, {{"s", "t", "-"},
                                           {"u", "v", "-"},
                                           {"texture_u", "texture_v", "-"},
                                           {"texture_s", "texture_t", "-"}});
}

void read_vertex(Body& body, const Element& element, TriMesh& mesh, VertexAttributes& attributes) {
  Vec3 x = Vec3::Zero(), normal = Vec3::Zero();
  Vec2 uv = Vec2::Zero();
  bool has_normal = false, has_uv = false;
  for (const Property& property : element.properties) {
    if (const int axis = position_component(property); axis >= 0) {
      x[axis] = body.next(property.type);
    } else if (const int n = normal_component(property); n >= 0) {
      normal[n] = body.next(property.type);
      has_normal = true;
    } else if (const int t = uv_component(property); t >= 0) {
      uv[t] = body.next(property.type);
      has_uv = true;
    } else {
      skip(body, property);
    }
  }
  if (!x.allFinite()) body.fail("a coordinate is not finite; repair it");
  if (!normal.allFinite() || !uv.allFinite())
    body.fail("a normal or texture coordinate is not finite; repair or remove it");
  mesh.positions.push_back(x);
  if (has_normal) attributes.normal.push_back(normal);
  if (has_uv) attributes.uv.push_back(uv);
}

bool holds_corners(const Property& property) {
  return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}
bool holds_uv(const Property& property) {
  return property.list_count && property.name == "texcoord";
}
bool holds_normals(const Property& property) {
  return property.list_count && property.name == "normals";
}
bool holds_material(const Property& property) {
  return !property.list_count && (property.name == "material_index" || property.name == "material");
}

void read_corners(Body& body, const Property& property, std::uint64_t vertex_count,
                  std::vector<NodeId>& polygon) {
  const std::uint64_t corners = body.next_length(property);
  if (corners < 3) body.fail("has fewer than three corners");
  for (std::uint64_t k = 0; k < corners; ++k) {
    const double index = body.next(property.type);
    if (!(index >= 0) || index >= static_cast<double>(vertex_count) || index != std::floor(index))
      body.fail("a vertex index is out of range 0 … " +
                std::to_string(static_cast<std::int64_t>(vertex_count) - 1));
    polygon.push_back(NodeId(static_cast<std::size_t>(index)));
  }
}

/// Normals or texture coordinates of the corners of a face, one after the other.
std::vector<double> read_list(Body& body, const Property& property) {
  std::vector<double> values;
  for (std::uint64_t k = body.next_length(property); k > 0; --k)
    values.push_back(body.next(property.type));
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    body.fail("a normal or texture coordinate is not finite; repair or remove it");
  return values;
}

void read_face(Body& body, const Element& element, std::uint64_t vertex_count, AttributedMesh& surface,
               AttributeCollector& attributes) {
  TriMesh& mesh = surface.mesh;
  std::vector<NodeId> polygon;
  std::vector<double> uv, normal;
  for (const Property& property : element.properties) {
    if (holds_corners(property)) {
      read_corners(body, property, vertex_count, polygon);
    } else if (holds_uv(property)) {
      uv = read_list(body, property);
    } else if (holds_normals(property)) {
      normal = read_list(body, property);
    } else if (holds_material(property)) {
      const double id = body.next(property.type);
      if (!(std::abs(id) < 1e9) || id != std::floor(id)) body.fail("its material is not a whole number");
      attributes.use_material("material_" + std::to_string(static_cast<int>(id)));
    } else {
      skip(body, property);
    }
  }
  const std::size_t first = mesh.triangle_count();
  add_polygon(mesh, polygon);
  for (std::size_t t = first; t < mesh.triangle_count(); ++t) {
    attributes.add_triangle(t);
    for (int k = 0; k < 3; ++k) {
      const std::size_t c = polygon_corner(t - first, k);
      if (uv.size() == 2 * polygon.size()) attributes.add_uv(t, k, {uv[2 * c], uv[2 * c + 1]});
      if (normal.size() == 3 * polygon.size())
        attributes.add_normal(t, k, {normal[3 * c], normal[3 * c + 1], normal[3 * c + 2]});
    }
  }
}

/// Gives the corners what their vertices carry; what faces have of their own stays.
void spread(const TriMesh& mesh, const VertexAttributes& vertex, AttributeCollector& attributes) {
  const bool faces_have_uv = attributes.has_uv(), faces_have_normal = attributes.has_normal();
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::size_t node = mesh.corners[TriId(t)][static_cast<std::size_t>(k)].index();
      if (!faces_have_normal && node < vertex.normal.size()) attributes.add_normal(t, k, vertex.normal[node]);
      if (!faces_have_uv && node < vertex.uv.size()) attributes.add_uv(t, k, vertex.uv[node]);
    }
}

const Element& element_named(const Header& header, std::string_view name, const std::string& file) {
  for (const Element& element : header.elements)
    if (element.name == name) return element;
  fail_in_file(file,
               "has no element '" + std::string(name) + "'; export the surface with vertices and faces");
}

void require_properties(const Header& header, const std::string& file) {
  const Element& vertex = element_named(header, "vertex", file);
  for (const char* axis : {"x", "y", "z"})
    if (std::none_of(vertex.properties.begin(), vertex.properties.end(),
                     [&](const Property& p) { return p.name == axis && !p.list_count; }))
      fail_in_file(file, "its vertices have no property '" + std::string(axis) + "'");
  const Element& face = element_named(header, "face", file);
  if (std::none_of(face.properties.begin(), face.properties.end(), holds_corners))
    fail_in_file(file, "its faces have no list 'vertex_indices'; export faces, not strips");
}

}  // namespace

AttributedMesh read_ply(std::string_view bytes, const std::string& file) {
  TextScanner scan(bytes, file);
  const Header header = read_header(scan, file, bytes.size());
  require_properties(header, file);
  const std::uint64_t vertex_count = element_named(header, "vertex", file).count;
  Body body(header.encoding, scan, file);
  AttributedMesh surface;
  VertexAttributes vertex;
  AttributeCollector attributes;
  for (const Element& element : header.elements)
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (element.properties.empty()) break;
      body.at(element, i);
      if (element.name == "vertex")
        read_vertex(body, element, surface.mesh, vertex);
      else if (element.name == "face")
        read_face(body, element, vertex_count, surface, attributes);
      else
        for (const Property& property : element.properties)
          skip(body, property);
    }
  spread(surface.mesh, vertex, attributes);
  surface.attributes = attributes.finish(surface.mesh.triangle_count());
  return surface;
}

void write_ply(std::ostream& out, const TriMesh& mesh) {
  out << "ply\nformat binary_little_endian 1.0\ncomment written by conchoid, metres\n"
      << "element vertex " << mesh.node_count()
      << "\nproperty double x\nproperty double y\nproperty double z\n"
      << "element face " << mesh.triangle_count() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& x : mesh.positions)
    for (int k = 0; k < 3; ++k)
      write_little_endian(out, x[k]);
  for (const auto& corners : mesh.corners) {
    write_little_endian(out, std::uint8_t{3});
    for (NodeId corner : corners)
      write_little_endian(out, corner.value);
  }
}

}  // namespace conchoid
