// Binary glTF 2.0 (Khronos): a 12-byte header, a JSON chunk and a chunk of bytes, each padded to four bytes.
// Every view of the bytes begins at a multiple of four, POSITION accessors state their exact bounds, normals
// have unit length in single precision.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "conchoid/core/byte_order.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/io/colors.hpp"
#include "conchoid/io/fragments_io.hpp"

namespace conchoid {
namespace {

using Json = nlohmann::ordered_json;
using Float3 = std::array<float, 3>;
using Float2 = std::array<float, 2>;

constexpr int gl_float = 5126, gl_unsigned_int = 5125, gl_array_buffer = 34962,
              gl_element_array_buffer = 34963;

/// The triangles of one material, with one vertex per node, shading normal and texture coordinates.
struct Primitive {
  std::vector<Float3> position, normal;
  std::vector<Float2> uv;
  std::vector<std::uint32_t> index;
};

Float3 unit_float(const Vec3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Primitive primitive_of(const Fragment& fragment, const SurfaceAttributes& look, int material) {
  Primitive out;
  std::map<std::tuple<NodeId, Float3, Float2>, std::uint32_t> known;
  for (std::size_t t = 0; t < fragment.mesh.triangle_count(); ++t) {
    if (look.material[t] != material) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId node = fragment.mesh.corners[TriId(t)][k];
      const Float3 normal = unit_float(look.normal[t][k]);
      Float2 uv{};  // glTF counts v downward
      if (!look.uv.empty())
        uv = {static_cast<float>(look.uv[t][k][0]), static_cast<float>(1 - look.uv[t][k][1])};
      const auto [entry, is_new] =
          known.emplace(std::tuple(node, normal, uv), static_cast<std::uint32_t>(out.position.size()));
      if (is_new) {
        const Vec3 x = fragment.mesh.positions[node] - fragment.center_of_mass;
        out.position.push_back(unit_float(x));
        out.normal.push_back(normal);
        if (!look.uv.empty()) out.uv.push_back(uv);
      }
      out.index.push_back(entry->second);
    }
  }
  return out;
}

/// The document under construction: JSON and bytes grow together.
class Document {
 public:
  Document() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "conchoid"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"name", "fragments"}, {"nodes", Json::array({0})}}});
    json_["nodes"] =
        Json::array({{{"name", "body"}, {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}}}});
  }

  void add(const Fragment& fragment, const std::vector<FragmentContact>& contacts) {
    const SurfaceAttributes look = written_attributes(fragment);
    if (!json_.contains("materials"))
      for (const std::string& name : look.materials)
        json_["materials"].push_back(
            material(name, &name == &look.materials.back() ? fracture_color : original_color));
    Json primitives = Json::array();
    for (std::size_t m = 0; m < look.materials.size(); ++m) {
      const Primitive p = primitive_of(fragment, look, static_cast<int>(m));
      if (p.index.empty()) continue;
      Json attributes{{"POSITION", accessor(p.position, true)}, {"NORMAL", accessor(p.normal, false)}};
      if (!p.uv.empty()) attributes["TEXCOORD_0"] = accessor(p.uv, false);
      primitives.push_back(
          {{"attributes", attributes}, {"indices", accessor(p.index)}, {"material", m}, {"mode", 4}});
    }
    const std::size_t number = fragment_count_++;
    const std::string name = fragment_name(number);
    const Vec3& c = fragment.center_of_mass;
    const Mat3& inertia = fragment.inertia;
    Json node{{"name", name},
              {"translation", {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])}},
              {"extras",
               {{"mass", fragment.mass},
                {"volume", fragment.volume},
                {"inertia",
                 {inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(1, 2), inertia(0, 2), inertia(0, 1)}},
                {"watertight", fragment.watertight},
                {"contacts", contacts_of(number, contacts)}}}};
    if (!primitives.empty()) {
      node["mesh"] = json_["meshes"].size();
      json_["meshes"].push_back({{"name", name}, {"primitives", primitives}});
    }
    json_["nodes"][0]["children"].push_back(json_["nodes"].size());
    json_["nodes"].push_back(node);
  }

  std::string bytes() {
    if (!bytes_.empty()) json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    append_bytes(out, std::uint32_t{2});
    const std::size_t total = 12 + 8 + text.size() + (bytes_.empty() ? 0 : 8 + bytes_.size());
    append_bytes(out, static_cast<std::uint32_t>(total));
    append_bytes(out, static_cast<std::uint32_t>(text.size()));
    out += "JSON" + text;
    if (!bytes_.empty()) {
      append_bytes(out, static_cast<std::uint32_t>(bytes_.size()));
      out += std::string("BIN\0", 4) + bytes_;
    }
    return out;
  }

 private:
  static Json contacts_of(std::size_t fragment, const std::vector<FragmentContact>& contacts) {
    Json list = Json::array();
    for (const FragmentContact& c : contacts)
      if (c.first == fragment || c.second == fragment)
        list.push_back({{"fragment", c.first == fragment ? c.second : c.first}, {"area", c.area}});
    return list;
  }

  static Json material(const std::string& name, const Color& color) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {to_linear(color.r), to_linear(color.g), to_linear(color.b), 1.0}},
              {"metallicFactor", 0.0},
              {"roughnessFactor", 0.85}}}};
  }

  std::size_t view(std::size_t begin, int target) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}, {"target", target}});
    return json_["bufferViews"].size() - 1;
  }

  template <std::size_t n>
  std::size_t accessor(const std::vector<std::array<float, n>>& values, bool with_bounds) {
    std::array<float, n> low = values.front(), high = values.front();
    const std::size_t begin = bytes_.size();
    for (const auto& v : values)
      for (std::size_t i = 0; i < n; ++i) {
        low[i] = std::min(low[i], v[i]);
        high[i] = std::max(high[i], v[i]);
        append_bytes(bytes_, v[i]);
      }
    Json entry{{"bufferView", view(begin, gl_array_buffer)},
               {"componentType", gl_float},
               {"count", values.size()},
               {"type", n == 3 ? "VEC3" : "VEC2"}};
    if (with_bounds) {
      entry["min"] = low;
      entry["max"] = high;
    }
    json_["accessors"].push_back(entry);
    return json_["accessors"].size() - 1;
  }

  std::size_t accessor(const std::vector<std::uint32_t>& values) {
    const std::size_t begin = bytes_.size();
    for (std::uint32_t v : values)
      append_bytes(bytes_, v);
    json_["accessors"].push_back({{"bufferView", view(begin, gl_element_array_buffer)},
                                  {"componentType", gl_unsigned_int},
                                  {"count", values.size()},
                                  {"type", "SCALAR"}});
    return json_["accessors"].size() - 1;
  }

  Json json_;
  std::string bytes_;
  std::size_t fragment_count_ = 0;
};

}  // namespace

void write_fragments_glb(const std::filesystem::path& path, const std::vector<Fragment>& fragments,
                         const std::vector<FragmentContact>& contacts) {
  Document document;
  for (const Fragment& fragment : fragments)
    document.add(fragment, contacts);
  write_bytes(path, document.bytes());
}

}  // namespace conchoid
