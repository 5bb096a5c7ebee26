#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "conchoid/learn/exclusion.hpp"
#include "conchoid/sim/scene.hpp"
#include "conchoid/sim/world.hpp"

namespace conchoid {

class Regressor;

/// What the runs of a database have in common, and how their loads are drawn: a traction f on one region and
/// −f on another (or none: then conditions of the scene hold the body), |f| and the direction at random. The direction has the slope α to the pole of a hemisphere
/// and the rotation β about it, f = |f| (sin α cos β e1 + sin α sin β e2 + cos α pole), e1 along the
/// coordinate axis after the one the pole is nearest to (x for z), e2 = pole × e1.
struct DatabaseSpec {
  Scene scene;  ///< without the drawn loads; its text is the whole specification
  int runs = 300;
  std::uint64_t seed = 1;
  std::string pulled, opposite;            ///< regions; the second may be empty: none
  Vec3 pole = Vec3::UnitZ();               ///< unit vector
  std::array<double, 2> magnitude{};       ///< [Pa]
  std::array<double, 2> slope{0, 90};      ///< α [degree]
  std::array<double, 2> rotation{0, 360};  ///< β [degree]
  ExclusionSettings exclusion;
  std::optional<WorldSpec> world;            ///< everything is drawn at random; none: as above
  std::shared_ptr<const Regressor> led_by;   ///< leads the fronts (LedOpening); null: nothing does
  std::vector<std::filesystem::path> files;  ///< meshes and regressors that it names
};

/// What a body is called in databases: its model, or the name of its file.
std::string body_class(const BodySpec& body);

/// Reads a specification: a scene file with a table [database]. Throws InputError "file:line: what, remedy".
DatabaseSpec read_database_spec(const std::filesystem::path& path);
DatabaseSpec parse_database_spec(std::string_view text, const std::string& name,
                                 const std::filesystem::path& folder);

/// The load of one run.
struct DrawnLoad {
  std::uint64_t seed = 0;
  double slope = 0, rotation = 0;  ///< α, β [degree]
  double magnitude = 0;            ///< |f| [Pa]
  Vec3 direction = Vec3::UnitZ();  ///< of f, unit vector
};

/// Run `run` of the specification, the same whatever the number of runs and the order in which they are
/// drawn.
DrawnLoad draw_load(const DatabaseSpec& spec, int run);

/// The scene of a run: the common one under its load, with inertia relief unless something holds the body.
Scene loaded_scene(const DatabaseSpec& spec, const DrawnLoad& load);

}  // namespace conchoid
