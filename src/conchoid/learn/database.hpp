#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "conchoid/learn/features.hpp"
#include "conchoid/learn/material_record.hpp"
#include "conchoid/learn/sample.hpp"

namespace conchoid {

/// What all runs of a database have in common.
struct DatabaseHeader {
  std::vector<std::string> models;  ///< cube, cylinder, …
  MaterialRecord material;
  double resolution = 0;    ///< r̄ [m]
  std::string spec;         ///< text of the specification, as read
  std::uint64_t files = 0;  ///< hash of the meshes and regressors that it names; 0: none
  std::uint64_t seed = 0;
  std::int32_t planned_runs = 0;       ///< of the whole database: ids 0 … planned_runs − 1
  std::int32_t shard = 1, shards = 1;  ///< this file is to hold the runs with id ≡ shard − 1 modulo shards
  bool operator==(const DatabaseHeader&) const = default;

  /// Whether a run belongs to this shard of the plan.
  bool plans(std::int32_t run) const { return run >= 0 && run < planned_runs && run % shards == shard - 1; }
  std::int32_t planned_here() const;
};

/// One run of a database.
struct RunRecord {
  std::int32_t id = 0;
  std::uint64_t seed = 0;
  Vec3 direction = Vec3::Zero();  ///< unit vector of the force
  double magnitude = 0;           ///< of the load, in the unit the specification names
  double alpha = 0, beta = 0;     ///< slope and rotation of the direction [degree]
  std::int32_t body = 0;          ///< number of the body, where runs have different ones
  std::string body_class;  ///< what the body is one of: "cube", "box", "cup"; whole classes can be held out
  std::string load;        ///< kind of load: "pull", "bend", …; empty: a traction along the direction
  std::int32_t frames = 0;
  std::string stop;           ///< why it ended: arrested, separated, frame-limit, …
  bool excluded = false;      ///< not to be learned from
  std::string reason;         ///< why excluded
  std::uint64_t samples = 0;  ///< filled in by DatabaseWriter::add
  double wall_seconds = 0;
  std::uint64_t hash = 0;  ///< of its samples; filled in by DatabaseWriter::add
  bool operator==(const RunRecord&) const = default;
};

/// What of a database is learned from.
struct TrainingChoice {
  /// Openings beyond kLargestOpening, too: a piece hangs by a ligament. The published method leaves them out.
  bool end_game = false;
  std::set<std::string> only;     ///< classes of bodies; empty: all
  std::set<std::string> without;  ///< classes that are held out
  /// Nodes that are new on a front, too (is_new_on_front()). The published method has no past for them.
  bool new_nodes = false;

  bool takes(const std::string& body_class) const {
    return !without.contains(body_class) && (only.empty() || only.contains(body_class));
  }
  bool takes(const Sample& s) const {
    return (end_game || !is_end_game(s)) && (new_nodes || !is_new_on_front(s));
  }
};

/// Everything in a database file: runs ordered by id, samples in the order of their runs.
struct Database {
  DatabaseHeader header;
  std::vector<RunRecord> runs;
  SampleSet samples;

  /// All planned runs are there.
  bool complete() const { return static_cast<std::int32_t>(runs.size()) == header.planned_here(); }
  /// Samples of the runs that are not excluded, as far as they are chosen.
  SampleSet training_samples(const TrainingChoice& choice = {}) const;
  /// What a regressor of these features is judged by: all that it could learn from, as far as it is chosen, but for nodes that
  /// are new on a front, which have no opening to compare with.
  SampleSet samples_to_judge(FeatureSet features, TrainingChoice choice = {}) const;
  /// Classes of bodies that runs are of.
  std::set<std::string> body_classes() const;
  /// Hash of the content; wall-clock times do not enter.
  std::uint64_t hash() const;
};

/// Collects the runs of a database so that a kill at any moment loses no finished run.
///
/// Every finished run becomes a small file of its own in the folder FILE.parts, which appears complete or not
/// at all; finish() assembles FILE (HDF5) from them, in the order of run ids, whatever the order, the number
/// of workers and the interruptions. A locked file in the folder keeps a second program from writing the same
/// database.
class DatabaseWriter {
 public:
  /// @param resume  go on with what FILE and FILE.parts hold; without it both must not exist
  /// Throws InputError if something exists and resume is not set, if it belongs to another header, or if the
  /// place cannot be written.
  DatabaseWriter(std::filesystem::path file, DatabaseHeader header, bool resume);
  ~DatabaseWriter();
  DatabaseWriter(const DatabaseWriter&) = delete;
  DatabaseWriter& operator=(const DatabaseWriter&) = delete;

  /// Whether a run is already kept.
  bool has(std::int32_t run) const;
  std::size_t size() const;
  /// Keeps a finished run: on the disk when this returns. May be called from several threads.
  /// Throws std::logic_error for a run that is not planned, kept already, or whose samples bear another run
  /// id.
  void add(RunRecord record, const SampleSet& samples);
  /// Writes FILE from all runs kept so far. Once all planned runs are there, the folder FILE.parts is
  /// removed.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws InputError that begins with the file in a build without HDF5: known before runs are made, not after.
void require_databases(const std::filesystem::path& file);
/// Throws InputError that names file and remedy if it is truncated, corrupt, foreign or of a newer version.
Database read_database(const std::filesystem::path& file);
/// The file appears complete or not at all. The same database gives the same bytes.
void write_database(const std::filesystem::path& file, const Database& database);

/// Joins databases (shards) of one specification, seed and material into one. A run that several files hold
/// enters once. Throws InputError if they differ in anything but the shard, or if a run differs between two
/// files.
Database merge_databases(const std::vector<std::filesystem::path>& files);

}  // namespace conchoid
