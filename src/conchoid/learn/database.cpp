#include "conchoid/learn/database.hpp"

#include <map>
#include <set>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/run_part.hpp"

namespace conchoid {

std::int32_t DatabaseHeader::planned_here() const {
  return shard > planned_runs ? 0 : (planned_runs - shard) / shards + 1;
}

SampleSet Database::training_samples(const TrainingChoice& choice) const {
  std::set<std::int32_t> left_out;
  for (const RunRecord& run : runs)
    if (run.excluded || !choice.takes(run.body_class)) left_out.insert(run.id);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!left_out.contains(samples.run()[i]) && choice.takes(samples[i])) kept.push_back(i);
  return samples.subset(kept);
}

SampleSet Database::samples_to_judge(FeatureSet features, TrainingChoice choice) const {
  choice.end_game = learns_all_samples(features);
  choice.new_nodes = false;
  return training_samples(choice);
}

std::set<std::string> Database::body_classes() const {
  std::set<std::string> classes;
  for (const RunRecord& run : runs)
    classes.insert(run.body_class);
  return classes;
}

std::uint64_t Database::hash() const {
  ByteWriter out;
  out.put_text(header_text(header, false));
  for (const RunRecord& r : runs) {
    out.put(r.id);
    out.put(r.seed);
    for (const double x : {r.direction[0], r.direction[1], r.direction[2], r.magnitude, r.alpha, r.beta})
      out.put(x);
    out.put(r.body);
    out.put_text(r.body_class);
    out.put_text(r.load);
    out.put(r.frames);
    out.put_text(r.stop);
    out.put_text(r.excluded ? "excluded: " + r.reason : "kept");
    out.put(r.samples);
    out.put(r.hash);
  }
  out.put(samples.hash());
  return hash_bytes(out.bytes());
}

Database merge_databases(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) throw InputError("nothing to merge; name at least one database");
  Database result;
  std::map<std::int32_t, std::pair<RunPart, std::size_t>> runs;  // with the index of the file a run came from
  for (std::size_t f = 0; f < files.size(); ++f) {
    const Database database = read_database(files[f]);
    if (f == 0) {
      result.header = database.header;
      result.header.shard = result.header.shards = 1;
    } else if (header_text(database.header, false) != header_text(result.header, false)) {
      throw InputError(files[f].string() + ": differs from " + files[0].string() +
                       " in specification, files that it names, seed, number of runs, model or material; "
                       "merge only shards of one specification");
    }
    std::size_t first = 0;
    for (const RunRecord& run : database.runs) {
      std::vector<std::size_t> indices(run.samples);
      for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = first + i;
      first += run.samples;
      const auto [entry, is_new] =
          runs.try_emplace(run.id, RunPart{run, database.samples.subset(indices)}, f);
      if (!is_new &&
          (entry->second.first.record.hash != run.hash || entry->second.first.record.seed != run.seed))
        throw InputError(files[f].string() + ": run " + std::to_string(run.id) + " differs from the one in " +
                         files[entry->second.second].string() + "; generate one of the two again");
    }
  }
  for (const auto& [id, entry] : runs) {
    result.runs.push_back(entry.first.record);
    result.samples.append(entry.first.samples);
  }
  return result;
}

}  // namespace conchoid
