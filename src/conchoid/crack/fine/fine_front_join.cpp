#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "conchoid/crack/closing/bridge_triangulation.hpp"
#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/length_factors.hpp"

// Fine fronts that meet.
namespace conchoid {

namespace {

/// The marker a coarse node is attached to, else the one nearest to it.
std::size_t marker_at(const MarkerCurve& curve, NodeId coarse, const Vec3& x) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.markers[i].coarse == coarse) return i;
    if (const double d = (curve.markers[i].position - x).norm(); d < least) {
      least = d;
      best = i;
    }
  }
  return best;
}

/// What the chain numbers from place `from` on to place `to`; empty if it ends before.
std::vector<std::size_t> places_between(const FrontChain& chain, std::size_t from, std::size_t to) {
  const std::size_t n = chain.nodes.size();
  std::vector<std::size_t> out;
  if (n == 0 || (!chain.closed && to < from)) return out;
  for (std::size_t k = 0; k <= (to + n - from) % n; ++k)
    out.push_back(chain.nodes[(from + k) % n]);
  return out;
}

/// Divides edges longer than `longest` in the middle, the longest first, but for those of `kept` (sorted).
/// @param triangles  appended to `mesh` afterwards; new nodes are added to it
class Divider {
 public:
  Divider(TriMesh& mesh, std::vector<std::array<NodeId, 3>> triangles, std::vector<Edge> kept)
      : mesh_(mesh), triangles_(std::move(triangles)), kept_(std::move(kept)) {
    std::sort(kept_.begin(), kept_.end());
  }

  void run(double longest) {
    for (int round = 0; round < kDivisionRounds && divide_once(longest); ++round) {
    }
    mesh_.corners.insert(mesh_.corners.end(), triangles_.begin(), triangles_.end());
  }

  /// The nodes from a to b, which a single edge joined.
  std::vector<NodeId> path(NodeId a, NodeId b) const {
    const auto middle = middle_.find(Edge(a, b));
    if (middle == middle_.end()) return {a, b};
    std::vector<NodeId> first = path(a, middle->second);
    const std::vector<NodeId> rest = path(middle->second, b);
    first.insert(first.end(), rest.begin() + 1, rest.end());
    return first;
  }

 private:
  /// Divides all edges that are the longest in their triangles.
  bool divide_once(double longest) {
    std::map<Edge, std::vector<std::size_t>> around;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (int k = 0; k < 3; ++k)
        around[edge(t, k)].push_back(t);
    std::map<Edge, double> length;  // of those to divide
    for (const auto& [e, both] : around) {
      const double l = (mesh_.positions[e.a] - mesh_.positions[e.b]).norm();
      if (l > longest && !std::binary_search(kept_.begin(), kept_.end(), e)) length.emplace(e, l);
    }
    // Edges as long up to round-off: the one with smaller ids, the same in a mirrored crack.
    const auto goes_first = [&](const Edge& e, double l) {
      const auto& both = around[e];
      return std::all_of(both.begin(), both.end(), [&](std::size_t t) {
        for (int k = 0; k < 3; ++k)
          if (const auto other = length.find(edge(t, k)); other != length.end() && other->first != e) {
            const bool tie = std::abs(other->second - l) <= kEqualLength * l;
            if (tie ? other->first < e : other->second > l) return false;
          }
        return true;
      });
    };
    std::vector<Edge> now;
    for (const auto& [e, l] : length)
      if (goes_first(e, l)) now.push_back(e);
    for (const Edge& e : now) {
      const NodeId middle = mesh_.positions.add(0.5 * (mesh_.positions[e.a] + mesh_.positions[e.b]));
      middle_.emplace(e, middle);
      for (const std::size_t t : around[e]) {
        auto other = triangles_[t];
        std::replace(triangles_[t].begin(), triangles_[t].end(), e.a, middle);
        std::replace(other.begin(), other.end(), e.b, middle);
        triangles_.push_back(other);
      }
    }
    return !now.empty();
  }

  Edge edge(std::size_t t, int k) const { return {triangles_[t][k], triangles_[t][(k + 1) % 3]}; }

  TriMesh& mesh_;
  std::vector<std::array<NodeId, 3>> triangles_;
  std::vector<Edge> kept_;
  std::map<Edge, NodeId> middle_;
};

/// The markers of the fronts that are joined, numbered one curve after the other, and how they are to follow
/// each other.
struct MarkerLinks {
  std::vector<Marker> markers;
  std::vector<FrontChain> chains;  ///< one, or two in the order of the fronts
  std::vector<std::size_t> removed;
  std::vector<std::pair<std::size_t, std::size_t>> links;

  std::vector<NodeId> last_nodes(const std::vector<std::size_t>& numbers) const {
    std::vector<NodeId> out;
    for (const std::size_t i : numbers)
      out.push_back(markers[i].node);
    return out;
  }

  /// A marker at the end of a stretch is free again.
  void restart(std::size_t i, NodeId coarse) {
    markers[i].coarse = coarse;
    markers[i].arrested = markers[i].at_own_face = false;
  }

  /// Links two ends, with new markers at the nodes in between; ends that are one marker vanish.
  void link(std::size_t from, std::size_t to, const std::vector<NodeId>& between, const TriMesh& surface) {
    if (from == to) {
      removed.push_back(from);
      return;
    }
    for (std::size_t k = 1; k + 1 < between.size(); ++k) {
      Marker& marker = markers.emplace_back();
      marker.node = between[k];
      marker.position = surface.positions[between[k]];
      links.emplace_back(from, markers.size() - 1);
      from = markers.size() - 1;
    }
    links.emplace_back(from, to);
  }
};

MarkerLinks numbered(const std::vector<MarkerCurve>& curves, const JoinedFronts& joined) {
  MarkerLinks out;
  for (const std::size_t f : std::set{joined.first, joined.second}) {
    FrontChain& chain = out.chains.emplace_back();
    chain.closed = curves[f].closed;
    for (const Marker& marker : curves[f].markers) {
      chain.nodes.push_back(out.markers.size());
      out.markers.push_back(marker);
    }
  }
  return out;
}

template <class PositionOf, class List>
double length_along(const List& list, const PositionOf& position_of) {
  double length = 0;
  for (std::size_t i = 1; i < list.size(); ++i)
    length += (position_of(list[i]) - position_of(list[i - 1])).norm();
  return length;
}

/// Numbers of the markers along a stretch of coarse nodes. Empty where the markers do not follow it: a node without a
/// marker of its own, whose nearest one lies elsewhere on the front, would take the long way round.
std::vector<std::size_t> stretch(const CrackSheet& sheet, const MarkerLinks& links, const MarkerCurve& curve,
                                 const FrontChain& chain, const std::vector<NodeId>& nodes,
                                 double resolution) {
  const auto& x = sheet.mesh.positions;
  const std::vector<std::size_t> between =
      places_between(chain, marker_at(curve, nodes.front(), x[nodes.front()]),
                     marker_at(curve, nodes.back(), x[nodes.back()]));
  const double coarse = length_along(nodes, [&](NodeId n) { return x[n]; });
  const double fine = length_along(between, [&](std::size_t i) { return links.markers[i].position; });
  if (fine > kLongestStretch * (coarse + resolution)) return {};
  return between;
}

/// The markers along a coarse front: the first chain with a node of it attached; empty if there is none.
MarkerCurve curve_along(const SheetFront& front, const std::vector<FrontChain>& chains,
                        const std::vector<Marker>& markers) {
  const auto on_front = [&](NodeId n) {
    return std::find(front.nodes.begin(), front.nodes.end(), n) != front.nodes.end();
  };
  MarkerCurve curve;
  curve.closed = front.closed;
  for (const FrontChain& chain : chains)
    if (std::any_of(chain.nodes.begin(), chain.nodes.end(), [&](std::size_t i) {
          return markers[i].coarse.valid() && on_front(markers[i].coarse);
        })) {
      for (const std::size_t i : chain.nodes)
        curve.markers.push_back(markers[i]);
      break;
    }
  for (Marker& marker : curve.markers)  // of the other's nodes none may be attached here
    if (marker.coarse.valid() && !on_front(marker.coarse)) marker.coarse = NodeId();
  return curve;
}

}  // namespace

/// Triangles from marker to marker, their long edges divided.
FineFront::JointEnds FineFront::fill_ligament(const std::vector<NodeId>& first,
                                              const std::vector<NodeId>& second, int part) {
  const IdVector<NodeId, Vec3> normals = unit_node_normals(surface_);
  std::vector<Edge> kept;
  for (const auto* run : {&first, &second})
    for (std::size_t i = 1; i < run->size(); ++i)
      kept.emplace_back((*run)[i - 1], (*run)[i]);
  Divider divider(surface_, triangles_between(surface_.positions, normals, first, second), std::move(kept));
  divider.run(kLongestFineBridgeEdge * settings_.spacing);
  for (std::size_t t = birth_.size(); t < surface_.triangle_count(); ++t)
    faces_.take(surface_, TriId(t), part);
  birth_.resize(surface_.triangle_count(), frame_);
  return {divider.path(first.front(), second.back()), divider.path(second.front(), first.back())};
}

void FineFront::join(const CrackSheet& sheet, const FrontJoint& joint, const JoinedFronts& joined) {
  const MarkerCurve first = curves_[joined.first], second = curves_[joined.second];
  MarkerLinks links = numbered(curves_, joined);
  const std::vector<std::size_t> a =
      stretch(sheet, links, first, links.chains[joined.first <= joined.second ? 0 : 1], joint.first,
              settings_.resolution);
  const std::vector<std::size_t> b =
      stretch(sheet, links, second, links.chains[joined.second <= joined.first ? 0 : 1], joint.second,
              settings_.resolution);
  if (a.size() > 1 && b.size() > 1) {
    const JointEnds ends = fill_ligament(links.last_nodes(a), links.last_nodes(b), first.part);
    links.restart(a.front(), joint.first.front());
    links.restart(a.back(), joint.first.back());
    links.restart(b.front(), joint.second.front());
    links.restart(b.back(), joint.second.back());
    links.link(a.front(), b.back(), ends.at_first, surface_);
    links.link(b.front(), a.back(), ends.at_second, surface_);
    for (const auto* run : {&a, &b})
      links.removed.insert(links.removed.end(), run->begin() + 1, run->end() - 1);
  }
  const int part = std::min(first.part, second.part), gone = std::max(first.part, second.part);
  faces_.join(part, gone);
  std::vector<MarkerCurve> curves;
  for (std::size_t f = 0; f < curves_.size(); ++f)
    if (f != joined.first && f != joined.second) curves.push_back(std::move(curves_[f]));
  const auto rest = relinked(links.chains, links.removed, links.links);
  while (curves.size() < sheet.fronts.size()) {
    MarkerCurve curve = curve_along(sheet.fronts[curves.size()], rest, links.markers);
    curve.part = part;
    curves.push_back(std::move(curve));
  }
  for (MarkerCurve& curve : curves)
    if (curve.part == gone) curve.part = part;
  curves_ = std::move(curves);
  known_triangles_ = sheet.mesh.triangle_count();
}

}  // namespace conchoid
