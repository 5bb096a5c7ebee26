#include "conchoid/surface/convex_hull.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace conchoid {
namespace {

/// Qhull's state for one hull, released with it.
class Qhull {
 public:
  Qhull(std::vector<double>& coordinates, std::size_t count)
      : messages_(std::fopen("/dev/null", "w"), std::fclose) {
    qh_zero(&state_, messages_.get());
    char options[] = "qhull Qt";
    good_ = qh_new_qhull(&state_, 3, static_cast<int>(count), coordinates.data(), False, options, nullptr,
                         messages_.get()) == 0;
  }
  ~Qhull() {
    qh_freeqhull(&state_, qh_ALL);
    int left = 0, bytes = 0;
    qh_memfreeshort(&state_, &left, &bytes);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  bool good() const { return good_; }

  /// Corners of the facets as indices of points, all turned one way.
  std::vector<std::array<int, 3>> facets() {
    std::vector<std::array<int, 3>> out;
    qhT* qh = &state_;
    facetT* facet;
    FORALLfacets {
      setT* vertices = qh_facet3vertex(qh, facet);
      std::array<int, 3> corners{};
      std::size_t k = 0;
      vertexT *vertex, **vertexp;
      FOREACHvertex_(vertices) if (k < 3) corners[k++] = qh_pointid(qh, vertex->point);
      qh_settempfree(qh, &vertices);
      out.push_back(corners);
    }
    return out;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages_;
  qhT state_;
  bool good_ = false;
};

}  // namespace

TriMesh convex_hull(const TriMesh& mesh) {
  TriMesh out;
  if (mesh.node_count() < 4) return out;
  const Vec3 center = bounding_box(mesh).center();
  std::vector<double> coordinates;
  for (const Vec3& x : mesh.positions)
    for (int i = 0; i < 3; ++i)
      coordinates.push_back(x[i] - center[i]);
  Qhull qhull(coordinates, mesh.node_count());
  if (!qhull.good()) return out;
  std::vector<std::array<int, 3>> facets = qhull.facets();

  std::vector<NodeId> id(mesh.node_count());
  for (const auto& facet : facets)
    for (const int i : facet)
      id[static_cast<std::size_t>(i)] = NodeId(0);
  for (std::size_t n = 0; n < id.size(); ++n)
    if (id[n].valid()) id[n] = out.positions.add(mesh.positions[NodeId(n)]);
  for (const auto& facet : facets) {
    std::array<NodeId, 3> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = id[static_cast<std::size_t>(facet[k])];
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    out.corners.push_back(c);
  }
  if (enclosed_volume(out) < 0)
    for (auto& c : out.corners)
      std::swap(c[1], c[2]);
  std::sort(out.corners.begin(), out.corners.end());
  return out;
}

}  // namespace conchoid
