#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/core/vec.hpp"
#include "conchoid/elastic/constants.hpp"
#include "conchoid/material/material_field.hpp"
#include "conchoid/mesh/region_rules.hpp"
#include "conchoid/sim/output_spec.hpp"

namespace conchoid {

// What a scene file says, checked as far as that is possible without the mesh. Keys, units, ranges and
// defaults: settings.hpp, docs/scene.md. `where` is the place in the file, "scene.toml:12", for messages
// about things that only the mesh shows.

struct BodySpec {
  std::string model;             ///< built-in model; empty: `mesh` is given
  std::filesystem::path mesh;    ///< absolute, or relative to the working folder; empty: `model` is given
  std::optional<int> remesh;     ///< wanted number of triangles
  bool follow_thickness = true;  ///< when remeshed: shorter edges on thin walls
  double scale = 1;  ///< factor on the coordinates of the body (and of the crack its model comes with)
  bool scale_given = false;  ///< none: a mesh that is hardly in metres is warned of
  std::string where;

  bool infinite() const { return model == "infinite"; }
};

struct MaterialSpec {
  std::string name;               ///< of the library (material/library.hpp); empty: none
  double youngs_modulus = 0;      ///< E [Pa]
  double poisson_ratio = 0;       ///< ν
  double density = 1200;          ///< [kg/m³]
  double strength = 7.6e7;        ///< [Pa]
  double toughness = 1e6;         ///< K_c [Pa√m]
  double compressive_factor = 3;  ///< ≥ 1
  std::vector<FieldFactor> toughness_field, strength_field;  ///< factors on the two; none: homogeneous

  ElasticConstants elastic() const { return {youngs_modulus, poisson_ratio}; }
};

struct ResolutionSpec {
  std::optional<double> crack;    ///< r̄ [m]
  std::optional<double> surface;  ///< [m]
  std::string where = "[resolution]";
};

struct SceneRegion {
  RegionRule rule;
  bool initiation = true;      ///< whether cracks may start there
  std::optional<double> edge;  ///< longest of the boundary elements there, when the body is remeshed [m]
  std::string where;
};

enum class ConditionKind { traction, force, pressure, displacement };

/// What acts on a region. Vectors are in the scene's axes: those of the file are turned when it is read.
struct BoundaryCondition {
  std::string region;
  ConditionKind kind = ConditionKind::traction;
  Vec3 value = Vec3::Zero();  ///< [Pa], [N] or [m]; fixed = true is a displacement of zero
  std::string where;
  std::array<bool, 3> held{true, true, true};  ///< displacement: along which of the axes it is prescribed
  Mat3 axes = Mat3::Identity();                ///< displacement: columns, orthonormal
  /// displacement: the load in the other directions, traction, force (both in free_value) or pressure
  ConditionKind free_kind = ConditionKind::traction;
  Vec3 free_value = Vec3::Zero();  ///< displacement: that traction [Pa] or force [N]
  double pressure = 0;             ///< pressure: along the inward normal [Pa]
  Vec3 moment = Vec3::Zero();      ///< force: about the centroid of the region [N m]
  Vec3 twist = Vec3::Zero();       ///< traction: t = value + twist × (x − about) [Pa/m]
  Vec3 about = Vec3::Zero();       ///< [m]

  std::vector<Vec3> held_directions() const;
  /// Projection onto the directions in which nothing is prescribed.
  Mat3 free_directions() const;
  /// What acts in these: itself, or what stands beside a displacement, as a condition without one.
  BoundaryCondition load() const;
  bool is_loaded() const;  ///< whether that is not zero
};

/// Forces on every part of the body, with the material's density.
struct BodyForceSpec {
  Vec3 gravity = Vec3::Zero();  ///< [m/s²]
  Vec3 spin = Vec3::Zero();     ///< ω [rad/s]
  std::optional<Vec3> on_axis;  ///< a point of the axis [m]; none: the centre of mass
};

enum class CrackKind { disc, ellipse, rectangle, mesh };

struct CrackSpec {
  CrackKind kind = CrackKind::disc;
  Vec3 center = Vec3::Zero();                       ///< disc, ellipse, rectangle [m]
  Vec3 normal = Vec3::UnitZ();                      ///< disc, ellipse; of any length but zero
  double radius = 0;                                ///< disc [m]
  Vec2 axes = Vec2::Zero();                         ///< ellipse: semi-axes a, b [m]
  std::optional<Vec3> direction;                    ///< disc, ellipse: direction of a
  Vec3 edge1 = Vec3::Zero(), edge2 = Vec3::Zero();  ///< rectangle: full edge vectors [m]
  std::filesystem::path file;                       ///< mesh
  std::optional<int> triangles;
  std::string where;
};

enum class SifSource { two_point, one_point };
enum class OpeningConvention { full, half };
enum class ElementOrder { by_walls, linear, quadratic };
enum class AfterSeparation { go_on, stop };

struct RunSpec {
  int frames = 30;
  int max_cracks = 1;            ///< of the whole run, in the body and its pieces
  int max_cracks_per_frame = 1;  ///< ≥ 1
  AfterSeparation after_separation = AfterSeparation::go_on;
  double smallest_body = 1e-2;  ///< share of the body's volume below which a piece breaks no further
  std::uint64_t seed = 1;
  bool inertia_relief = false;
  bool contact = true;
  SifSource sif = SifSource::two_point;
  OpeningConvention sif_convention = OpeningConvention::full;
  bool published_compression = false;  ///< with_compressive_factor() before growth, else closed faces
  ElementOrder elements = ElementOrder::by_walls;
  double quadrature_tolerance = 1e-6;
  std::string solver = "dense";  ///< of the body (bem/body_solver.hpp); no key of the scene, answers agree
  std::shared_ptr<const ByteCache> cache;  ///< of prepared bodies; no key of the scene
  bool exact_rayleigh_speed = true;
  int solve_every = 0;  ///< where openings are predicted: every Nth frame is solved; 0: frame 1 alone
  double smallest_fragment = 1e-4;  ///< share of the body's volume
  int max_fragments = 0;            ///< 0: no limit
};

struct Scene {
  std::string file;  ///< name for messages
  std::string text;  ///< the file's content
  BodySpec body;
  MaterialSpec material;
  ResolutionSpec resolution;
  std::vector<SceneRegion> regions;
  std::vector<std::string> quiet_regions;  ///< names of those where no crack starts
  std::vector<BoundaryCondition> boundary;
  BodyForceSpec body_force;
  std::vector<CrackSpec> cracks;
  /// Stress at infinity [Pa], for the infinite body.
  Mat3 remote_stress = Mat3::Zero();
  RunSpec run;
  OutputSpec output;
};

/// Reads a scene file. Throws InputError "file:line: what, remedy".
Scene read_scene(const std::filesystem::path& path);
/// @param name  for messages; @param folder  that file names in the scene are relative to
Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// Regions of the body's surface: those of the scene, then those of the built-in model for the triangles left
/// (a region of the scene replaces one of the model of the same name). `model_regions` is empty for mesh
/// files. Throws InputError for a region of the scene that gets no triangle.
/// @param attributes  of the surface: its materials
std::vector<Region> scene_regions(const Scene& scene, const TriMesh& surface,
                                  const std::vector<Region>& model_regions,
                                  const SurfaceAttributes& attributes = {});

}  // namespace conchoid
