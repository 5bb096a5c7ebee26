// Binary glTF 2.0 (Khronos): a 12-byte header, a JSON chunk and a chunk of bytes. Read are the triangles of the
// meshes that the default scene shows, each where its node puts it.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"
#include "conchoid/mesh/place.hpp"

namespace conchoid {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

/// x → turn · x + shift.
struct Placement {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return turn * x + shift; }
  Placement operator*(const Placement& inner) const {
    return {turn * inner.turn, turn * inner.shift + shift};
  }
  /// Matrix of cofactors: turns normals, whatever the scale and the mirroring.
  Vec3 normal(const Vec3& n) const {
    const Vec3 x = turn.col(0), y = turn.col(1), z = turn.col(2);
    return cross(y, z) * n.x() + cross(z, x) * n.y() + cross(x, y) * n.z();
  }
  bool mirrors() const { return cross(turn.col(0), turn.col(1)).dot(turn.col(2)) < 0; }
};

enum class Component {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

std::size_t size_of(Component type) {
  switch (type) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    default:
      return 4;
  }
}

double value(std::string_view raw, Component type) {
  switch (type) {
    case Component::int8:
      return from_bytes<std::int8_t>(raw);
    case Component::uint8:
      return from_bytes<std::uint8_t>(raw);
    case Component::int16:
      return from_bytes<std::int16_t>(raw);
    case Component::uint16:
      return from_bytes<std::uint16_t>(raw);
    case Component::uint32:
      return from_bytes<std::uint32_t>(raw);
    default:
      return from_bytes<float>(raw);
  }
}

/// What a whole number of that type stands for in an accessor that is "normalized".
double largest(Component type) {
  switch (type) {
    case Component::int8:
      return 127;
    case Component::uint8:
      return 255;
    case Component::int16:
      return 32767;
    case Component::uint16:
      return 65535;
    default:
      return 1;
  }
}

class GlbReader {
 public:
  GlbReader(std::string_view bytes, const std::string& file) : file_(file), skipped_(file), weld_(mesh_) {
    split(bytes);
  }

  AttributedMesh run() {
    for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
      if (const Json& required = member(document_, "extensionsRequired"); required.is_array())
        for (const Json& name : required)
          if (name == extension)
            fail(std::string("its meshes are compressed (") + extension + "); export it without compression");
    for (const std::size_t root : roots())
      add_node(root, {}, 0);
    skipped_.warn();
    SurfaceAttributes attributes = attributes_.finish(mesh_.triangle_count());
    return {std::move(mesh_), std::move(attributes)};
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { fail_in_file(file_, message); }

  void split(std::string_view bytes) {
    if (bytes.size() < 20 || from_bytes<std::uint32_t>(bytes) != magic)
      fail("does not start with 'glTF'; it is not a binary .glb file");
    const auto version = from_bytes<std::uint32_t>(bytes.substr(4));
    if (version != 2) fail("is glTF version " + std::to_string(version) + "; export version 2");
    bytes = bytes.substr(12);
    std::string_view text;
    bool has_text = false;
    while (bytes.size() >= 8) {
      const std::size_t size = from_bytes<std::uint32_t>(bytes);
      const auto kind = from_bytes<std::uint32_t>(bytes.substr(4));
      bytes = bytes.substr(8);
      if (size > bytes.size()) fail("a chunk is longer than the file; it is truncated");
      if (kind == json_chunk && !has_text) {
        text = bytes.substr(0, size);
        has_text = true;
      } else if (kind == binary_chunk && binary_.empty()) {
        binary_ = bytes.substr(0, size);
      }
      bytes = bytes.substr(size);
    }
    document_ = Json::parse(text, nullptr, false);
    if (!document_.is_object()) fail("its JSON chunk is damaged; export it again");
  }

  static const Json& member(const Json& object, const char* name) {
    static const Json none;
    if (!object.is_object()) return none;
    const auto found = object.find(name);
    return found == object.end() ? none : *found;
  }

  /// Entry `index` of one of the document's lists.
  const Json& entry(const char* list, std::size_t index) const {
    const Json& all = member(document_, list);
    if (!all.is_array() || index >= all.size() || !all[index].is_object())
      fail(std::string(list) + " has no entry " + std::to_string(index) + "; the file is damaged");
    return all[index];
  }

  /// A whole number ≥ 0.
  std::size_t whole(const Json& object, const char* name, std::optional<std::size_t> usual = {}) const {
    const Json& found = member(object, name);
    if (found.is_null() && usual) return *usual;
    if (!found.is_number_unsigned())
      fail(std::string("'") + name + "' is not a whole number; the file is damaged");
    return found.get<std::size_t>();
  }

  std::vector<double> numbers(const Json& list, std::size_t count, const char* name) const {
    if (!list.is_array() || list.size() != count) fail(std::string(name) + " of a node is damaged");
    std::vector<double> out;
    for (const Json& x : list) {
      if (!x.is_number() || !std::isfinite(x.get<double>()))
        fail(std::string(name) + " of a node is damaged");
      out.push_back(x.get<double>());
    }
    return out;
  }

  std::vector<std::size_t> indices(const Json& list) const {
    std::vector<std::size_t> out;
    if (!list.is_array()) return out;
    for (const Json& i : list) {
      if (!i.is_number_unsigned()) fail("a list of nodes is damaged");
      out.push_back(i.get<std::size_t>());
    }
    return out;
  }

  /// Nodes of the default scene; without scenes, those that are nobody's child.
  std::vector<std::size_t> roots() const {
    const Json &scenes = member(document_, "scenes"), &nodes = member(document_, "nodes");
    if (scenes.is_array() && !scenes.empty())
      return indices(member(entry("scenes", whole(document_, "scene", 0)), "nodes"));
    std::vector<char> is_child(nodes.is_array() ? nodes.size() : 0, 0);
    for (std::size_t n = 0; n < is_child.size(); ++n)
      for (const std::size_t child : indices(member(nodes[n], "children")))
        if (child < is_child.size()) is_child[child] = 1;
    std::vector<std::size_t> out;
    for (std::size_t n = 0; n < is_child.size(); ++n)
      if (!is_child[n]) out.push_back(n);
    return out;
  }

  Placement placement(const Json& node) const {
    Placement p;
    if (const Json& matrix = member(node, "matrix"); !matrix.is_null()) {
      const std::vector<double> m = numbers(matrix, 16, "the matrix");  // column by column
      for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
          p.turn(row, column) = m[static_cast<std::size_t>(4 * column + row)];
      p.shift = Vec3(m[12], m[13], m[14]);
      return p;
    }
    if (const Json& rotation = member(node, "rotation"); !rotation.is_null()) {
      const std::vector<double> q = numbers(rotation, 4, "the rotation");
      const Vec3 v(q[0], q[1], q[2]);
      for (int k = 0; k < 3; ++k) {  // unit quaternion: x + 2 v × (v × x + w x)
        const Vec3 x = Vec3::Unit(k);
        p.turn.col(k) = x + 2 * cross(v, cross(v, x) + q[3] * x);
      }
    }
    if (const Json& scale = member(node, "scale"); !scale.is_null()) {
      const std::vector<double> s = numbers(scale, 3, "the scale");
      for (int k = 0; k < 3; ++k)
        p.turn.col(k) *= s[static_cast<std::size_t>(k)];
    }
    if (const Json& shift = member(node, "translation"); !shift.is_null()) {
      const std::vector<double> t = numbers(shift, 3, "the translation");
      p.shift = Vec3(t[0], t[1], t[2]);
    }
    return p;
  }

  void add_node(std::size_t index, const Placement& outer, std::size_t depth) {
    const Json& node = entry("nodes", index);
    const std::size_t all = member(document_, "nodes").size();
    if (depth > std::min<std::size_t>(all, 1000) || ++visits_ > 100 * all)
      fail("its nodes are their own children; the file is damaged");
    const Placement here = outer * placement(node);
    if (!member(node, "mesh").is_null()) {
      const Json& primitives = member(entry("meshes", whole(node, "mesh")), "primitives");
      if (!primitives.is_array()) fail("a mesh has no primitives; the file is damaged");
      for (const Json& primitive : primitives)
        add_primitive(primitive, here);
    }
    for (const std::size_t child : indices(member(node, "children")))
      add_node(child, here, depth + 1);
  }

  /// All numbers of an accessor, `width` for each of its elements.
  std::vector<double> values(std::size_t index, std::size_t width) const {
    const Json& accessor = entry("accessors", index);
    const std::string name = "accessor " + std::to_string(index);
    const std::string shape = width == 1 ? "SCALAR" : "VEC" + std::to_string(width);
    if (member(accessor, "type") != shape) fail(name + " is not of type " + shape + "; the file is damaged");
    if (!member(accessor, "sparse").is_null())
      fail(name + " is sparse, which is not read; export it without sparse accessors");
    const std::size_t type_number = whole(accessor, "componentType");
    if (type_number < 5120 || type_number > 5126 || type_number == 5124)
      fail(name + " has an unknown component type; the file is damaged");
    const auto type = static_cast<Component>(type_number);
    const bool normalized = member(accessor, "normalized") == true;
    const std::size_t count = whole(accessor, "count");
    const std::size_t element = width * size_of(type);
    const Json& view = entry("bufferViews", whole(accessor, "bufferView"));
    if (whole(view, "buffer") != 0 || !member(entry("buffers", 0), "uri").is_null())
      fail("its numbers lie in another file; export one .glb with everything in it");
    const std::size_t stride = whole(view, "byteStride", element);
    const std::size_t offset = whole(view, "byteOffset", 0), length = whole(view, "byteLength");
    const std::size_t first = whole(accessor, "byteOffset", 0);
    if (offset > binary_.size() || length > binary_.size() - offset || stride < element)
      fail(name + " lies outside of the file's bytes; it is truncated or damaged");
    if (count > 0 &&
        (first > length || element > length - first || count - 1 > (length - first - element) / stride))
      fail(name + " is longer than its bytes; the file is truncated or damaged");
    std::vector<double> out;
    out.reserve(count * width);
    const std::string_view bytes = binary_.substr(offset, length);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < width; ++k) {
        const double x = value(bytes.substr(first + i * stride + k * size_of(type)), type);
        if (!std::isfinite(x)) fail(name + " has a number that is not finite; repair it");
        out.push_back(normalized ? std::max(-1.0, x / largest(type)) : x);
      }
    return out;
  }

  std::vector<std::array<std::size_t, 3>> triangles(const std::vector<std::size_t>& list, std::size_t mode) {
    std::vector<std::array<std::size_t, 3>> out;
    if (mode == 4)
      for (std::size_t i = 0; i + 2 < list.size(); i += 3)
        out.push_back({list[i], list[i + 1], list[i + 2]});
    if (mode == 5)
      for (std::size_t i = 0; i + 2 < list.size(); ++i)
        out.push_back({list[i], list[i + 1 + i % 2], list[i + 2 - i % 2]});
    if (mode == 6)
      for (std::size_t i = 0; i + 2 < list.size(); ++i)
        out.push_back({list[i + 1], list[i + 2], list[0]});
    if (mode != 4)  // degenerate ones only lead a strip to another place
      std::erase_if(out, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    return out;
  }

  void add_primitive(const Json& primitive, const Placement& place) {
    const std::size_t mode = whole(primitive, "mode", 4);
    if (mode > 6) fail("a primitive has the unknown mode " + std::to_string(mode) + "; the file is damaged");
    if (mode < 4) return skipped_.add(mode == 0 ? "primitives of points" : "primitives of lines");
    const Json& attributes = member(primitive, "attributes");
    if (member(attributes, "POSITION").is_null()) return skipped_.add("primitives without positions");
    const std::vector<double> x = values(whole(attributes, "POSITION"), 3);
    const std::size_t vertices = x.size() / 3;
    const auto of_vertices = [&](const char* name, std::size_t width) {
      std::vector<double> out;
      if (!member(attributes, name).is_null()) out = values(whole(attributes, name), width);
      return out.size() == width * vertices ? out : std::vector<double>();
    };
    const std::vector<double> normal = of_vertices("NORMAL", 3), uv = of_vertices("TEXCOORD_0", 2);

    std::vector<std::size_t> list;
    if (member(primitive, "indices").is_null()) {
      for (std::size_t i = 0; i < vertices; ++i)
        list.push_back(i);
    } else {
      for (const double i : values(whole(primitive, "indices"), 1)) {
        if (!(i >= 0) || i >= static_cast<double>(vertices))
          fail("a vertex index is out of range 0 … " + std::to_string(vertices) +
               " − 1; the file is damaged");
        list.push_back(static_cast<std::size_t>(i));
      }
    }
    const Json& material = member(primitive, "material");
    if (const Json& all = member(document_, "materials"); all.is_array() && !all.empty())
      attributes_.use_material(material.is_null() ? "default" : material_name(whole(primitive, "material")));
    const auto vector = [](const std::vector<double>& all, std::size_t i) {
      return Vec3(all[3 * i], all[3 * i + 1], all[3 * i + 2]);
    };
    for (std::array<std::size_t, 3> t : triangles(list, mode)) {
      if (place.mirrors()) std::swap(t[1], t[2]);
      const std::size_t id = mesh_.triangle_count();
      mesh_.corners.push_back(
          {weld_(place(vector(x, t[0]))), weld_(place(vector(x, t[1]))), weld_(place(vector(x, t[2])))});
      attributes_.add_triangle(id);
      for (int k = 0; k < 3; ++k) {
        const std::size_t i = t[static_cast<std::size_t>(k)];
        if (!normal.empty())
          attributes_.add_normal(id, k, (place.mirrors() ? -1 : 1) * place.normal(vector(normal, i)));
        if (!uv.empty()) attributes_.add_uv(id, k, {uv[2 * i], 1 - uv[2 * i + 1]});  // glTF counts v downward
      }
    }
  }

  std::string material_name(std::size_t index) const {
    const Json& name = member(entry("materials", index), "name");
    return name.is_string() ? name.get<std::string>() : "material_" + std::to_string(index);
  }

  const std::string& file_;
  SkippedElements skipped_;
  Json document_;
  std::string_view binary_;
  TriMesh mesh_;
  NodeWelder weld_;  // glTF repeats a vertex where its normal or texture coordinates differ
  AttributeCollector attributes_;
  std::size_t visits_ = 0;
};

}  // namespace

AttributedMesh read_glb(std::string_view bytes, const std::string& file) {
  return GlbReader(bytes, file).run();
}

}  // namespace conchoid
