#include "conchoid/intersect/cut_editor.hpp"

#include <cmath>

namespace conchoid {
namespace {

/// Altitude over longest edge below which round-off decides whether a piece has an area.
constexpr double kFlat = 1e-9;
/// Height over the surface, over the longest edge, below which a piece of the sheet lies in it.
constexpr double kInSurface = 5e-3;

/// Number of open ends (0 or 2) if the pieces form one fan around n, else −1.
int open_ends(NodeId n, const std::vector<Corners>& pieces) {
  std::vector<std::pair<NodeId, NodeId>> link;
  for (const Corners& c : pieces) {
    const int k = c[0] == n ? 0 : c[1] == n ? 1 : 2;
    link.emplace_back(c[(k + 1) % 3], c[(k + 2) % 3]);
  }
  const auto find = [&](NodeId from) {
    return std::find_if(link.begin(), link.end(), [&](const auto& l) { return l.first == from; });
  };
  for (const auto& l : link)
    if (std::count_if(link.begin(), link.end(), [&](const auto& x) { return x.first == l.first; }) != 1 ||
        std::count_if(link.begin(), link.end(), [&](const auto& x) { return x.second == l.second; }) != 1)
      return -1;
  std::size_t starts = 0;
  NodeId start = link[0].first;
  for (const auto& l : link)
    if (std::none_of(link.begin(), link.end(), [&](const auto& x) { return x.second == l.first; })) {
      start = l.first;
      ++starts;
    }
  if (starts > 1) return -1;
  std::size_t length = 0;
  NodeId at = start;
  for (auto l = find(at); l != link.end() && length < link.size(); l = find(at)) {
    at = l->second;
    ++length;
  }
  return length == link.size() ? static_cast<int>(2 * starts) : -1;
}

}  // namespace

CutEditor::CutEditor(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet)
    : cut_(cut),
      surface_(surface),
      sheet_(sheet),
      layers_{CutLayer(cut.surface, cut.surface_parent, cut.positions.size()),
              CutLayer(cut.sheet, cut.sheet_parent, cut.positions.size())},
      mouth_(cut.positions.size()) {
  for (const Edge& e : cut.mouth) {
    mouth_[e.a].push_back(e.b);
    mouth_[e.b].push_back(e.a);
  }
}

bool CutEditor::make(const CutChange& change) {
  if (!improves_shape(change) || !stays_valid(change)) return false;
  apply(change);
  return true;
}

/// Altitude over longest edge, 0.87 at best; negative if turned over against the normal.
double CutEditor::quality(const Corners& c, const CutChange& change, const Vec3& normal, bool after) const {
  std::array<Vec3, 3> x;
  for (int k = 0; k < 3; ++k)
    x[k] = after ? at_after(c[k], change) : at(c[k]);
  const Vec3 area = area_vector2(x[0], x[1], x[2]);
  const double longest =
      std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
  if (longest == 0) return 0;
  const double q = area.norm() / longest;
  if (q < kFlat) return 0;
  return area.dot(normal) > 0.5 * area.norm() * normal.norm() ? q : -q;
}

bool CutEditor::improves_shape(const CutChange& change) const {
  double before = 1, after = 1;
  long flat = 0;  // pieces without area, how many more there are
  for (const int l : {surface_layer, sheet_layer}) {
    const TriMesh& mesh = l == surface_layer ? surface_ : sheet_;
    for (const std::size_t p : change.removed[l]) {
      const double q = quality(layers_[l][p].corners, change, area_vector(mesh, layers_[l][p].parent), false);
      before = std::min(before, q);
      flat -= q <= 0;
    }
    for (const CutPiece& p : change.added[l]) {
      const double q = quality(p.corners, change, area_vector(mesh, p.parent), true);
      after = std::min(after, q);
      flat += q <= 0;
    }
  }
  // a node less is a gain in itself, though other short edges beside it may still wait for their turn, or other
  // nodes at the same place
  if (change.gone.empty()) return after > 0 && after > std::max(before, 0.0) * (1 + 1e-6);
  return after > 0 ? after > 0.3 * before : flat < 0 && after >= before;
}

/// Pieces around a node after the change.
std::vector<Corners> CutEditor::around_after(int l, NodeId n, const CutChange& change) const {
  std::vector<Corners> result;
  for (const std::size_t p : layers_[l].around(n))
    if (std::find(change.removed[l].begin(), change.removed[l].end(), p) == change.removed[l].end())
      result.push_back(layers_[l][p].corners);
  for (const CutPiece& p : change.added[l])
    if (has(p.corners, n)) result.push_back(p.corners);
  return result;
}

bool CutEditor::is_mouth_after(NodeId a, NodeId b, const CutChange& change) const {
  const Edge e(a, b);
  const auto in = [&](const std::vector<Edge>& list) {
    return std::find(list.begin(), list.end(), e) != list.end();
  };
  return in(change.mouth_added) || (is_mouth(a, b) && !in(change.mouth_removed));
}

/// Whether all three corners are the surface's, after the change, and in the plane of one of its pieces there.
bool CutEditor::lies_in_surface(const Corners& sheet_piece, const CutChange& change) const {
  std::array<Vec3, 3> x;
  for (int k = 0; k < 3; ++k)
    x[k] = at_after(sheet_piece[k], change);
  const double longest = std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
  std::array<std::vector<Corners>, 3> around;
  for (int k = 0; k < 3; ++k) {
    around[k] = around_after(surface_layer, sheet_piece[k], change);
    if (around[k].empty()) return false;
  }
  const auto height = [&](const Vec3& n, int from, int to) { return std::abs(n.dot(x[to] - x[from])); };
  for (int k = 0; k < 3; ++k)
    for (const Corners& c : around[k]) {
      const Vec3 n =
          area_vector2(at_after(c[0], change), at_after(c[1], change), at_after(c[2], change)).normalized();
      if (std::max(height(n, k, (k + 1) % 3), height(n, k, (k + 2) % 3)) < kInSurface * longest) return true;
    }
  return false;
}

/// Every node touched: closed fan of surface pieces, one fan of sheet pieces that starts and ends as
/// before.
bool CutEditor::stays_valid(const CutChange& change) const {
  if (std::any_of(change.added[sheet_layer].begin(), change.added[sheet_layer].end(),
                  [&](const CutPiece& p) { return lies_in_surface(p.corners, change); }))
    return false;
  std::vector<NodeId> touched;
  for (const int l : {surface_layer, sheet_layer}) {
    for (const std::size_t p : change.removed[l])
      touched.insert(touched.end(), layers_[l][p].corners.begin(), layers_[l][p].corners.end());
    for (const CutPiece& p : change.added[l])
      touched.insert(touched.end(), p.corners.begin(), p.corners.end());
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return std::all_of(touched.begin(), touched.end(), [&](NodeId n) {
    return std::find(change.gone.begin(), change.gone.end(), n) != change.gone.end() || node_valid(n, change);
  });
}

bool CutEditor::node_valid(NodeId n, const CutChange& change) const {
  const auto surface = around_after(surface_layer, n, change), sheet = around_after(sheet_layer, n, change);
  if (surface.empty() && sheet.empty()) return false;
  if (!surface.empty() && open_ends(n, surface) != 0) return false;
  if (sheet.empty() != layers_[sheet_layer].around(n).empty() && sheet.empty()) return false;
  const int ends = sheet.empty() ? 0 : open_ends(n, sheet);
  if (ends != 0 && ends != 2) return false;
  // mouth edges: two surface pieces and one sheet piece; other sheet edges are not in the surface
  std::vector<NodeId> mouth;
  for (const NodeId x : mouth_[n])
    if (is_mouth_after(n, x, change)) mouth.push_back(x);
  for (const Edge& e : change.mouth_added)
    if (e.a == n || e.b == n) mouth.push_back(e.a == n ? e.b : e.a);
  std::sort(mouth.begin(), mouth.end());
  if (std::adjacent_find(mouth.begin(), mouth.end()) != mouth.end() ||
      mouth.size() > std::max<std::size_t>(2, mouth_[n].size()))
    return false;
  const auto uses = [](const std::vector<Corners>& pieces, NodeId x) {
    return std::count_if(pieces.begin(), pieces.end(), [&](const Corners& c) { return has(c, x); });
  };
  for (const NodeId x : mouth)
    if (uses(surface, x) != 2 || uses(sheet, x) != 1) return false;
  for (const Corners& c : sheet)
    for (const NodeId x : c)
      if (x != n && !std::binary_search(mouth.begin(), mouth.end(), x) && uses(surface, x) != 0) return false;
  return true;
}

void CutEditor::apply(const CutChange& change) {
  for (const int l : {surface_layer, sheet_layer}) {
    for (const std::size_t p : change.removed[l])
      layers_[l].remove(p);
    for (const CutPiece& p : change.added[l])
      layers_[l].add(p);
  }
  for (const Edge& e : change.mouth_removed) {
    std::erase(mouth_[e.a], e.b);
    std::erase(mouth_[e.b], e.a);
  }
  for (const Edge& e : change.mouth_added) {
    mouth_[e.a].push_back(e.b);
    mouth_[e.b].push_back(e.a);
  }
  if (change.moved.valid() && change.moved.index() >= cut_.surface_node_count)
    cut_.positions[change.moved] = change.to;
}

void CutEditor::write_back() {
  IdVector<NodeId, NodeId> renumbered(cut_.positions.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < cut_.positions.size(); ++i) {
    const NodeId n(i);
    if (i >= cut_.surface_node_count && layers_[surface_layer].around(n).empty() &&
        layers_[sheet_layer].around(n).empty())
      continue;
    renumbered[n] = NodeId(next);
    cut_.positions[NodeId(next)] = cut_.positions[n];
    cut_.sheet_node[NodeId(next)] = cut_.sheet_node[n];
    ++next;
  }
  cut_.positions.resize(next);
  cut_.sheet_node.resize(next);
  cut_.mouth.clear();
  for (std::size_t i = 0; i < mouth_.size(); ++i)
    for (const NodeId b : mouth_[NodeId(i)])
      if (NodeId(i) < b) cut_.mouth.emplace_back(renumbered[NodeId(i)], renumbered[b]);
  std::sort(cut_.mouth.begin(), cut_.mouth.end());
  write_layer(surface_layer, renumbered, cut_.surface, cut_.surface_parent);
  write_layer(sheet_layer, renumbered, cut_.sheet, cut_.sheet_parent);
}

/// By parent, then by nodes: the order does not tell how the pieces came about.
void CutEditor::write_layer(int l, const IdVector<NodeId, NodeId>& renumbered,
                            IdVector<TriId, Corners>& corners, std::vector<TriId>& parents) const {
  const TriMesh& mesh = l == surface_layer ? surface_ : sheet_;
  std::vector<std::size_t> count(mesh.triangle_count(), 0);
  std::vector<CutPiece> pieces;
  for (std::size_t p = 0; p < layers_[l].size(); ++p)
    if (layers_[l].alive(p)) {
      pieces.push_back(layers_[l][p]);
      ++count[layers_[l][p].parent.index()];
    }
  for (CutPiece& p : pieces) {
    for (NodeId& n : p.corners)
      n = renumbered[n];
    if (count[p.parent.index()] > 1)
      std::rotate(p.corners.begin(), std::min_element(p.corners.begin(), p.corners.end()), p.corners.end());
  }
  std::sort(pieces.begin(), pieces.end(), [](const CutPiece& x, const CutPiece& y) {
    if (x.parent != y.parent) return x.parent < y.parent;
    Corners a = x.corners, b = y.corners;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a < b;
  });
  corners.clear();
  parents.clear();
  for (const CutPiece& p : pieces) {
    corners.push_back(p.corners);
    parents.push_back(p.parent);
  }
}

}  // namespace conchoid
