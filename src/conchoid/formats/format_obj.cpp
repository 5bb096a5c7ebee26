#include <ostream>

#include "conchoid/core/numbers.hpp"
#include "conchoid/formats/format_readers.hpp"
#include "conchoid/formats/mesh_text.hpp"

namespace conchoid {
namespace {

/// One corner of a face, "7", "7/1", "7//3" or "7/1/3": zero-based, −1 where nothing is named.
struct Corner {
  std::int64_t vertex = -1, uv = -1, normal = -1;
};

/// An index of the file, counted from 1, or from the end where negative; −1 where it is out of range.
std::int64_t zero_based(std::int64_t index, std::size_t count) {
  const auto end = static_cast<std::int64_t>(count);
  const std::int64_t found = index > 0 ? index - 1 : end + index;
  return index == 0 || found < 0 || found >= end ? -1 : found;
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& file) : scan_(bytes, file), skipped_(file) {
    scan_.join_lines_after('\\');
  }

  AttributedMesh run() {
    while (scan_.next_line('#')) {
      const std::string_view keyword = scan_.next_word();
      if (keyword == "v")
        mesh_.positions.push_back(vector<3>("vertex coordinate"));
      else if (keyword == "vn")
        normals_.push_back(vector<3>("normal's component"));
      else if (keyword == "vt")
        read_uv();
      else if (keyword == "usemtl")
        attributes_.use_material(std::string(scan_.next_word()));
      else if (keyword == "g" || keyword == "o")
        read_groups(keyword == "o");
      else if (keyword == "f")
        read_face();
      else if (keyword == "l")
        skipped_.add("line elements");
      else if (keyword == "p")
        skipped_.add("point elements");
    }
    skipped_.warn();
    SurfaceAttributes attributes = attributes_.finish(mesh_.triangle_count());
    return {std::move(mesh_), std::move(attributes)};
  }

 private:
  template <int n>
  Eigen::Matrix<double, n, 1> vector(const char* what) {
    Eigen::Matrix<double, n, 1> x;
    for (int k = 0; k < n; ++k)
      x[k] = scan_.number(scan_.next_word(), what);
    return x;
  }

  /// An object is a group of everything in it.
  void read_groups(bool object) {
    std::string& names = object ? object_ : groups_;
    names.clear();
    for (std::string_view word = scan_.next_word(); !word.empty(); word = scan_.next_word())
      names += (names.empty() ? "" : " ") + std::string(word);
    if (object) groups_.clear();
    attributes_.use_groups(groups_ + (groups_.empty() || object_.empty() ? "" : " ") + object_);
  }

  /// v may be missing; a third coordinate is ignored.
  void read_uv() {
    Vec2 uv(scan_.number(scan_.next_word(), "texture coordinate"), 0);
    if (const std::string_view v = scan_.next_word(); !v.empty())
      uv[1] = scan_.number(v, "texture coordinate");
    uvs_.push_back(uv);
  }

  /// The shape is what counts: a normal or texture coordinate that the file does not hold is left out.
  Corner corner(std::string_view word) const {
    Corner out;
    std::array<std::string_view, 3> part;
    for (std::string_view& p : part) {
      const std::size_t slash = word.find('/');
      p = word.substr(0, slash);
      word = slash == std::string_view::npos ? std::string_view() : word.substr(slash + 1);
    }
    const std::int64_t index = scan_.integer(part[0], "vertex index");
    out.vertex = zero_based(index, mesh_.node_count());
    if (out.vertex < 0)
      scan_.fail("vertex index " + std::to_string(index) + " is out of range; " +
                 std::to_string(mesh_.node_count()) + " vertices come before this face, counted from 1");
    if (!part[1].empty())
      out.uv = zero_based(scan_.integer(part[1], "texture coordinate index"), uvs_.size());
    if (!part[2].empty()) out.normal = zero_based(scan_.integer(part[2], "normal index"), normals_.size());
    return out;
  }

  void read_face() {
    polygon_.clear();
    corners_.clear();
    for (std::string_view word = scan_.next_word(); !word.empty(); word = scan_.next_word()) {
      corners_.push_back(corner(word));
      polygon_.push_back(NodeId(static_cast<std::size_t>(corners_.back().vertex)));
    }
    if (polygon_.empty()) scan_.fail("a face without vertices");
    if (polygon_.size() < 3) return skipped_.add("faces of fewer than three vertices");
    std::size_t t = mesh_.triangle_count();
    for (const PolygonTriangle& places : add_polygon(mesh_, polygon_)) {
      attributes_.add_triangle(t);
      for (int k = 0; k < 3; ++k) {
        const Corner& c = corners_[places[static_cast<std::size_t>(k)]];
        if (c.uv >= 0) attributes_.add_uv(t, k, uvs_[static_cast<std::size_t>(c.uv)]);
        if (c.normal >= 0) attributes_.add_normal(t, k, normals_[static_cast<std::size_t>(c.normal)]);
      }
      ++t;
    }
  }

  TextScanner scan_;
  SkippedElements skipped_;
  TriMesh mesh_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  AttributeCollector attributes_;
  std::string object_, groups_;  // names with spaces between them
  std::vector<NodeId> polygon_;
  std::vector<Corner> corners_;
};

}  // namespace

AttributedMesh read_obj(std::string_view bytes, const std::string& file) {
  AttributedMesh surface = ObjReader(bytes, file).run();
  if (surface.mesh.node_count() == 0)
    fail_in_file(file, "has no vertex lines ('v x y z'); it is not an .obj surface or it is truncated");
  return surface;
}

void write_obj(std::ostream& out, const TriMesh& mesh) {
  for (const Vec3& x : mesh.positions)
    out << "v " << shortest(x.x()) << ' ' << shortest(x.y()) << ' ' << shortest(x.z()) << '\n';
  for (const auto& c : mesh.corners)
    out << "f " << c[0].value + 1 << ' ' << c[1].value + 1 << ' ' << c[2].value + 1 << '\n';
}

}  // namespace conchoid
