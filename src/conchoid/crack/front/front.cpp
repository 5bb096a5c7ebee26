#include "conchoid/crack/front/front.hpp"

#include <algorithm>
#include <unordered_map>

#include "conchoid/crack/front/front_frames.hpp"

namespace conchoid {

namespace {

/// A boundary edge as its triangle walks it: corner k to corner k+1 of `triangle`.
struct HalfEdge {
  TriId triangle;
  int corner = 0;
};

/// Next boundary edge after `edge`, found by turning through the triangles around its end node (so that two
/// parts of the boundary that touch in a node are not mixed up). Invalid triangle if the fan does not end
/// (not a manifold).
HalfEdge next_boundary_edge(const TriMesh& mesh, const IdVector<TriId, std::array<TriId, 3>>& neighbours,
                            HalfEdge edge) {
  const NodeId pivot = mesh.corners[edge.triangle][(edge.corner + 1) % 3];
  HalfEdge out{edge.triangle, (edge.corner + 1) % 3};
  for (std::size_t guard = 0; guard <= mesh.triangle_count(); ++guard) {
    const TriId across = neighbours[out.triangle][out.corner];
    if (!across.valid()) return out;
    const auto& corners = mesh.corners[across];
    const auto at = std::find(corners.begin(), corners.end(), pivot) - corners.begin();
    out = {across, static_cast<int>(at)};
  }
  return {};
}

class FrontWalk {
 public:
  FrontWalk(const TriMesh& mesh, const std::vector<Edge>& mouth)
      : mesh_(mesh), mouth_(mouth), neighbours_(triangle_neighbours(mesh)), visited_(mesh.triangle_count()) {}

  std::vector<Front> fronts() {
    std::vector<Front> found;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k)
        if (is_open({TriId(t), k}) && !visited_[TriId(t)][k]) collect({TriId(t), k}, found);
    return found;
  }

 private:
  bool is_open(HalfEdge h) const { return !neighbours_[h.triangle][h.corner].valid(); }
  NodeId from(HalfEdge h) const { return mesh_.corners[h.triangle][h.corner]; }
  NodeId to(HalfEdge h) const { return mesh_.corners[h.triangle][(h.corner + 1) % 3]; }
  bool is_mouth(HalfEdge h) const {
    return std::binary_search(mouth_.begin(), mouth_.end(), Edge(from(h), to(h)));
  }

  /// Whole boundary loop through `first`, cut at its mouth edges.
  void collect(HalfEdge first, std::vector<Front>& found) {
    std::vector<HalfEdge> loop;
    for (HalfEdge h = first; h.triangle.valid() && !visited_[h.triangle][h.corner];
         h = next_boundary_edge(mesh_, neighbours_, h)) {
      visited_[h.triangle][h.corner] = true;
      loop.push_back(h);
    }
    const auto mouth_at = std::find_if(loop.begin(), loop.end(), [&](HalfEdge h) { return is_mouth(h); });
    if (mouth_at == loop.end()) {
      found.push_back(ring(loop));
      return;
    }
    std::rotate(loop.begin(), mouth_at, loop.end());
    for (std::size_t i = 0; i < loop.size();) {
      if (is_mouth(loop[i])) {
        ++i;
        continue;
      }
      Front open;
      open.nodes.push_back(from(loop[i]));
      for (; i < loop.size() && !is_mouth(loop[i]); ++i)
        open.nodes.push_back(to(loop[i]));
      found.push_back(std::move(open));
    }
  }

  Front ring(const std::vector<HalfEdge>& loop) const {
    Front front;
    front.closed = true;
    for (HalfEdge h : loop)
      front.nodes.push_back(from(h));
    return front;
  }

  const TriMesh& mesh_;
  const std::vector<Edge>& mouth_;
  IdVector<TriId, std::array<TriId, 3>> neighbours_;
  IdVector<TriId, std::array<bool, 3>> visited_;
};

}  // namespace

void start_at_smallest_id(std::vector<NodeId>& ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
}

std::vector<Front> find_fronts(const TriMesh& crack, const std::vector<Edge>& mouth, FrontNormals kind) {
  return find_fronts(crack, mouth, kind, node_area_vectors(crack));
}

std::vector<Front> find_fronts(const TriMesh& crack, const std::vector<Edge>& mouth, FrontNormals kind,
                               const IdVector<NodeId, Vec3>& normals) {
  std::vector<Front> fronts = FrontWalk(crack, mouth).fronts();
  for (Front& front : fronts)
    if (front.closed) start_at_smallest_id(front.nodes);
  std::sort(fronts.begin(), fronts.end(), [](const Front& x, const Front& y) {
    return *std::min_element(x.nodes.begin(), x.nodes.end()) <
           *std::min_element(y.nodes.begin(), y.nodes.end());
  });
  for (Front& front : fronts)
    front.frames = front_frames(crack, normals, front.nodes, front.closed, kind);
  return fronts;
}

}  // namespace conchoid
