#include "conchoid/intersect/corefine.hpp"

#include <algorithm>
#include <utility>

#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/intersect/corefine_merge.hpp"
#include "conchoid/intersect/inside_pieces.hpp"
#include "conchoid/intersect/mouth_curve.hpp"
#include "conchoid/intersect/predicates.hpp"
#include "conchoid/intersect/retriangulate.hpp"
#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/winding_number.hpp"

namespace conchoid {
namespace {

constexpr std::size_t kOfTask = 256;  // triangles of one task

class Corefinement {
 public:
  Corefinement(const TriMesh& surface, const TriMesh& sheet)
      : surface_(surface), sheet_(sheet), progress_("steps of a cut", 3), mouth_(surface, sheet) {
    progress_.advance();
    cut_mesh(MouthNode::surface_edge, 0, result_.surface, result_.surface_parent);
    progress_.advance();
    cut_mesh(MouthNode::sheet_edge, surface_.node_count(), sheet_pieces_, sheet_parents_);
    progress_.advance();
  }

  /// What of the sheet lies outside is left out. Once.
  CutComplex keep_inside() {
    const std::vector<MouthSide> mouth = mouth_.sides();
    const std::vector<bool> inside = inside_pieces(sheet_pieces_, mouth, rays());
    const std::size_t ns = surface_.node_count();
    std::vector<char> used(mouth_.positions().size(), 1);
    std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(ns), sheet_.node_count(), 0);
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      if (inside[p])
        for (const NodeId id : sheet_pieces_[p])
          used[id.index()] = 1;
    final_id_.resize(mouth_.positions().size());
    result_.positions.reserve(mouth_.positions().size());
    result_.sheet_node.reserve(mouth_.positions().size());
    for (std::size_t i = 0; i < mouth_.positions().size(); ++i) {
      if (!used[i]) continue;
      final_id_[i] = result_.positions.add(mouth_.positions()[NodeId(i)]);
      const bool of_sheet = i >= ns && i < ns + sheet_.node_count();
      result_.sheet_node.push_back(of_sheet ? NodeId(i - ns) : NodeId());
    }
    result_.surface_node_count = ns;
    for (Corners& c : result_.surface)
      for (NodeId& id : c)
        if (id.index() >= ns) id = final_id_[id.index()];
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p) {
      if (!inside[p]) continue;
      Corners c = sheet_pieces_[p];
      for (NodeId& id : c)
        id = final_id_[id.index()];
      result_.sheet.push_back(c);
      result_.sheet_parent.push_back(sheet_parents_[p]);
    }
    for (const auto& [edge, left] : mouth)
      result_.mouth.emplace_back(final_id_[edge.a.index()], final_id_[edge.b.index()]);
    std::sort(result_.mouth.begin(), result_.mouth.end());
    return std::move(result_);
  }
  SplitSurfaces split() {
    std::vector<MouthSide> mouth = mouth_.sides();
    const std::vector<bool> sheet_inside = inside_pieces(sheet_pieces_, mouth, rays());
    // What lies to the left on the sheet lies to the right on the surface (theirs is the same curve).
    for (MouthSide& side : mouth)
      side.second = !side.second;
    const std::vector<Corners> surface_pieces(result_.surface.begin(), result_.surface.end());
    const std::vector<bool> surface_inside =
        inside_pieces(surface_pieces, std::move(mouth), [&](const std::vector<NodeId>& nodes) {
          std::vector<bool> inside;
          for (const NodeId n : nodes)
            inside.push_back(winding_number(sheet_, mouth_.positions()[n]) > 0.5);
          return inside;
        });
    SplitSurfaces out;
    for (std::size_t p = 0; p < surface_pieces.size(); ++p)
      out.first.push_back({surface_pieces[p], surface_inside[p]});
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      out.second.push_back({sheet_pieces_[p], sheet_inside[p]});
    out.positions = mouth_.positions();
    return out;
  }
  /// Per node of the complex that keep_inside() has returned.
  IdVector<NodeId, SurfaceSupport> supports() const {
    using enum SurfaceSupport::Kind;
    IdVector<NodeId, SurfaceSupport> supports(static_cast<std::size_t>(
        std::count_if(final_id_.begin(), final_id_.end(), [](NodeId n) { return n.valid(); })));
    for (std::size_t i = 0; i < surface_.node_count(); ++i)
      supports[NodeId(i)].kind = vertex;
    const std::vector<MouthNode>& nodes = mouth_.nodes();
    for (std::size_t i = mouth_.node(nodes.size()).index(); i < final_id_.size(); ++i)
      supports[final_id_[i]].kind = vertex;  // crossings stay where they are
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      SurfaceSupport& support = supports[final_id_[mouth_.node(k).index()]];
      support.kind = nodes[k].kind == MouthNode::surface_edge ? edge : face;
      if (support.kind == edge) {
        support.edge = nodes[k].edge;
        continue;
      }
      support.face = nodes[k].triangle;
      const PerturbedTriangle T = mouth_.surface_triangle(support.face);
      const NodeId a = nodes[k].edge.a;
      support.outside = orientation(*T[0], *T[1], *T[2], mouth_.sheet_point(a)) > 0 ? a : nodes[k].edge.b;
    }
    return supports;
  }

 private:
  /// Pieces of one cut triangle, oriented like it; in canonical order and rotation, the same for a reflected
  /// mesh.
  std::vector<Corners> cut_triangle(MouthNode::Kind kind, TriId t) const {
    const Corners& corners = mouth_.mesh_of(kind).corners[t];
    Corners ascending = corners;
    std::sort(ascending.begin(), ascending.end());
    const bool even =
        corners[1] ==
        ascending[(std::find(ascending.begin(), ascending.end(), corners[0]) - ascending.begin() + 1) % 3];
    std::vector<Corners> pieces = retriangulate(mouth_.positions(), mouth_.triangle_cut(kind, t));
    for (Corners& p : pieces) {
      std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
      if (!even) std::swap(p[1], p[2]);
    }
    std::sort(pieces.begin(), pieces.end(), [](Corners x, Corners y) {
      std::sort(x.begin(), x.end());
      std::sort(y.begin(), y.end());
      return x < y;
    });
    return pieces;
  }

  /// Pieces of a mesh's triangles, in the order of these.
  void cut_mesh(MouthNode::Kind kind, std::size_t first_node, std::vector<Corners>& pieces,
                std::vector<TriId>& parents) const {
    const TriMesh& mesh = mouth_.mesh_of(kind);
    const std::vector<TriId>& cut = mouth_.cut_triangles(kind);
    const auto pieces_of =
        parallel_values(cut.size(), kOfTask, [&](std::size_t i) { return cut_triangle(kind, cut[i]); });
    std::size_t count = mesh.triangle_count() - cut.size();
    for (const std::vector<Corners>& of_one : pieces_of)
      count += of_one.size();
    pieces.reserve(count);
    parents.reserve(count);
    std::size_t next = 0;  // of those that are cut
    for (TriId t(0); t.index() < mesh.triangle_count(); ++t.value) {
      if (next < cut.size() && cut[next] == t) {
        const std::vector<Corners>& of_one = pieces_of[next++];
        pieces.insert(pieces.end(), of_one.begin(), of_one.end());
        parents.insert(parents.end(), of_one.size(), t);
        continue;
      }
      Corners c = mesh.corners[t];
      for (NodeId& id : c)
        id = NodeId(id.index() + first_node);
      pieces.push_back(c);
      parents.push_back(t);
    }
  }

  /// Whether a segment towards +x +y +z misses the box of a triangle, by more than round-off.
  static bool is_beside_ray(const Vec3& from, const Vec3& to, const Triangle& T) {
    constexpr double round_off = 1e-9;  // of the segment's length
    double first = -round_off, last = 1 + round_off;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = T[0][axis], b = T[1][axis], c = T[2][axis], length = to[axis] - from[axis];
      if (std::max({a, b, c}) < from[axis]) return true;
      first = std::max(first, (std::min({a, b, c}) - from[axis]) / length - round_off);
      last = std::min(last, (std::max({a, b, c}) - from[axis]) / length + round_off);
    }
    return first > last;
  }

  InsideTest rays() const {
    return [this](const std::vector<NodeId>& nodes) { return rays_say_inside(nodes); };
  }

  /// Parity of the surface triangles between a sheet node and a point far away.
  std::vector<bool> rays_say_inside(std::vector<NodeId> nodes) const {
    if (nodes.empty()) return {};
    for (NodeId& n : nodes)  // the sheet's number
      n = NodeId(n.index() - surface_.node_count());
    const PerturbedPoints starts(sheet_, Role::sheet, static_cast<std::uint32_t>(surface_.node_count()),
                                 nodes);
    const Box box = bounding_box(surface_);
    std::vector<PerturbedPoint> ends(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vec3& x = starts[nodes[i]].x;
      ends[i].x = x + 4 * (box.high - x).cwiseAbs() + 2 * (box.high - box.low);
      ends[i].id = static_cast<std::uint32_t>(surface_.node_count() + sheet_.node_count());
    }
    struct Near {
      std::size_t ray;
      TriId triangle;
    };
    constexpr std::size_t of_task = 4096;
    const std::size_t count = surface_.triangle_count();
    const auto found = parallel_values((count + of_task - 1) / of_task, 1, [&](std::size_t task) {
      std::vector<Near> near;
      for (TriId t(task * of_task); t.index() < std::min(count, (task + 1) * of_task); ++t.value) {
        const Triangle T = surface_.triangle(t);
        for (std::size_t i = 0; i < ends.size(); ++i)
          if (!is_beside_ray(starts[nodes[i]].x, ends[i].x, T)) near.push_back({i, t});
      }
      return near;
    });
    std::vector<NodeId> corners;
    for (const std::vector<Near>& of_one : found)
      for (const Near& near : of_one)
        corners.insert(corners.end(), surface_.corners[near.triangle].begin(),
                       surface_.corners[near.triangle].end());
    const PerturbedPoints points(surface_, Role::surface, 0, corners);
    std::vector<bool> inside(nodes.size(), false);
    for (const std::vector<Near>& of_one : found)
      for (const auto& [ray, t] : of_one) {
        const PerturbedTriangle T = points.triangle(surface_.corners[t]);
        const PerturbedPoint &start = starts[nodes[ray]], &end = ends[ray];
        if (orientation(*T[0], *T[1], *T[2], start) != orientation(*T[0], *T[1], *T[2], end) &&
            pierces(start, end, T))
          inside[ray] = !inside[ray];
      }
    return inside;
  }

  const TriMesh& surface_;
  const TriMesh& sheet_;
  Progress progress_;
  MouthCurve mouth_;
  std::vector<Corners> sheet_pieces_;
  std::vector<TriId> sheet_parents_;
  CutComplex result_;
  std::vector<NodeId> final_id_;  ///< of the nodes of the mouth curve; invalid where left out
};

}  // namespace

CutComplex corefine(const TriMesh& surface, const TriMesh& sheet, const CorefineSettings& settings) {
  Corefinement corefinement(surface, sheet);
  CutComplex cut = corefinement.keep_inside();
  if (settings.merge > 0)
    merge_mouth(cut, surface, sheet, corefinement.supports(), settings.merge, settings.across);
  return cut;
}

SplitSurfaces split_by_each_other(const TriMesh& first, const TriMesh& second) {
  return Corefinement(first, second).split();
}

}  // namespace conchoid
