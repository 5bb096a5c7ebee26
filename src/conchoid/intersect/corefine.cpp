#include "conchoid/intersect/corefine.hpp"

#include <algorithm>
#include <atomic>
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
    cut_surface();
    progress_.advance();
    cut_sheet();
    progress_.advance();
  }

  /// What of the sheet lies outside is left out. Once.
  CutComplex keep_inside() {
    const std::vector<MouthSide> mouth = mouth_.sides();
    const std::vector<bool> inside =
        inside_pieces(sheet_pieces_, mouth, [&](NodeId n) { return ray_says_inside(n); });
    const std::size_t ns = surface_.node_count();
    std::vector<bool> used(mouth_.positions().size(), false);
    for (std::size_t i = 0; i < ns; ++i)
      used[i] = true;
    for (std::size_t i = ns + sheet_.node_count(); i < mouth_.positions().size(); ++i)
      used[i] = true;
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      if (inside[p])
        for (const NodeId id : sheet_pieces_[p])
          used[id.index()] = true;
    std::vector<NodeId> final_id(mouth_.positions().size());
    for (std::size_t i = 0; i < mouth_.positions().size(); ++i) {
      if (!used[i]) continue;
      final_id[i] = result_.positions.add(mouth_.positions()[NodeId(i)]);
      const bool of_sheet = i >= ns && i < ns + sheet_.node_count();
      result_.sheet_node.push_back(of_sheet ? NodeId(i - ns) : NodeId());
    }
    result_.surface_node_count = ns;
    for (Corners& c : result_.surface)
      for (NodeId& id : c)
        id = final_id[id.index()];
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p) {
      if (!inside[p]) continue;
      Corners c = sheet_pieces_[p];
      for (NodeId& id : c)
        id = final_id[id.index()];
      result_.sheet.push_back(c);
      result_.sheet_parent.push_back(sheet_parents_[p]);
    }
    for (const auto& [edge, left] : mouth)
      result_.mouth.emplace_back(final_id[edge.a.index()], final_id[edge.b.index()]);
    std::sort(result_.mouth.begin(), result_.mouth.end());
    set_supports(final_id);
    return std::move(result_);
  }
  SplitSurfaces split() {
    std::vector<MouthSide> mouth = mouth_.sides();
    const std::vector<bool> sheet_inside =
        inside_pieces(sheet_pieces_, mouth, [&](NodeId n) { return ray_says_inside(n); });
    // What lies to the left on the sheet lies to the right on the surface (theirs is the same curve).
    for (MouthSide& side : mouth)
      side.second = !side.second;
    const std::vector<Corners> surface_pieces(result_.surface.begin(), result_.surface.end());
    const std::vector<bool> surface_inside = inside_pieces(surface_pieces, std::move(mouth), [&](NodeId n) {
      return winding_number(sheet_, mouth_.positions()[n]) > 0.5;
    });
    SplitSurfaces out;
    for (std::size_t p = 0; p < surface_pieces.size(); ++p)
      out.first.push_back({surface_pieces[p], surface_inside[p]});
    for (std::size_t p = 0; p < sheet_pieces_.size(); ++p)
      out.second.push_back({sheet_pieces_[p], sheet_inside[p]});
    out.positions = mouth_.positions();
    return out;
  }
  /// Per node of the complex that keep_inside() returned.
  IdVector<NodeId, SurfaceSupport> supports() const { return supports_; }

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

  /// Of all triangles of a kind, what cut_triangle says; nothing of those that are whole.
  std::vector<std::vector<Corners>> cut_triangles(MouthNode::Kind kind) const {
    return parallel_values(mouth_.mesh_of(kind).triangle_count(), kOfTask, [&](std::size_t t) {
      return mouth_.cuts(kind, TriId(t)) ? cut_triangle(kind, TriId(t)) : std::vector<Corners>();
    });
  }

  void cut_surface() {
    const auto cut = cut_triangles(MouthNode::surface_edge);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const TriId t(i);
      if (!mouth_.cuts(MouthNode::surface_edge, t)) {
        result_.surface.push_back(surface_.corners[t]);
        result_.surface_parent.push_back(t);
      }
      for (const Corners& p : cut[i]) {
        result_.surface.push_back(p);
        result_.surface_parent.push_back(t);
      }
    }
  }

  void cut_sheet() {
    const auto cut = cut_triangles(MouthNode::sheet_edge);
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const TriId s(i);
      if (!mouth_.cuts(MouthNode::sheet_edge, s)) {
        Corners c = sheet_.corners[s];
        for (NodeId& id : c)
          id = NodeId(id.index() + surface_.node_count());
        sheet_pieces_.push_back(c);
        sheet_parents_.push_back(s);
      }
      for (const Corners& p : cut[i]) {
        sheet_pieces_.push_back(p);
        sheet_parents_.push_back(s);
      }
    }
  }

  /// Whether a segment towards +x +y +z misses the box of a triangle, by more than round-off.
  static bool is_beside_ray(const Vec3& from, const Vec3& to, const PerturbedTriangle& T) {
    constexpr double round_off = 1e-9;  // of the segment's length
    double first = -round_off, last = 1 + round_off;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = T[0]->x[axis], b = T[1]->x[axis], c = T[2]->x[axis], length = to[axis] - from[axis];
      if (std::max({a, b, c}) < from[axis]) return true;
      first = std::max(first, (std::min({a, b, c}) - from[axis]) / length - round_off);
      last = std::min(last, (std::max({a, b, c}) - from[axis]) / length + round_off);
    }
    return first > last;
  }

  /// Parity of the surface triangles between a sheet node and a point far away.
  bool ray_says_inside(NodeId work_id) const {
    const PerturbedPoint& p = mouth_.sheet_point(NodeId(work_id.index() - surface_.node_count()));
    const Box box = bounding_box(surface_);
    PerturbedPoint far;
    far.x = p.x + 4 * (box.high - p.x).cwiseAbs() + 2 * (box.high - box.low);
    far.id = static_cast<std::uint32_t>(surface_.node_count() + sheet_.node_count());
    constexpr std::size_t triangles_of_task = 4096;
    std::atomic<std::size_t> passed = 0;
    parallel_for(surface_.triangle_count(), triangles_of_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const PerturbedTriangle T = mouth_.surface_triangle(TriId(t));
        if (is_beside_ray(p.x, far.x, T)) continue;
        if (orientation(*T[0], *T[1], *T[2], p) != orientation(*T[0], *T[1], *T[2], far) &&
            pierces(p, far, T))
          ++passed;
      }
    });
    return passed % 2 == 1;
  }

  void set_supports(const std::vector<NodeId>& final_id) {
    using enum SurfaceSupport::Kind;
    supports_.resize(result_.positions.size());
    for (std::size_t i = 0; i < surface_.node_count(); ++i)
      supports_[NodeId(i)].kind = vertex;
    const std::vector<MouthNode>& nodes = mouth_.nodes();
    for (std::size_t i = mouth_.node(nodes.size()).index(); i < final_id.size(); ++i)
      supports_[final_id[i]].kind = vertex;  // crossings stay where they are
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      SurfaceSupport& support = supports_[final_id[mouth_.node(k).index()]];
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
  }

  const TriMesh& surface_;
  const TriMesh& sheet_;
  Progress progress_;
  MouthCurve mouth_;
  std::vector<Corners> sheet_pieces_;
  std::vector<TriId> sheet_parents_;
  CutComplex result_;
  IdVector<NodeId, SurfaceSupport> supports_;
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
