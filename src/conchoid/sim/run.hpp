#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/io/run_folder.hpp"
#include "conchoid/learn/sample.hpp"
#include "conchoid/sim/body.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

class Regressor;

struct RunOptions {
  std::string method = "bem";                       ///< where the opening comes from: sim/methods.hpp
  const Regressor* regressor = nullptr;             ///< for the methods that need one
  std::optional<double> tolerance;                  ///< of hybrid runs (PredictionContext); none: standard
  bool measured_samples = false;                    ///< samples hold what is measured around fronts, too
  std::optional<int> frames;                        ///< in place of the scene's
  std::optional<std::filesystem::path> folder;      ///< run folder to write; none: nothing is written
  std::optional<std::vector<std::string>> formats;  ///< of the pieces, in place of the scene's
  bool resume = false;    ///< go on after the last complete frame of the folder, if any
  bool fragments = true;  ///< cut the body; without, the run ends when it comes apart
  bool progress = true;   ///< a line on the terminal
};

/// What a run gives, in the scene's coordinates.
struct RunResult {
  RunDocument document;
  TriMesh crack;                    ///< fine crack surface, trimmed to the body
  std::vector<Fragment> fragments;  ///< largest first
  std::vector<FrontRow> front;      ///< every front point of every frame
  SampleSet samples;                ///< of a BEM run: front elements paired over two frames
  int cracks = 0;                   ///< that started or were there
  double largest_growth = 0;        ///< farthest that any front has travelled [m]
};

/// Runs a scene: solve or predict the opening, SIFs, advance, until nothing moves in the body and its pieces or
/// the frame limit is reached; what comes apart is cut. document.stop says which (io/outcome.hpp). Same
/// scene, same bits: for every number of threads, with a folder or without, stopped and resumed or not.
/// Throws InputError for an unknown method, or a regressor or tolerance that does not go with it, and when what is to be
/// resumed belongs to another scene, method, regressor or version. For more than one load, or one step at a
/// time: Fracture (fracture.hpp) and Breakup (breakup.hpp), which this is a thin driver of.
RunResult run_scene(const Scene& scene, const RunOptions& options);

/// The same for a body in memory, in place of the one the scene names: material, conditions, resolution and
/// further cracks are the scene's.
RunResult run_body(const Scene& scene, Body body, const RunOptions& options);

/// The same for a body that has been made ready for the scene (prepare()), as those of databases are
/// (sim/make_runs.hpp).
RunResult run_prepared(const Scene& scene, const std::shared_ptr<const PreparedBody>& body,
                       const RunOptions& options);

/// The same for a body that has been made ready for the scene (prepare()), as those of databases are
/// (sim/make_runs.hpp).
RunResult run_prepared(const Scene& scene, const std::shared_ptr<const PreparedBody>& body,
                       const RunOptions& options);

}  // namespace conchoid
