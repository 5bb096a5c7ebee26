#include "conchoid/sim/broken_pieces.hpp"

#include <gtest/gtest.h>

#include "conchoid/mesh/models.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

/// A body of density 1200 with original faces alone.
Fragment fragment_of(const TriMesh& mesh) {
  Fragment f;
  f.mesh = mesh;
  f.volume = enclosed_volume(mesh);
  f.mass = 1200 * f.volume;
  f.inertia = f.mass * Mat3::Identity();
  f.face_kind.assign(mesh.triangle_count(), FaceKind::original);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    f.source.emplace_back(t);
  return f;
}

/// The part of the unit cube between two heights.
TriMesh slice(double low, double high) {
  TriMesh mesh = box_mesh(Vec3(1, 1, high - low), 1, 1, 1);
  const Vec3 move = Vec3(0, 0, low) - bounding_box(mesh).low;
  for (Vec3& x : mesh.positions)
    x += move;
  return mesh;
}

// The mesh of a piece that was mended encloses a little less than what was cut out.
TEST(BrokenPieces, PartsWeighWhatTheirPieceDid) {
  const auto body = std::make_shared<const PreparedBody>(
      prepare(test::scene_from_text("[body]\nmodel = \"cube\"\n" + test::material_text())));
  for (const double lost : {0.0, 5e-7, 8e-4}) {
    Pieces pieces;
    pieces.fragments.push_back(fragment_of(body->detailed));
    Fragment& whole = pieces.fragments.front();
    whole.volume *= 1 + lost;
    whole.mass *= 1 + lost;
    const double volume = whole.volume, mass = whole.mass;
    BrokenPieces broken(body, std::move(pieces), {});
    Pieces parts;
    parts.fragments = {fragment_of(slice(0, 0.7)), fragment_of(slice(0.7, 1))};
    EXPECT_EQ(broken.replace(0, parts), 1u);
    const std::vector<Fragment> made = broken.take().fragments;
    ASSERT_EQ(made.size(), 2u);
    EXPECT_NEAR(made[0].volume + made[1].volume, volume, 1e-12 * volume) << lost;
    EXPECT_NEAR(made[0].mass + made[1].mass, mass, 1e-12 * mass) << lost;
    EXPECT_NEAR(made[0].inertia(0, 0), 0.7 * mass, 1e-12 * mass) << lost;
  }
}

}  // namespace
}  // namespace conchoid
