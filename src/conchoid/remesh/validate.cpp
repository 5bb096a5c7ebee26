#include "conchoid/remesh/validate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/union_find.hpp"
#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/corners.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"
#include "conchoid/mesh/winding_number.hpp"
#include "conchoid/remesh/flat_triangles.hpp"

namespace conchoid {
namespace {

/// "triangle 4" …, for messages.
template <class IdType>
std::string numbers(const std::vector<IdType>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i)
    text += (i == 0 ? "" : i + 1 == ids.size() ? " and " : ", ") + std::to_string(ids[i].value);
  return text;
}

class Defects {
 public:
  explicit Defects(std::size_t most_of_a_kind) : most_of_a_kind_(most_of_a_kind) {}
  void add(DefectKind kind, std::string what, std::string remedy, std::vector<TriId> triangles,
           std::vector<NodeId> nodes = {}) {
    if (++counts_[kind] <= most_of_a_kind_)
      found_.push_back({kind, std::move(what), std::move(remedy), std::move(triangles), std::move(nodes)});
  }
  std::size_t most_of_a_kind() const { return most_of_a_kind_; }
  bool none() const { return found_.empty(); }
  std::vector<MeshDefect> take() { return std::move(found_); }

 private:
  std::size_t most_of_a_kind_;
  std::map<DefectKind, std::size_t> counts_;
  std::vector<MeshDefect> found_;
};

void check_corners(const TriMesh& mesh, Defects& defects) {
  if (mesh.triangle_count() == 0)
    defects.add(DefectKind::empty, "there are no triangles", "export a triangulated surface", {});
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto& c = mesh.corners[TriId(t)];
    for (NodeId n : c)
      if (!n.valid() || n.index() >= mesh.node_count())
        defects.add(DefectKind::index_out_of_range,
                    "triangle " + std::to_string(t) + " uses node " + std::to_string(n.value) +
                        ", but there are " + std::to_string(mesh.node_count()) + " nodes",
                    "export the mesh again", {TriId(t)});
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
      defects.add(DefectKind::repeated_node, "triangle " + std::to_string(t) + " uses a node twice",
                  "remove degenerate triangles", {TriId(t)});
  }
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (!mesh.positions[NodeId(n)].allFinite())
      defects.add(DefectKind::not_finite,
                  "node " + std::to_string(n) + " has a coordinate that is not finite",
                  "repair the coordinates", {}, {NodeId(n)});
}

void check_duplicates(const TriMesh& mesh, Defects& defects) {
  struct Key {
    std::array<NodeId, 3> nodes;
    TriId triangle;
  };
  std::vector<Key> keys;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    keys.push_back({mesh.corners[TriId(t)], TriId(t)});
    std::sort(keys.back().nodes.begin(), keys.back().nodes.end());
  }
  sort_by_edge(keys, mesh.node_count(), [](const Key& k) { return Edge(k.nodes[0], k.nodes[1]); });
  const auto same_edge = [&](std::size_t i, std::size_t j) {
    return keys[i].nodes[0] == keys[j].nodes[0] && keys[i].nodes[1] == keys[j].nodes[1];
  };
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && same_edge(begin, end))
      ++end;
    std::stable_sort(keys.begin() + static_cast<long>(begin), keys.begin() + static_cast<long>(end),
                     [](const Key& x, const Key& y) { return x.nodes[2] < y.nodes[2]; });
  }
  for (std::size_t i = 0; i + 1 < keys.size(); ++i)
    if (keys[i].nodes == keys[i + 1].nodes)
      defects.add(
          DefectKind::duplicate,
          "triangles " + numbers<TriId>({keys[i].triangle, keys[i + 1].triangle}) + " have the same nodes",
          "remove one of them", {keys[i].triangle, keys[i + 1].triangle});
}

/// A side of a triangle, with its nodes in the order the triangle runs through them.
struct Side {
  Edge edge;
  NodeId from;
  TriId triangle;
};

std::vector<Side> sorted_sides(const TriMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = mesh.corners[TriId(t)];
      sides.push_back({Edge(c[k], c[(k + 1) % 3]), c[k], TriId(t)});
    }
  sort_by_edge(sides, mesh.node_count(), [](const Side& s) { return s.edge; });  // then by triangle
  return sides;
}

void check_edges(const TriMesh& mesh, bool may_be_open, Defects& defects) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].edge == sides[i].edge)
      ++end;
    if (end - i == 2 && sides[i].from != sides[i + 1].from) continue;
    std::vector<TriId> triangles;
    for (std::size_t k = i; k < end; ++k)
      triangles.push_back(sides[k].triangle);
    const std::vector<NodeId> nodes = {sides[i].edge.a, sides[i].edge.b};
    const std::string edge = "edge " + std::to_string(nodes[0].value) + "–" + std::to_string(nodes[1].value);
    if (end - i == 1 && !may_be_open)
      defects.add(DefectKind::open_edge,
                  edge + " has only triangle " + numbers(triangles) + ": the surface has a hole there",
                  "close the holes", triangles, nodes);
    if (end - i > 2)
      defects.add(DefectKind::crowded_edge,
                  edge + " has more than two triangles (" + numbers(triangles) + ")",
                  "remove inner walls so that every edge has two triangles", triangles, nodes);
    if (end - i == 2)
      defects.add(DefectKind::inconsistent_edge,
                  "triangles " + numbers(triangles) + " are oriented differently (at " + edge + ")",
                  "flip one of them, or recompute the orientation of all faces", triangles, nodes);
  }
}

/// The first triangle of a star that does not hang together with the first of all by edges at the node; their
/// number, if all do.
std::size_t first_apart(const TriMesh& mesh, NodeId n, std::span<const TriId> star) {
  UnionFind groups(star.size());
  std::vector<std::pair<NodeId, std::size_t>> across;  // other ends of edges at the node, and whose they are
  for (std::size_t i = 0; i < star.size(); ++i)
    for (const NodeId other : mesh.corners[star[i]]) {
      if (other == n) continue;
      const auto found =
          std::find_if(across.begin(), across.end(), [&](const auto& known) { return known.first == other; });
      if (found == across.end())
        across.emplace_back(other, i);
      else
        groups.join(found->second, i);
    }
  std::size_t i = 0;
  while (i < star.size() && groups.root(i) == 0)
    ++i;
  return i;
}

void check_nodes(const TriMesh& mesh, Defects& defects) {
  constexpr std::size_t nodes_of_task = 2048;
  const NodeLists<TriId> stars = triangles_at_nodes(mesh);
  std::vector<std::size_t> apart(mesh.node_count());
  parallel_for(mesh.node_count(), nodes_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      apart[n] = first_apart(mesh, NodeId(n), stars[NodeId(n)]);
  });
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const auto star = stars[NodeId(n)];
    if (star.empty())
      defects.add(DefectKind::unused_node, "node " + std::to_string(n) + " belongs to no triangle",
                  "remove unused vertices", {}, {NodeId(n)});
    else if (apart[n] < star.size())
      defects.add(DefectKind::pinched_node,
                  "node " + std::to_string(n) + " joins parts that touch only there (triangles " +
                      numbers<TriId>({star[0], star[apart[n]]}) + ")",
                  "split the node or thicken the connection", {star[0], star[apart[n]]}, {NodeId(n)});
  }
}

void check_shapes(const TriMesh& mesh, Defects& defects) {
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (has_no_area(mesh.triangle(TriId(t))))
      defects.add(DefectKind::degenerate, "triangle " + std::to_string(t) + " has no area",
                  "remove or collapse degenerate triangles", {TriId(t)});
}

void check_intersections(const TriMesh& mesh, Defects& defects) {
  for (const auto& [s, t] : self_intersections(mesh, defects.most_of_a_kind()))
    defects.add(DefectKind::self_intersection, "triangles " + numbers<TriId>({s, t}) + " intersect",
                "repair the self-intersections, or remesh", {s, t});
}

/// Connected closed parts of the surface, in the order of their first triangles.
std::vector<TriMesh> components(const TriMesh& mesh, std::vector<TriId>& first_triangles) {
  const std::vector<int> part_of_node = connected_parts(mesh);
  std::map<int, std::size_t> place;
  std::vector<TriMesh> parts;
  IdVector<NodeId, NodeId> ids(mesh.node_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    Corners corners = mesh.corners[TriId(t)];
    const auto [found, is_new] = place.try_emplace(part_of_node[corners[0].index()], parts.size());
    if (is_new) {
      parts.emplace_back();
      first_triangles.push_back(TriId(t));
    }
    TriMesh& part = parts[found->second];
    for (NodeId& n : corners) {
      if (!ids[n].valid()) ids[n] = part.positions.add(mesh.positions[n]);
      n = ids[n];
    }
    part.corners.push_back(corners);
  }
  return parts;
}

/// Every component outside of all others, or inside an even number of them, must be oriented outward, a
/// cavity inward.
void check_orientation(const TriMesh& mesh, Defects& defects) {
  std::vector<TriId> first;
  const std::vector<TriMesh> parts = components(mesh, first);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double volume = enclosed_volume(parts[p]);
    const std::string name =
        parts.size() == 1 ? "the surface" : "the component of triangle " + std::to_string(first[p].value);
    const Box box = bounding_box(parts[p]);
    if (!(std::abs(volume) > 1e-12 * surface_area(parts[p]) * box.diagonal())) {
      defects.add(DefectKind::no_volume, name + " encloses no volume", "remove it or give it thickness",
                  {first[p]});
      continue;
    }
    int depth = 0;
    for (std::size_t q = 0; q < parts.size(); ++q, throw_if_interrupted())
      if (q != p && std::abs(winding_number(parts[q], parts[p].positions.front())) > 0.5) ++depth;
    if ((volume > 0) != (depth % 2 == 0))
      defects.add(DefectKind::inside_out,
                  name + (depth % 2 == 0 ? " is oriented inward" : " is a cavity but is oriented outward"),
                  "flip its triangles", {first[p]});
  }
}

std::vector<MeshDefect> defects_of(const TriMesh& mesh, bool is_body, std::size_t most_of_a_kind) {
  Defects defects(most_of_a_kind);
  check_corners(mesh, defects);
  if (!defects.none()) return defects.take();
  check_duplicates(mesh, defects);
  check_edges(mesh, !is_body, defects);
  check_nodes(mesh, defects);
  check_shapes(mesh, defects);
  if (!defects.none()) return defects.take();
  check_intersections(mesh, defects);
  if (is_body && defects.none()) check_orientation(mesh, defects);
  return defects.take();
}

void require_none(const std::vector<MeshDefect>& defects, const std::string& name, const char* kind) {
  if (defects.empty()) return;
  constexpr std::size_t most_listed = 5;
  std::string message = name + ": the mesh cannot be used as " + kind + ":";
  for (std::size_t i = 0; i < std::min(defects.size(), most_listed); ++i)
    message += "\n  " + defects[i].what + "; " + defects[i].remedy;
  if (defects.size() > most_listed)
    message += "\n  and " + std::to_string(defects.size() - most_listed) +
               (defects.size() >= default_most_of_a_kind ? " more or further" : " more") +
               " defects (ids count from 0)";
  throw InputError(message);
}

}  // namespace

std::vector<MeshDefect> find_defects(const TriMesh& mesh, std::size_t most_of_a_kind) {
  return defects_of(mesh, true, most_of_a_kind);
}

std::vector<MeshDefect> find_sheet_defects(const TriMesh& sheet) {
  return defects_of(sheet, false, default_most_of_a_kind);
}

void require_valid_body(const TriMesh& mesh, const std::string& name) {
  require_none(find_defects(mesh), name, "the surface of a body");
}

void require_valid_sheet(const TriMesh& sheet, const std::string& name) {
  require_none(find_sheet_defects(sheet), name, "a crack sheet");
}

}  // namespace conchoid
