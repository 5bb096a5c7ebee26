#include "conchoid/bem/row_store.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/bem/quadratic_body.hpp"
#include "conchoid/bem/quadratic_stress.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"

namespace conchoid {
namespace {

const ElasticConstants kGlassy{3.1e9, 0.327};

class MemoryStore : public RowStore {
 public:
  std::optional<std::vector<EnrichmentRows>> recall(const std::string& name) override {
    const auto found = rows.find(name);
    if (found == rows.end()) return std::nullopt;
    ++recalled;
    return found->second;
  }
  void keep(const std::string& name, const std::vector<EnrichmentRows>& made) override {
    ++kept;
    rows[name] = made;
  }
  std::map<std::string, std::vector<EnrichmentRows>> rows;
  int recalled = 0, kept = 0;
};

CrackedBody pulled_cube(bool quadratic = false) {
  const TriMesh cube = box_mesh({1, 1, 1}, 2, 2, 2);
  BoundaryData data = free_surface(cube);
  for (std::size_t t = 0; t < cube.triangle_count(); ++t) {
    const double z = unit_normal(cube, TriId(t)).z();
    if (z > 0.9) data.traction[t] = {0, 0, 1e6};
    if (z < -0.9) data.kind[t] = BoundaryKind::displacement;
  }
  if (!quadratic) return make_cracked_body(cube, data, kGlassy);
  BemSettings settings;
  settings.quadratic = std::make_shared<const QuadraticBody>(cube, data.kind, kGlassy);
  return CrackedBody(std::make_shared<const BodyOperator>(cube, data.kind, kGlassy, settings),
                     as_field(*settings.quadratic, load_case(cube, data)));
}

/// Openings of a disc, and of the disc twice as large after it, in one body.
std::vector<Vec3> openings(RowStore* store, bool quadratic = false) {
  CrackedBody body = pulled_cube(quadratic);
  body.keep_rows(store);
  std::vector<Vec3> all;
  for (double radius : {0.1, 0.2}) {
    const TriMesh disc = disc_crack({0.01, 0.02, 0.03}, Vec3::UnitZ(), radius, {.edge = 0.05});
    body.set_crack(corefine(box_mesh({1, 1, 1}, 2, 2, 2), disc));
    body.solve();
    all.insert(all.end(), body.opening().begin(), body.opening().end());
  }
  return all;
}

}  // namespace

TEST(RowStore, KeptRowsGiveTheSameBitsWithoutBeingMadeAgain) {
  for (const bool quadratic : {false, true}) {
    const std::vector<Vec3> plain = openings(nullptr, quadratic);
    MemoryStore store;
    EXPECT_EQ(openings(&store, quadratic), plain);
    EXPECT_EQ(store.kept, 2);
    EXPECT_EQ(store.recalled, 0);
    EXPECT_EQ(openings(&store, quadratic), plain);
    EXPECT_EQ(store.kept, 2) << "nothing was assembled";
    EXPECT_EQ(store.recalled, 2);
  }
}

TEST(RowStore, WhatIsRecalledIsWhatIsUsed) {
  MemoryStore store;
  const std::vector<Vec3> plain = openings(&store);
  for (auto& [name, rows] : store.rows)
    for (EnrichmentRows& r : rows)
      for (double& entry : r.sources.data)
        entry *= 2;
  EXPECT_NE(openings(&store), plain);
}

TEST(RowStore, RowsOfAnotherSizeAreMadeAgain) {
  MemoryStore store;
  const std::vector<Vec3> plain = openings(&store);
  for (auto& [name, rows] : store.rows)
    rows.pop_back();
  EXPECT_EQ(openings(&store), plain);
  EXPECT_EQ(store.kept, 4);
}

}  // namespace conchoid
