#include "conchoid/io/ply.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/byte_order.hpp"
#include "conchoid/io/colors.hpp"

namespace conchoid {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float64;
  bool list = false;
  Type count_type = Type::uint8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = false;
  std::vector<Element> elements;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what + "; write the file again or give another one");
}

Type type_named(const std::filesystem::path& path, const std::string& name) {
  if (name == "char" || name == "int8") return Type::int8;
  if (name == "uchar" || name == "uint8") return Type::uint8;
  if (name == "short" || name == "int16") return Type::int16;
  if (name == "ushort" || name == "uint16") return Type::uint16;
  if (name == "int" || name == "int32") return Type::int32;
  if (name == "uint" || name == "uint32") return Type::uint32;
  if (name == "float" || name == "float32") return Type::float32;
  if (name == "double" || name == "float64") return Type::float64;
  refuse(path, "the PLY header names the unknown type '" + name + "'");
}

/// Numbers of the body of a PLY file, one after the other, from either encoding.
class Numbers {
 public:
  Numbers(const std::filesystem::path& path, const std::string& text, std::size_t begin, bool ascii)
      : path_(path), text_(text), at_(begin), ascii_(ascii) {}

  double next(Type type) {
    if (ascii_) return next_ascii();
    switch (type) {
      case Type::int8:
        return next_binary<std::int8_t>();
      case Type::uint8:
        return next_binary<std::uint8_t>();
      case Type::int16:
        return next_binary<std::int16_t>();
      case Type::uint16:
        return next_binary<std::uint16_t>();
      case Type::int32:
        return next_binary<std::int32_t>();
      case Type::uint32:
        return next_binary<std::uint32_t>();
      case Type::float32:
        return next_binary<float>();
      case Type::float64:
        break;
    }
    return next_binary<double>();
  }
  std::size_t bytes_left() const { return text_.size() - at_; }

 private:
  template <class T>
  double next_binary() {
    if (bytes_left() < sizeof(T)) refuse(path_, "the file ends before all its elements (truncated)");
    T value;
    std::memcpy(&value, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return static_cast<double>(value);
  }
  double next_ascii() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
      ++at_;
    if (at_ == text_.size()) refuse(path_, "the file ends before all its elements (truncated)");
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) refuse(path_, "byte " + std::to_string(at_) + " is not part of a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  const std::filesystem::path& path_;
  const std::string& text_;
  std::size_t at_;
  bool ascii_;
};

Header read_header(const std::filesystem::path& path, const std::string& text, std::size_t& body) {
  Header header;
  if (text.compare(0, 3, "ply") != 0) refuse(path, "this is not a PLY file (it does not begin with 'ply')");
  std::size_t at = 0;
  for (int line_number = 1;; ++line_number) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) refuse(path, "the PLY header has no 'end_header'");
    std::istringstream line(text.substr(at, end - at));
    at = end + 1;
    std::string word;
    line >> word;
    if (word == "end_header") break;
    if (word == "format") {
      line >> word;
      if (word != "ascii" && word != "binary_little_endian")
        refuse(path, "line " + std::to_string(line_number) + ": the format '" + word + "' is not supported");
      header.ascii = word == "ascii";
    } else if (word == "element") {
      Element element;
      if (!(line >> element.name >> element.count))
        refuse(path, "line " + std::to_string(line_number) + ": an element needs a name and a count");
      header.elements.push_back(element);
    } else if (word == "property") {
      if (header.elements.empty())
        refuse(path, "line " + std::to_string(line_number) + ": property before any element");
      Property property;
      line >> word;
      if (word == "list") {
        property.list = true;
        line >> word;
        property.count_type = type_named(path, word);
        line >> word;
      }
      property.type = type_named(path, word);
      line >> property.name;
      header.elements.back().properties.push_back(property);
    }
  }
  body = at;
  return header;
}

void read_vertices(const std::filesystem::path& path, const Element& element, Numbers& numbers,
                   PlyMesh& out) {
  for (std::size_t v = 0; v < element.count; ++v) {
    Vec3 x = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    for (const Property& p : element.properties) {
      if (p.list) refuse(path, "vertices with lists are not supported");
      const double value = numbers.next(p.type);
      if (p.name == "x") x[0] = value;
      if (p.name == "y") x[1] = value;
      if (p.name == "z") x[2] = value;
    }
    if (!x.allFinite()) refuse(path, "vertex " + std::to_string(v) + " has no finite x, y, z");
    out.mesh.positions.add(x);
  }
}

NodeId corner(const std::filesystem::path& path, double value, std::size_t node_count, std::size_t face) {
  if (!(value >= 0 && value < static_cast<double>(node_count)))
    refuse(path, "face " + std::to_string(face) + " names a vertex that does not exist");
  return NodeId(static_cast<std::size_t>(value));
}

void read_faces(const std::filesystem::path& path, const Element& element, Numbers& numbers, PlyMesh& out) {
  for (std::size_t f = 0; f < element.count; ++f) {
    for (const Property& p : element.properties) {
      if (!p.list) {
        const double value = numbers.next(p.type);
        if (p.name == "kind") out.face_kind.push_back(value == 0 ? FaceKind::original : FaceKind::fracture);
        if (p.name == "source") out.source.push_back(TriId(static_cast<std::int32_t>(value)));
        if (p.name == "frame") out.frame.push_back(static_cast<int>(value));
        continue;
      }
      const double count = numbers.next(p.count_type);
      if (p.name != "vertex_indices" && p.name != "vertex_index") {
        for (double i = 0; i < count; ++i)
          numbers.next(p.type);
        continue;
      }
      if (count != 3) refuse(path, "face " + std::to_string(f) + " is not a triangle");
      std::array<NodeId, 3> corners;
      for (NodeId& c : corners)
        c = corner(path, numbers.next(p.type), out.mesh.node_count(), f);
      out.mesh.corners.add(corners);
    }
    if (out.mesh.triangle_count() != f + 1) refuse(path, "faces have no 'vertex_indices'");
  }
}

/// The vectors of the three corners as one list of single precision.
template <class T>
void append_list(std::string& bytes, const std::array<T, 3>& corners) {
  append_bytes(bytes, static_cast<std::uint8_t>(3 * T::RowsAtCompileTime));
  for (const T& corner : corners)
    for (const double component : corner)
      append_bytes(bytes, static_cast<float>(component));
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PlyMesh& ply) {
  const TriMesh& mesh = ply.mesh;
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\ncomment conchoid, lengths in metres\n"
         << "element vertex " << mesh.node_count()
         << "\nproperty double x\nproperty double y\nproperty double z\n"
         << (ply.normal.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n")
         << "element face " << mesh.triangle_count() << "\nproperty list uchar int vertex_indices\n";
  if (!ply.face_kind.empty())
    header << "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar kind\n";
  if (!ply.source.empty()) header << "property int source\n";
  if (!ply.frame.empty()) header << "property int frame\n";
  if (!ply.material.empty()) header << "property int material\n";
  if (!ply.uv.empty()) header << "property list uchar float texcoord\n";
  if (!ply.corner_normal.empty()) header << "property list uchar float normals\n";
  header << "end_header\n";

  std::string bytes;
  bytes.reserve(36 * mesh.node_count() + 32 * mesh.triangle_count());
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    for (int i = 0; i < 3; ++i)
      append_bytes(bytes, mesh.positions[NodeId(n)][i]);
    for (int i = 0; i < 3 && !ply.normal.empty(); ++i)
      append_bytes(bytes, static_cast<float>(ply.normal[NodeId(n)][i]));
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    append_bytes(bytes, std::uint8_t{3});
    for (NodeId c : mesh.corners[TriId(t)])
      append_bytes(bytes, c.value);
    if (!ply.face_kind.empty()) {
      for (std::uint8_t byte : to_bytes(color_of(ply.face_kind[t])))
        append_bytes(bytes, byte);
      append_bytes(bytes, static_cast<std::uint8_t>(ply.face_kind[t]));
    }
    if (!ply.source.empty()) append_bytes(bytes, ply.source[t].value);
    if (!ply.frame.empty()) append_bytes(bytes, std::int32_t{ply.frame[t]});
    if (!ply.material.empty()) append_bytes(bytes, std::int32_t{ply.material[t]});
    if (!ply.uv.empty()) append_list(bytes, ply.uv[t]);
    if (!ply.corner_normal.empty()) append_list(bytes, ply.corner_normal[t]);
  }
  AtomicFile file(path);
  file.stream() << header.str();
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.commit();
}

PlyMesh read_ply(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be opened; check the name and the permissions");
  std::ostringstream content;
  content << in.rdbuf();
  const std::string text = content.str();

  std::size_t body = 0;
  const Header header = read_header(path, text, body);
  Numbers numbers(path, text, body, header.ascii);
  PlyMesh out;
  for (const Element& element : header.elements) {
    if (element.count > numbers.bytes_left())
      refuse(path, "the file ends before all its elements (truncated)");
    if (element.name == "vertex") {
      read_vertices(path, element, numbers, out);
    } else if (element.name == "face") {
      read_faces(path, element, numbers, out);
    } else {
      for (std::size_t i = 0; i < element.count; ++i)
        for (const Property& p : element.properties) {
          const double count = p.list ? numbers.next(p.count_type) : 1;
          for (double k = 0; k < count; ++k)
            numbers.next(p.type);
        }
    }
  }
  return out;
}

}  // namespace conchoid
