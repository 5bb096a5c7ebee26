#include "conchoid/bem/node_groups.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <set>

#include "conchoid/bem/body_operator.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

// A box whose nodes are numbered at random.
TriMesh shuffled_box(int n) {
  const TriMesh box = box_mesh({1, 1, 1}, n, n, n);
  std::vector<std::size_t> order(box.node_count());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  TriMesh out = box;
  for (std::size_t i = 0; i < order.size(); ++i)
    out.positions[NodeId(order[i])] = box.positions[NodeId(i)];
  for (auto& corners : out.corners)
    for (NodeId& node : corners)
      node = NodeId(order[node.index()]);
  return out;
}

std::size_t triangles_around(const TriMesh& mesh, const std::vector<NodeId>& nodes) {
  std::size_t count = 0;
  for (const auto& corners : mesh.corners)
    count += std::any_of(corners.begin(), corners.end(),
                         [&](NodeId n) { return std::find(nodes.begin(), nodes.end(), n) != nodes.end(); });
  return count;
}

TEST(NodeGroups, HoldEveryNodeOnceAndShareFewTriangles) {
  const TriMesh mesh = shuffled_box(10);
  std::vector<NodeId> all;
  for (std::size_t i = 0; i < mesh.node_count(); ++i)
    all.emplace_back(i);
  const auto groups = compact_groups(mesh.positions, all, 100);
  std::set<NodeId> found;
  std::size_t triangles = 0;
  for (const std::vector<NodeId>& group : groups) {
    EXPECT_LE(group.size(), 100u);
    EXPECT_TRUE(std::is_sorted(group.begin(), group.end()));
    found.insert(group.begin(), group.end());
    triangles += triangles_around(mesh, group);
  }
  EXPECT_EQ(found.size(), mesh.node_count());
  EXPECT_LT(triangles, 2 * mesh.triangle_count()) << "most triangles belong to one group";
  EXPECT_TRUE(compact_groups(mesh.positions, {}, 100).empty());
}

// Several groups and several tiles.
TEST(NodeGroups, TheSystemIsWhatItsEntriesAre) {
  const TriMesh mesh = shuffled_box(8);
  std::vector<BoundaryKind> kinds(mesh.triangle_count(), BoundaryKind::traction);
  const Vec3 x[] = {Vec3::UnitX()};
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (const Vec3 n = unit_normal(mesh, TriId(t)); n.z() < -0.9)
      kinds[t] = BoundaryKind::displacement;
    else if (n.x() > 0.9)
      kinds[t] = BoundaryKind::holding(x);
  const BodyOperator body(mesh, kinds, {3.1e9, 0.327}, {});
  const BodyDiscretisation& d = body.discretisation();
  ASSERT_GT(d.free_nodes.size(), 300u);
  const auto nq = static_cast<Eigen::Index>(d.tractions()), nu = static_cast<Eigen::Index>(d.displacements());
  Eigen::MatrixXd D(nu, nu), K(nq, nu);
  body.entries().system_hypersingular(d.free_nodes, d.free_nodes, {D.data(), 1, d.displacements()});
  body.entries().system_double_layer(d.held_triangles, d.free_nodes, {K.data(), 1, d.tractions()});
  Eigen::VectorXd u = Eigen::VectorXd::Random(nq + nu), f(nq + nu);
  u.head(nq).setZero();
  body.solver().apply(u.data(), f.data(), 1);
  const Eigen::VectorXd expected = D * u.tail(nu);
  EXPECT_LT((f.tail(nu) - expected).norm(), 1e-11 * expected.norm());
}

}  // namespace
}  // namespace conchoid
