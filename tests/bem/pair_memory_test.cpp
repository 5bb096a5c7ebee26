#include "conchoid/bem/pair_memory.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <vector>

#include "conchoid/bem/enrichment_rows.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

/// A disc inside a held cube, and the same disc grown by a row of triangles.
struct GrowingDisc {
  TriMesh cube = box_mesh({1, 1, 1}, 2, 2, 2);
  std::vector<LoadSource> sources;
  std::shared_ptr<const BodyOperator> body;
  EnrichedSpace before, after;

  GrowingDisc() {
    BoundaryData data = free_surface(cube);
    for (std::size_t t = 0; t < cube.triangle_count(); ++t)
      if (unit_normal(cube, TriId(t)).z() < -0.9)
        data.kind[t] = BoundaryKind::displacement;
      else
        sources.push_back({Prescribed::traction, t});
    body = make_body_operator(cube, data, {3.1e9, 0.327});
    const TriMesh disc = disc_crack({0.01, 0.02, 0.03}, Vec3::UnitZ(), 0.2, {.edge = 0.06});
    before = space_of(disc, data);
    after = space_of(extend_sheet_beyond(disc, boundary_edges(disc), 0.06), data);
  }

  EnrichedSpace space_of(const TriMesh& sheet, const BoundaryData& data) const {
    return make_enriched_space(corefine(cube, sheet), cube, data.kind);
  }

  /// Functions that came with the growth.
  std::vector<std::size_t> added() const {
    std::set<std::vector<double>> known;
    for (const EnrichmentFunction& f : before.functions)
      known.insert(f.key);
    std::vector<std::size_t> out;
    for (std::size_t f = 0; f < after.functions.size(); ++f)
      if (!known.contains(after.functions[f].key)) out.push_back(f);
    return out;
  }

  PairMemory filled() const {
    std::vector<std::size_t> all(before.functions.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    PairMemory memory;
    assemble_enrichment_rows(*body, before, sources, all, &memory);
    return memory;
  }
};

std::size_t known_pairs(PairMemory memory, const std::vector<Panel>& panels) {
  memory.match(panels);
  std::size_t known = 0;
  for (std::size_t x = 0; x < panels.size(); ++x)
    for (std::size_t y = 0; y < panels.size(); ++y)
      known += (memory.single_layer(x, y) != nullptr) + (memory.double_layer(x, y) != nullptr);
  return known;
}

}  // namespace

TEST(PairMemory, ChangesNoBitOfTheRows) {
  const GrowingDisc disc;
  PairMemory memory = disc.filled();
  const std::vector<std::size_t> added = disc.added();
  ASSERT_FALSE(added.empty());
  ASSERT_LT(added.size(), disc.after.functions.size()) << "some functions have stayed";
  const auto with = assemble_enrichment_rows(*disc.body, disc.after, disc.sources, added, &memory);
  const auto without = assemble_enrichment_rows(*disc.body, disc.after, disc.sources, added);
  for (std::size_t f = 0; f < added.size(); ++f) {
    EXPECT_EQ(with[f].body.data, without[f].body.data);
    EXPECT_EQ(with[f].enriched.data, without[f].enriched.data);
    EXPECT_EQ(with[f].sources.data, without[f].sources.data);
  }
}

TEST(PairMemory, KnowsThePairsOfThePanelsThatWereAtTheFront) {
  const GrowingDisc disc;
  const PairMemory memory = disc.filled();
  // Every panel that had a corner on the front, with every panel that was there.
  std::vector<int> functions(disc.before.panels.size(), 0);
  for (const EnrichmentFunction& f : disc.before.functions)
    for (const PanelValues& v : f.support)
      ++functions[v.panel];
  std::size_t at_front = 0;
  for (std::size_t x = disc.before.surface_count; x < functions.size(); ++x)
    at_front += functions[x] > 0 && functions[x] < 3;
  ASSERT_GT(at_front, 10u);
  EXPECT_GE(known_pairs(memory, disc.after.panels), at_front * disc.before.panels.size());
  const PairIntegrator integrator(crack_tolerance(disc.body->settings().quadrature_tolerance));
  for (std::size_t x = 0; x < disc.after.panels.size(); ++x) {
    PairMemory copy = memory;
    copy.match(disc.after.panels);
    const SingleLayerPair* known = copy.single_layer(x, 0);
    if (!known) continue;
    EXPECT_EQ(known->laplace, integrator.single_layer(disc.after.panels[x], disc.after.panels[0]).laplace);
  }
}

TEST(PairMemory, DoesNotTakePairsThatWouldRoundOtherwise) {
  const GrowingDisc disc;
  std::vector<Panel> renumbered = disc.before.panels;  // the other way round: pairs change their order
  for (Panel& panel : renumbered)
    for (NodeId& node : panel.vertex)
      node = NodeId(100000 - node.index());
  const std::size_t as_it_was = known_pairs(disc.filled(), disc.before.panels);
  const std::size_t turned = known_pairs(disc.filled(), renumbered);
  EXPECT_GT(as_it_was, 1000u);
  EXPECT_LE(turned, 2 * disc.before.panels.size()) << "a panel with itself has no order";
}

}  // namespace conchoid
