#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/formats/mesh_text.hpp"
#include "conchoid/formats/ply.hpp"
#include "conchoid/formats/ply_header.hpp"

namespace conchoid {
namespace {

using ply::Element, ply::Encoding, ply::Property, ply::Scalar;

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

bool holds_uv(const Property& property) {
  return property.list_count && property.name == "texcoord";
}
bool holds_normals(const Property& property) {
  return property.list_count && property.name == "normals";
}
bool holds_material(const Property& property) {
  return !property.list_count && (property.name == "material_index" || property.name == "material");
}

NodeId vertex_of(const Body& body, double index, std::uint64_t vertex_count) {
  if (!(index >= 0) || index >= static_cast<double>(vertex_count) || index != std::floor(index))
    body.fail("a vertex index is out of range 0 … " +
              std::to_string(static_cast<std::int64_t>(vertex_count) - 1));
  return NodeId(static_cast<std::size_t>(index));
}

void read_corners(Body& body, const Property& property, std::uint64_t vertex_count,
                  std::vector<NodeId>& polygon) {
  const std::uint64_t corners = body.next_length(property);
  if (corners < 3) body.fail("has fewer than three corners");
  for (std::uint64_t k = 0; k < corners; ++k)
    polygon.push_back(vertex_of(body, body.next(property.type), vertex_count));
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

int read_integer(Body& body, const Property& property) {
  const double value = body.next(property.type);
  if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value))
    body.fail("its " + property.name + " is not a whole number of 32 bits; repair or remove it");
  return static_cast<int>(value);
}

/// Where a property of ours that is one whole number per face is kept; null for any other.
std::vector<int>* tag_list(const Property& property, PlyMesh& ply) {
  if (property.list_count || property.type == Scalar::float32 || property.type == Scalar::float64)
    return nullptr;
  if (property.name == "kind") return &ply.kind;
  if (property.name == "source") return &ply.source;
  if (property.name == "frame") return &ply.frame;
  return nullptr;
}

/// Fills the mesh and its attributes element by element.
class SurfaceReader {
 public:
  SurfaceReader(std::uint64_t vertex_count, const std::string& file)
      : vertex_count_(vertex_count), file_(file) {}

  void read_vertex(Body& body, const Element& element);
  void read_face(Body& body, const Element& element);
  void read_strips(Body& body, const Element& element);
  PlyMesh finish();

 private:
  void add_strip(const std::vector<NodeId>& strip);
  void turn_strips_outward();

  std::uint64_t vertex_count_;
  bool only_strips_ = true;
  const std::string& file_;
  PlyMesh out_;
  std::vector<Vec2> node_uv_;
  AttributeCollector attributes_;
};

void SurfaceReader::read_vertex(Body& body, const Element& element) {
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
  out_.mesh.positions.push_back(x);
  if (has_normal) out_.node_normal.push_back(normal);
  if (has_uv) node_uv_.push_back(uv);
}

void SurfaceReader::read_face(Body& body, const Element& element) {
  std::vector<NodeId> polygon;
  std::vector<double> uv, normal;
  std::vector<std::pair<std::vector<int>*, int>> tags;
  for (const Property& property : element.properties) {
    if (holds_corners(property)) {
      read_corners(body, property, vertex_count_, polygon);
    } else if (holds_uv(property)) {
      uv = read_list(body, property);
    } else if (holds_normals(property)) {
      normal = read_list(body, property);
    } else if (holds_material(property)) {
      attributes_.use_material("material_" + std::to_string(read_integer(body, property)));
    } else if (std::vector<int>* list = tag_list(property, out_)) {
      tags.emplace_back(list, read_integer(body, property));
    } else {
      skip(body, property);
    }
  }
  only_strips_ = false;
  std::size_t t = out_.mesh.triangle_count();
  const std::vector<PolygonTriangle> triangles = add_polygon(out_.mesh, polygon);
  for (const auto& [list, value] : tags)
    list->resize(out_.mesh.triangle_count(), value);
  for (const PolygonTriangle& places : triangles) {
    attributes_.add_triangle(t);
    for (int k = 0; k < 3; ++k) {
      const std::size_t c = places[static_cast<std::size_t>(k)];
      if (uv.size() == 2 * polygon.size()) attributes_.add_uv(t, k, {uv[2 * c], uv[2 * c + 1]});
      if (normal.size() == 3 * polygon.size())
        attributes_.add_normal(t, k, {normal[3 * c], normal[3 * c + 1], normal[3 * c + 2]});
    }
    ++t;
  }
}

/// Strips of triangles one after the other, with −1 between two. Every second triangle of a strip is wound the
/// other way; those that name a node twice only lead the strip to another place.
void SurfaceReader::read_strips(Body& body, const Element& element) {
  for (const Property& property : element.properties) {
    if (!holds_corners(property)) {
      skip(body, property);
      continue;
    }
    std::vector<NodeId> strip;
    for (std::uint64_t k = body.next_length(property); k > 0; --k) {
      const double index = body.next(property.type);
      if (index == -1) {
        add_strip(strip);
        strip.clear();
      } else {
        strip.push_back(vertex_of(body, index, vertex_count_));
      }
    }
    add_strip(strip);
  }
}

void SurfaceReader::add_strip(const std::vector<NodeId>& strip) {
  for (std::size_t k = 2; k < strip.size(); ++k) {
    const NodeId a = strip[k - 2], b = strip[k - 1], c = strip[k];
    if (a == b || b == c || c == a) continue;
    k % 2 == 0 ? out_.mesh.corners.push_back({a, b, c}) : out_.mesh.corners.push_back({b, a, c});
  }
}

/// Programs do not agree on the side from which the first triangle of a strip is counter-clockwise. A surface
/// made of strips alone is taken for that of a body: the side away from its inside.
void SurfaceReader::turn_strips_outward() {
  if (!only_strips_ || out_.mesh.corners.empty()) return;
  const Vec3 center = bounding_box(out_.mesh).center();
  TriMesh centred = out_.mesh;
  for (Vec3& x : centred.positions)
    x -= center;
  if (!(enclosed_volume(centred) < 0)) return;
  for (auto& c : out_.mesh.corners)
    std::swap(c[1], c[2]);
  warning(file_ + ": its strips are wound the other way round; they were turned to look outward");
}

/// Gives the corners what their vertices carry; what faces have of their own stays.
PlyMesh SurfaceReader::finish() {
  turn_strips_outward();
  const bool faces_have_uv = attributes_.has_uv(), faces_have_normal = attributes_.has_normal();
  for (std::size_t t = 0; t < out_.mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const NodeId node = out_.mesh.corners[TriId(t)][static_cast<std::size_t>(k)];
      if (!faces_have_normal && node.index() < out_.node_normal.size())
        attributes_.add_normal(t, k, out_.node_normal[node]);
      if (!faces_have_uv && node.index() < node_uv_.size()) attributes_.add_uv(t, k, node_uv_[node.index()]);
    }
  out_.attributes = attributes_.finish(out_.mesh.triangle_count());
  return std::move(out_);
}

}  // namespace

PlyMesh read_ply(std::string_view bytes, const std::string& file) {
  TextScanner scan(bytes, file);
  const ply::Header header = ply::read_header(scan, file, bytes.size());
  require_surface(header, file);
  SurfaceReader reader(element_named(header, "vertex", file).count, file);
  enum class Part { vertices, triangles };
  const auto read = [&](TextScanner from, std::initializer_list<Part> parts) {
    const auto wanted = [&](Part part) { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
    Body body(header.encoding, from, file);
    for (const Element& element : header.elements)
      for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        body.at(element, i);
        if (element.name == "vertex" && wanted(Part::vertices))
          reader.read_vertex(body, element);
        else if (element.name == "face" && wanted(Part::triangles))
          reader.read_face(body, element);
        else if (holds_strips(element) && wanted(Part::triangles))
          reader.read_strips(body, element);
        else
          for (const Property& property : element.properties)
            skip(body, property);
      }
  };
  if (ply::comes_before(header, "face", "vertex")) {  // polygons are divided by the places of their vertices
    read(scan, {Part::vertices});
    read(scan, {Part::triangles});
  } else {
    read(scan, {Part::vertices, Part::triangles});
  }
  return reader.finish();
}

PlyMesh read_ply(const std::filesystem::path& path) {
  return read_ply(read_bytes(path), path.string());
}

}  // namespace conchoid
