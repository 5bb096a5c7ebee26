#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "conchoid/io/outcome.hpp"
#include "conchoid/surface/contacts.hpp"

namespace conchoid {

/// One setting of a run as it took effect, "section.key" as in the scene.
struct RunSetting {
  std::string name;
  std::variant<bool, std::int64_t, double, std::string> value;
};
/// "run.tolerance" of hybrid runs: a number, or "inf".
RunSetting tolerance_setting(double tolerance);

/// What one frame did and cost [s].
struct FrameRecord {
  int frame = 0;
  std::string
      source;  ///< who gave the opening: a method (sim/methods.hpp) or "carried" (nothing could be solved)
  std::size_t crack_triangles = 0;  ///< BEM crack triangles after the frame
  std::size_t front_nodes = 0;
  double crack_area =
      0;  ///< of the BEM cracks after the frame [m²], of the body that breaks; 0: not recorded
  double max_K_eff = 0;  ///< largest effective intensity along the fronts [Pa √m]
  double opening_seconds = 0, fracture_seconds = 0, other_seconds = 0;
  std::optional<double> expected_error =
      {};  ///< of the surface so far, over the body's diagonal; hybrid runs
};

/// What run.json and --json say about a fragment.
struct FragmentRecord {
  double volume = 0;                   ///< [m³]
  double mass = 0;                     ///< [kg]
  Vec3 center_of_mass = Vec3::Zero();  ///< [m]
  Mat3 inertia = Mat3::Zero();         ///< [kg m²]
  bool watertight = false;
  std::size_t triangles = 0;
  double fracture_area = 0;  ///< [m²]
};
FragmentRecord fragment_record(const Fragment& fragment);

/// Everything a run reports: the content of run.json, and of `run --json`.
struct RunDocument {
  std::string scene_file, scene_text;
  std::string method;  ///< "bem", "steady", "forest", …: sim/methods.hpp
  StopReason stop = StopReason::frame_limit;
  /// A sentence that belongs to `stop`: how near to breaking an intact body is and where, how near to moving the
  /// fronts that stay. Empty where there is nothing to add.
  std::string stop_details;
  double crack_area = 0;  ///< of the crack surface, one side of it [m²]
  std::optional<double>
      largest_K_over_Kc;  ///< K_eff / K_c along the fronts as last computed (sim/load_report.hpp)
  std::optional<double> stress_over_strength;  ///< largest σ1 / S_c before anything moved
  int frames = 0;
  int solved_frames = 0;                 ///< of these, by boundary elements
  std::optional<double> expected_error;  ///< largest of the frames (FrameRecord)
  int resumed_after = 0;  ///< complete frames that were found; the times are those of the run that went on
  std::size_t initial_triangles = 0, final_triangles = 0;
  double total_seconds = 0, opening_seconds = 0, fracture_seconds = 0, other_seconds = 0;
  double opening_seconds_per_frame = 0;
  std::optional<Box> body;  ///< the body's bounding box; none for the infinite body
  double body_volume = 0;   ///< [m³]
  std::vector<RunSetting> settings;
  std::vector<RunSetting> versions;  ///< conchoid, compiler, libraries
  std::vector<std::string> warnings;
  std::vector<FrameRecord> timings;
  std::vector<FragmentRecord> fragments;
  std::vector<FragmentContact> contacts;  ///< which fragments share which fracture area
  std::string hash;                       ///< of the result: same inputs, same hash
};

enum class RunJson { report, document };
/// One JSON object. `report`: the keys of `run --json`. `document`: these and scene, settings, versions,
/// timings (run.json). Numbers that are not finite become null.
std::string run_json(const RunDocument& document, RunJson extent);

/// Reads run.json. @param path  the file. Throws InputError for a foreign, damaged or newer file.
RunDocument read_run_json(const std::filesystem::path& path);

}  // namespace conchoid
