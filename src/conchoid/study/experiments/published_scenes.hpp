#pragma once

#include <string>

#include "conchoid/study/experiments/workshop.hpp"

namespace conchoid {

// Bodies, loads and databases of the publication (Huang, Yu & Kanai, Predicting Brittle Fracture Surface Shape
// From Versatile Database, Computer Animation and Virtual Worlds) as texts of scenes and specifications.
// E = 3.1e9 Pa, ν = 0.327, ρ = 1200 kg/m³, strength 7.6e7 Pa, K_c = 1e6 Pa√m unless a variant says otherwise.
// Every scene ends with its table [run].

/// What a scene or database differs in from the published one.
struct Variant {
  double toughness = 1e6;        ///< K_c [Pa√m]
  bool noisy_toughness = false;  ///< K_c varies by ±40 % over a wavelength of 0.3 m
  double load = 1;               ///< factor on the load
  double turned = 0;             ///< of the load's slope [degree]
  double rotation = 0;           ///< β of the load about the axis [degree]
  double crack_edge = 1;         ///< factor on r̄
  int remesh = 0;                ///< triangles of another surface mesh; 0: the model's own
};

/// K_c at which the published loads are a few times what moves the fronts [Pa√m].
inline constexpr double kNearToughness = 2e7;

/// Cube and cylinder, pulled by 1e8 Pa on z+ (top) and its opposite on z− (bottom).
/// @param slope  α of the load to the axis z, turned towards x [degree]
std::string cube_scene(double slope, const Variant& variant = {});
std::string cylinder_scene(double slope, const Variant& variant = {});
/// The notched bar in three-point bending: rollers under it, the traction on the strip above.
std::string bar_scene();
/// The cube with an edge crack under 20 MPa in mode 1, 2 or 3.
std::string edge_crack_scene(int mode);
/// The scan at `file`, feet fixed, hands pulled apart by 1e6 Pa (5e5 Pa in the publication: 0.72 of what starts
/// a crack).
std::string armadillo_scene(const std::filesystem::path& file);

// Databases: runs as published for StudyScale::full.
std::string cube_database(StudyScale scale, const Variant& variant = {});
std::string small_cube_database(StudyScale scale);  ///< the published one of 3001 runs, another seed
std::string cylinder_database(StudyScale scale);
std::string bar_database(StudyScale scale);
std::string armadillo_database(const std::filesystem::path& file, StudyScale scale);
/// Loads of one direction and varied magnitude alone, as for the comparison of feature sets.
std::string magnitude_database(StudyScale scale, const Variant& variant = {});
/// Runs of the cube that no training sees: other seed, slopes to 60°.
std::string held_out_cubes(StudyScale scale, const Variant& variant = {});

/// Scene number `i` of the loads that no database has seen: those of held_out_cubes(), on cube or cylinder.
using SceneOfLoad = std::string (*)(double slope, const Variant& variant);
std::string held_out_scene(SceneOfLoad scene, int i);

}  // namespace conchoid
