#pragma once

#include <string>
#include <vector>

#include "conchoid/sim/body.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

/// A training world: scenes whose body, supports, material, cracks and load are all drawn at random.
struct WorldSpec {
  std::vector<std::string>
      classes;            ///< of bodies (world_bodies.hpp), drawn in turn: body b is of class b mod n
  int runs_per_body = 4;  ///< loads on each body: run i is of body i / runs_per_body
  int elements = 240;     ///< boundary elements wanted per body
  double cracked = 0.3;   ///< share of the bodies that have a crack from the start
  std::vector<TriMesh> scans = {};  ///< what bodies of the class "scan" are made from (scan_of())
};

/// One body of a world with everything that its runs have in common. All lengths are about a metre; E, ν and the
/// strain at the strength are drawn from what brittle solids have, K_c from 0.02 to 0.4 × strength × √(π r̄).
/// Supports: free (inertia relief), low end held, or both ends held.
struct WorldBody {
  std::string body_class;
  Body body;    ///< with the regions low, high (its ends along `axis`), side, and inside where it is hollow
  Scene scene;  ///< material, resolution, cracks, settings, supports; without a load
  Vec3 axis = Vec3::UnitZ();
};

/// Body number `body` of a world, the same whatever else is drawn. Throws ComputationError where what was drawn
/// cannot be meshed.
WorldBody draw_world_body(const WorldSpec& world, std::uint64_t seed, int body);

/// The body made ready to compute under all loads of its world. Throws as prepare() does.
std::shared_ptr<const PreparedBody> prepare(const WorldBody& body);

/// The load of one run.
struct WorldLoad {
  std::uint64_t seed = 0;
  std::string kind;                ///< pull, shear, bend, twist or pressure
  Vec3 direction = Vec3::UnitZ();  ///< unit vector: of the traction, or the axis of bending or twisting
  double slope = 0;                ///< between direction and the body's axis [degree]
  double magnitude = 0;            ///< largest traction or pressure [Pa]
  std::vector<BoundaryCondition> conditions;
};

/// Load number `run` of a world on its body. Its size follows from the uncracked body's stress: 1.02 to 1.6 times
/// what starts a crack, or, where there is one, a stress across it for which K of a disc in an unbounded body is 1.1 to
/// 10 K_c. Throws ComputationError where no load of that kind opens or starts a crack.
WorldLoad draw_world_load(const WorldBody& body, const PreparedBody& prepared, std::uint64_t seed, int run);

/// The scene of a run.
Scene loaded_scene(const WorldBody& body, const WorldLoad& load);

}  // namespace conchoid
