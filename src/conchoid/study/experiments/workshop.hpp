#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "conchoid/core/byte_cache.hpp"
#include "conchoid/io/run_folder.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// smoke: every experiment in minutes, with small databases; full: the published sizes.
enum class StudyScale { smoke, full };
/// "smoke" or "full". Throws InputError for another name.
StudyScale study_scale_from_name(const std::string& name);
std::string_view name(StudyScale scale);

/// How a forest is trained.
struct ForestChoice {
  int trees = 50, depth = 10;
  std::string features = "paper-4";
  std::uint64_t seed = 1;
};

/// A regressor with what its training took.
struct TrainedForest {
  std::unique_ptr<Regressor> regressor;
  double seconds = 0;
};

/// How a scene is run.
struct MethodChoice {
  std::string title;           ///< in tables and plots
  std::string method = "bem";  ///< sim/methods.hpp
  int solve_every = 0;         ///< run.solve_every
  const Regressor* regressor = nullptr;
  int frames = 0;                        ///< most frames; 0: the scene's
  std::optional<double> tolerance = {};  ///< of hybrid runs
};

/// A run: a scene whose last table is [run], and how.
struct RunChoice {
  std::string text;
  MethodChoice method = {};
};

/// Makes databases, forests and runs for experiments, each only once: everything is kept in a folder under a
/// name made from all that it depends on, so that experiments share what they have in common, and what was
/// interrupted goes on. Everything that is random has its seed in the texts.
class Workshop {
 public:
  /// @param folder  of the report; `cache` in it is what is kept. Made if need be.
  /// @param armadillo  file of the scan; empty: none
  Workshop(std::filesystem::path folder, StudyScale scale, std::filesystem::path armadillo);

  StudyScale scale() const { return scale_; }
  bool full() const { return scale_ == StudyScale::full; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::filesystem::path& armadillo() const { return armadillo_; }

  /// @param text  of a specification (sim/database_spec.hpp)
  const Database& database(const std::string& text);
  /// A forest of the training samples of a database.
  const TrainedForest& forest(const std::string& database_text, const ForestChoice& choice);
  /// @param text  of a scene whose last table is [run]
  const RunData& run(const std::string& text, const MethodChoice& method = {});
  /// Makes those of these runs that have not been made, side by side: for tables that tell no times.
  void make_runs(const std::vector<RunChoice>& runs) const;
  /// Folder of that run, which has been made.
  std::filesystem::path run_folder(const std::string& text, const MethodChoice& method) const;
  /// Specifications of the databases that were asked for, directly or for a forest.
  const std::set<std::string>& specifications() const { return specifications_; }
  /// Where a picture is to be written.
  std::filesystem::path picture_file(const std::string& name) const;

 private:
  void make_run(const std::string& text, const MethodChoice& method) const;
  std::filesystem::path cached(const std::string& kind, const std::string& made_from) const;

  std::filesystem::path folder_, armadillo_;
  StudyScale scale_;
  std::shared_ptr<const ByteCache> prepared_;  // bodies
  std::set<std::string> specifications_;
  std::map<std::string, Database> databases_;
  std::map<std::string, TrainedForest> forests_;
  std::map<std::string, RunData> runs_;
};

}  // namespace conchoid
