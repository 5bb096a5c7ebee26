#include "conchoid/crack/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {
namespace {

std::string name(const char* kind, std::size_t i) {
  return std::string(kind) + " " + std::to_string(i);
}

/// Not inline: GCC 12 warns of bounds where it appends to a string it knows to be short.
[[gnu::noinline]] void report(std::vector<std::string>& out, std::string where, const char* what) {
  where.append(what);
  out.push_back(std::move(where));
}

/// Edges in the direction in which triangles walk them, to ask which are on the boundary.
class WalkedEdges {
 public:
  explicit WalkedEdges(const TriMesh& mesh) {
    edges_.reserve(3 * mesh.triangle_count());
    for (const auto& c : mesh.corners)
      for (int k = 0; k < 3; ++k)
        edges_.emplace_back(c[k], c[(k + 1) % 3]);
    std::sort(edges_.begin(), edges_.end());
  }
  bool once() const { return std::adjacent_find(edges_.begin(), edges_.end()) == edges_.end(); }
  bool on_boundary(NodeId from, NodeId to) const { return walked(from, to) && !walked(to, from); }

 private:
  bool walked(NodeId from, NodeId to) const {
    return std::binary_search(edges_.begin(), edges_.end(), std::pair(from, to));
  }
  std::vector<std::pair<NodeId, NodeId>> edges_;
};

template <class Births>
void check_births(const char* of, const Births& birth, std::size_t count, int frame,
                  std::vector<std::string>& out) {
  if (birth.size() != count) report(out, of, ": not one birth for each");
  if (!std::is_sorted(birth.begin(), birth.end())) report(out, of, ": births decrease");
  if (birth.size() > 0 && *std::max_element(birth.begin(), birth.end()) > frame)
    report(out, of, ": one is born after the present frame");
}

void check_front(const CrackSheet& sheet, std::size_t f, const WalkedEdges& edges,
                 std::vector<bool>& on_front, std::vector<std::string>& out) {
  const SheetFront& front = sheet.fronts[f];
  const std::size_t n = front.nodes.size();
  if (n < (front.closed ? 3u : 2u)) report(out, name("front", f), ": too few nodes");
  if (front.closed && n > 0 && *std::min_element(front.nodes.begin(), front.nodes.end()) != front.nodes[0])
    report(out, name("front", f), ": the ring does not start at its smallest id");
  for (std::size_t i = 0; i < n; ++i) {
    const NodeId node = front.nodes[i], next = front.nodes[next_index(i, n, front.closed)];
    const std::string place = name("front", f) + ", " + name("node", node.index()) + ": ";
    if (on_front[node.index()]) report(out, place, "on a front already");
    on_front[node.index()] = true;
    if (next != node && !edges.on_boundary(node, next))
      report(out, place, "the edge to the next one is no boundary edge in this direction");
    const NodeId behind = sheet.correlation[node];
    if (behind.valid() && (behind == node || sheet.node_birth[behind] > sheet.node_birth[node]))
      report(out, place, "its correlation node is itself or younger");
    if (!(sheet.travelled[node] >= 0) || !std::isfinite(sheet.travelled[node]))
      report(out, place, "way travelled negative or not finite");
  }
}

/// Attached nodes: of this front, each once, in its order (of a ring: after one turn at most).
void check_attached(const CrackSheet& sheet, const SheetFront& front, const MarkerCurve& curve,
                    double resolution, std::vector<std::string>& out) {
  std::map<NodeId, std::size_t> place;
  for (std::size_t k = 0; k < front.nodes.size(); ++k)
    place.emplace(front.nodes[k], k);
  std::vector<std::size_t> places;
  for (const Marker& marker : curve.markers) {
    if (!marker.coarse.valid()) continue;
    const std::string who = name("coarse node", marker.coarse.index()) + ": ";
    const auto at = place.find(marker.coarse);
    if (at == place.end()) {
      report(out, who, "attached to a marker of another front");
      continue;
    }
    if ((marker.position - sheet.mesh.positions[marker.coarse]).norm() > resolution)
      report(out, who, "farther than r̄ from its marker");
    places.push_back(at->second);
  }
  std::size_t falls = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const bool last = k + 1 == places.size();
    if (last && (!curve.closed || places.size() < 2)) break;
    falls += places[last ? 0 : k + 1] <= places[k] ? 1 : 0;
  }
  if (falls > (curve.closed ? 1u : 0u))
    report(out, {}, "attached nodes: twice, or not in the order of the front");
}

void append(std::vector<std::string>& out, const std::string& where, const std::vector<std::string>& more) {
  for (const std::string& violation : more)
    out.push_back(where + violation);
}

/// `edges` of the surface at hand, as it serves all curves on it.
std::vector<std::string> curve_violations(const CrackSheet& sheet, const SheetFront& front,
                                          const MarkerCurve& curve, const TriMesh& surface,
                                          const WalkedEdges& edges, double resolution, double h,
                                          double longest) {
  std::vector<std::string> out;
  if (curve.size() == 0) return out;
  if (curve.closed != front.closed) report(out, {}, "markers: open along a ring, or the other way round");
  check_attached(sheet, front, curve, resolution, out);
  std::size_t falls = 0;  // of the parameter; once where a ring begins anew
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Marker& marker = curve.markers[i];
    const std::string who = name("marker", i) + ": ";
    if (!marker.node.valid() || marker.node.index() >= surface.node_count()) {
      report(out, who, "no node of the fine surface");
      continue;
    }
    const double ahead = (marker.position - surface.positions[marker.node]).norm();
    if (!(ahead < kRowDistance * h * (1 + kRoundOff)))
      report(out, who, "ahead of its row by more than it may");
    const std::size_t next = curve.next(i);
    if (next == i) continue;
    const Marker& after = curve.markers[next];
    if (!edges.on_boundary(marker.node, after.node))
      report(out, who, "the edge to the next one is no boundary edge of the fine surface");
    else if ((surface.positions[after.node] - surface.positions[marker.node]).norm() > longest)
      report(out, who, "too far from the next one");
    falls += after.parameter < marker.parameter ? 1 : 0;
  }
  if (falls > (curve.closed ? 1u : 0u)) report(out, {}, "markers: parameters fall along the curve");
  return out;
}

}  // namespace

std::vector<std::string> sheet_violations(const CrackSheet& sheet) {
  std::vector<std::string> out;
  const std::size_t nodes = sheet.mesh.node_count();
  check_births("nodes", sheet.node_birth, nodes, sheet.frame, out);
  check_births("triangles", sheet.triangle_birth, sheet.mesh.triangle_count(), sheet.frame, out);
  if (sheet.state.size() != nodes || sheet.correlation.size() != nodes || sheet.travelled.size() != nodes)
    report(out, {}, "nodes: an attribute has not one value per node");
  if (!out.empty()) return out;  // what follows reads them
  const WalkedEdges edges(sheet.mesh);
  if (!edges.once()) report(out, {}, "triangles: an edge is walked twice in one direction");
  std::vector<bool> on_front(nodes, false);
  for (std::size_t f = 0; f < sheet.fronts.size(); ++f)
    check_front(sheet, f, edges, on_front, out);
  return out;
}

std::vector<std::string> surface_violations(const TriMesh& surface, const IdVector<TriId, int>& birth,
                                            int frame) {
  std::vector<std::string> out;
  check_births("triangles", birth, surface.triangle_count(), frame, out);
  if (!WalkedEdges(surface).once()) report(out, {}, "triangles: an edge is walked twice in one direction");
  return out;
}

std::vector<std::string> curve_violations(const CrackSheet& sheet, const SheetFront& front,
                                          const MarkerCurve& curve, const TriMesh& surface, double resolution,
                                          double h, double longest) {
  return curve_violations(sheet, front, curve, surface, WalkedEdges(surface), resolution, h, longest);
}

void validate(const CrackSheet& sheet, const FineFront& fine) {
  std::vector<std::string> out;
  append(out, "sheet: ", sheet_violations(sheet));
  append(out, "fine surface: ", surface_violations(fine.surface(), fine.triangle_birth(), sheet.frame));
  if (fine.curves().size() != sheet.fronts.size()) {
    report(out, {}, "fine front: not one curve for each coarse front");
  } else {
    const WalkedEdges edges(fine.surface());
    for (std::size_t f = 0; f < sheet.fronts.size(); ++f)
      append(out, name("fine front", f) + ": ",
             curve_violations(sheet, sheet.fronts[f], fine.curves()[f], fine.surface(), edges,
                              fine.settings().resolution, fine.settings().spacing, fine.longest_spacing()));
  }
  if (out.empty()) return;
  std::string all = "crack fronts after frame " + std::to_string(sheet.frame) + ":";
  for (const std::string& violation : out)
    all += "\n  " + violation;
  throw std::logic_error(all);
}

}  // namespace conchoid
