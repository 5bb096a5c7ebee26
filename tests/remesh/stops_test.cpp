// Every long stage of making and mending surfaces hears a request to stop, and tells how far it is.

#include <gtest/gtest.h>

#include "conchoid/intersect/corefine.hpp"
#include "conchoid/mesh/crack_meshes.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/repair.hpp"
#include "mesh/mesh_checks.hpp"
#include "stops.hpp"

namespace conchoid {
namespace {

using test::expect_stop;

TriMesh large_ball() {
  return icosphere(1, 6);
}

}  // namespace

TEST(Stops, RemeshingHearsThem) {
  const TriMesh ball = large_ball();
  expect_stop("decimated", [&] { remesh(ball, 2000); });
  expect_stop("remeshing", [&] { remesh(ball, 2000); });
}

TEST(Stops, RepairHearsThem) {
  TriMesh mesh = large_ball();
  append(mesh, large_ball(), Vec3(1.02, 0.03, 0.05));
  expect_stop("mending", [&] { repaired(mesh); });
  expect_stop("level set", [&] { repaired(mesh, 0.01); });
  expect_stop("decimated", [&] { repaired(mesh, 0.02); });
}

TEST(Stops, CuttingHearsThem) {
  const TriMesh ball = large_ball();
  const TriMesh sheet = disc_crack(Vec3(0.01, 0.02, 0.03), Vec3(0, 0.1, 1), 1.5, {.edge = 0.02});
  expect_stop("cut", [&] { corefine(ball, sheet); });
}

}  // namespace conchoid
