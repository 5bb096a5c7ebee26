#include "conchoid/io/fragments_io.hpp"

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>
#include <unordered_map>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/formats/ply.hpp"
#include "conchoid/io/colors.hpp"
#include "conchoid/io/level_set.hpp"
#include "conchoid/surface/convex_hull.hpp"
#include "conchoid/surface/corner_normals.hpp"

namespace conchoid {
namespace {

struct NamedFormat {
  const char* name;
  bool FragmentFormats::*wanted;
};
constexpr NamedFormat named_formats[] = {{"ply", &FragmentFormats::ply}, {"obj", &FragmentFormats::obj},
                                         {"glb", &FragmentFormats::glb}, {"stl", &FragmentFormats::stl},
                                         {"vdb", &FragmentFormats::vdb}, {"hulls", &FragmentFormats::hulls}};

void write_material(std::ostream& out, const std::string& name, const Color& color) {
  out << "newmtl " << name << "\nKd " << shortest(color.r) << ' ' << shortest(color.g) << ' '
      << shortest(color.b) << "\nKa 0 0 0\nKs 0.05 0.05 0.05\nNs 20\nillum 2\n\n";
}

/// "v x y z", a line of an .obj file.
template <class Vector>
void append_line(std::string& to, const char* keyword, const Vector& x) {
  to += keyword;
  for (const auto component : x) {
    to += ' ';
    append_shortest(to, component);
  }
  to += '\n';
}

/// The different values of corners, in single precision, as lines of an .obj file in the order of their first corner; numbers
/// count from 1.
template <class T>
class ValueLines {
 public:
  ValueLines(std::string& out, const char* keyword, const std::vector<std::array<T, 3>>& corners) {
    known_.reserve(corners.size());
    number_.reserve(3 * corners.size());
    for (const auto& three : corners)
      for (const T& value : three) {
        Value x;
        std::transform(value.begin(), value.end(), x.begin(), [](double v) { return static_cast<float>(v); });
        const auto [entry, is_new] = known_.emplace(x, known_.size() + 1);
        number_.push_back(entry->second);
        if (is_new) append_line(out, keyword, x);
      }
  }
  std::size_t operator()(std::size_t triangle, std::size_t corner) const {
    return number_[3 * triangle + corner];
  }
  bool empty() const { return number_.empty(); }

 private:
  using Value = std::array<float, T::RowsAtCompileTime>;
  struct Hash {
    std::size_t operator()(const Value& x) const {
      std::size_t hash = 0;
      for (const float component : x)
        boost::hash_combine(hash, component + 0.0f);  // −0 is 0
      return hash;
    }
  };
  std::unordered_map<Value, std::size_t, Hash> known_;
  std::vector<std::size_t> number_;
};

}  // namespace

std::vector<std::string> fragment_format_names() {
  std::vector<std::string> names;
  for (const NamedFormat& format : named_formats)
    names.push_back(format.name);
  return names;
}

FragmentFormats formats_from_names(const std::vector<std::string>& names, const std::string& where) {
  FragmentFormats formats;
  std::string all;
  for (const NamedFormat& format : named_formats) {
    formats.*format.wanted = std::find(names.begin(), names.end(), format.name) != names.end();
    all += (all.empty() ? "" : ", ") + std::string(format.name);
  }
  for (const std::string& name : names)
    if (std::none_of(std::begin(named_formats), std::end(named_formats),
                     [&](const NamedFormat& f) { return f.name == name; }))
      throw InputError(where + ": format '" + name + "' is not known; choose from " + all);
  if (formats.vdb) require_level_sets(where);
  return formats;
}

SurfaceAttributes written_attributes(const Fragment& fragment) {
  if (!fragment.attributes.empty()) return fragment.attributes;
  SurfaceAttributes out;
  out.normal = corner_normals(fragment.mesh, fragment.face_kind);
  out.materials = {"original", "fracture"};
  for (const FaceKind kind : fragment.face_kind)
    out.material.push_back(kind == FaceKind::original ? 0 : 1);
  return out;
}

void write_fragment_ply(const std::filesystem::path& path, const Fragment& fragment) {
  PlyMesh ply;
  ply.mesh = fragment.mesh;
  ply.attributes = fragment.attributes;
  ply.attributes.normal = written_attributes(fragment).normal;
  ply.node_normal = node_normals(fragment.mesh, fragment.face_kind, ply.attributes.normal);
  for (const FaceKind kind : fragment.face_kind) {
    ply.color.push_back(to_bytes(color_of(kind)));
    ply.kind.push_back(static_cast<int>(kind));
  }
  for (const TriId source : fragment.source)
    ply.source.push_back(source.value);
  write_ply(path, ply);
}

void write_hulls_obj(const std::filesystem::path& path, const std::vector<Fragment>& fragments) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "# conchoid, convex hulls of the fragments, lengths in metres\n";
  std::size_t first = 1;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const TriMesh hull = convex_hull(fragments[i].mesh);
    out << "o " << fragment_name(i) << '\n';
    std::string nodes;
    for (const Vec3& x : hull.positions)
      append_line(nodes, "v", x);
    out << nodes;
    for (const auto& c : hull.corners)
      out << "f " << first + c[0].index() << ' ' << first + c[1].index() << ' ' << first + c[2].index()
          << '\n';
    first += hull.node_count();
  }
  file.commit();
}

std::string fragment_name(std::size_t i) {
  const std::string number = std::to_string(i);
  return "fragment_" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
}

void write_fragment_obj(const std::filesystem::path& path, const Fragment& fragment) {
  const SurfaceAttributes look = written_attributes(fragment);
  const std::filesystem::path material = std::filesystem::path(path).replace_extension(".mtl");
  AtomicFile materials(material);
  for (const std::string& name : look.materials)
    write_material(materials.stream(), name,
                   &name == &look.materials.back() ? fracture_color : original_color);
  materials.commit();

  std::string text = "# conchoid fragment, lengths in metres\nmtllib " + material.filename().string() + '\n';
  for (const Vec3& x : fragment.mesh.positions)
    append_line(text, "v", x);
  const ValueLines<Vec2> uv(text, "vt", look.uv);
  const ValueLines<Vec3> normal(text, "vn", look.normal);
  for (std::size_t m = 0; m < look.materials.size(); ++m) {
    text += "g " + look.materials[m] + "\nusemtl " + look.materials[m] + '\n';
    for (std::size_t t = 0; t < fragment.mesh.triangle_count(); ++t) {
      if (look.material[t] != static_cast<int>(m)) continue;
      text += 'f';
      for (std::size_t k = 0; k < 3; ++k) {
        text += ' ';
        append_shortest(text, fragment.mesh.corners[TriId(t)][k].value + 1);
        text += '/';
        if (!uv.empty()) append_shortest(text, uv(t, k));
        text += '/';
        append_shortest(text, normal(t, k));
      }
      text += '\n';
    }
  }
  write_bytes(path, text);
}

}  // namespace conchoid
