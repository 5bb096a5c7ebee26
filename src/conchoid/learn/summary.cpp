#include "conchoid/learn/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "conchoid/core/bytes.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

std::string text(const json& j) {
  return j.dump(2, ' ', false, json::error_handler_t::replace);
}

json per_mode(const Vec3& v) {
  return {{"I", v[0]}, {"II", v[1]}, {"III", v[2]}};
}

json to_json(const Accuracy& a) {
  return {{"rmse", per_mode(a.rmse)}, {"r2", per_mode(a.r2)}};
}

json to_json(const Statistics& s) {
  return {{"median", s.median},
          {"mean", s.mean},
          {"coefficient_of_variation", s.coefficient_of_variation},
          {"minimum", s.minimum},
          {"maximum", s.maximum}};
}

}  // namespace

DatabaseInfo database_info(const Database& database) {
  DatabaseInfo info;
  info.header = database.header;
  info.runs = database.runs.size();
  info.samples = database.samples.size();
  info.complete = database.complete();
  info.hash = database.hash();
  for (const SampleField& field : SampleSet::fields())
    info.features.emplace_back(field.name);
  for (const FeatureSet set : all_feature_sets())
    info.feature_sets.emplace_back(name(set));
  for (const RunRecord& run : database.runs) {
    ++info.stops[run.stop];
    if (run.excluded) {
      ++info.excluded_runs;
      ++info.exclusions[run.reason.substr(0, run.reason.find(':'))];
    } else {
      info.training_samples += run.samples;
    }
    info.mean_frames += run.frames / static_cast<double>(info.runs);
    info.wall_seconds += run.wall_seconds;
  }
  TrainingChoice published, with_new_nodes;
  with_new_nodes.new_nodes = true;
  const std::size_t with_them = database.training_samples(with_new_nodes).size();
  info.end_game_samples = info.training_samples - with_them;
  info.new_node_samples = with_them - database.training_samples(published).size();
  return info;
}

Statistics statistics(std::vector<double> values) {
  Statistics s;
  if (values.empty()) return s;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  s.minimum = values.front();
  s.maximum = values.back();
  s.median = (values[(n - 1) / 2] + values[n / 2]) / 2;
  for (const double v : values)
    s.mean += v / static_cast<double>(n);
  double square = 0;
  for (const double v : values)
    square += (v - s.mean) * (v - s.mean);
  const double deviation = n > 1 ? std::sqrt(square / static_cast<double>(n - 1)) : 0.0;
  s.coefficient_of_variation =
      s.mean != 0 ? deviation / s.mean : (deviation > 0 ? std::numeric_limits<double>::infinity() : 0.0);
  return s;
}

DatabaseStatistics database_statistics(const Database& database) {
  const SampleSet samples = database.training_samples();
  DatabaseStatistics result;
  result.samples = samples.size();
  for (std::size_t mode = 0; mode < 3; ++mode)
    result.K[mode] = statistics(samples.field(mode));
  return result;
}

std::string json_text(const DatabaseInfo& info) {
  return text({{"runs", info.runs},
               {"samples", info.samples},
               {"features", info.features},
               {"feature_sets", info.feature_sets},
               {"material", json::parse(json_text(info.header.material))},
               {"models", info.header.models},
               {"complete", info.complete},
               {"planned_runs", info.header.planned_runs},
               {"shard", {info.header.shard, info.header.shards}},
               {"seed", info.header.seed},
               {"resolution", info.header.resolution},
               {"excluded_runs", info.excluded_runs},
               {"training_samples", info.training_samples},
               {"end_game_samples", info.end_game_samples},
               {"new_node_samples", info.new_node_samples},
               {"stops", info.stops},
               {"exclusions", info.exclusions},
               {"mean_frames", info.mean_frames},
               {"wall_seconds", info.wall_seconds},
               {"spec", info.header.spec},
               {"hash", hex(info.hash)}});
}

std::string json_text(const DatabaseStatistics& s) {
  return text({{"samples", s.samples},
               {"K_I", to_json(s.K[0])},
               {"K_II", to_json(s.K[1])},
               {"K_III", to_json(s.K[2])}});
}

std::string json_text(const Evaluation& e) {
  json j = to_json(e.model.accuracy);
  j["model"] = e.model.name;
  j["samples"] = e.samples;
  j["runs"] = e.runs;
  if (e.model.direction_error) j["direction_error"] = *e.model.direction_error;
  if (e.kept_direction_error) j["kept_direction_error"] = *e.kept_direction_error;
  for (const Score& baseline : e.baselines)
    j["baseline_" + baseline.name] = to_json(baseline.accuracy);
  j["in_range"] = e.model.in_range;
  j["spread"] = per_mode(e.model.spread);
  j["seen_in_training"] = e.seen_in_training;
  return text(j);
}

std::string json_text(const Regressor& regressor) {
  const Provenance& p = regressor.provenance();
  json features = json::array();
  const std::vector<std::string> names = feature_names(regressor.feature_set());
  for (std::size_t i = 0; i < names.size(); ++i)
    features.push_back({{"name", names[i]},
                        {"minimum", regressor.ranges()[i].minimum},
                        {"maximum", regressor.ranges()[i].maximum},
                        {"quantile_levels", FeatureRange::levels},
                        {"quantiles", regressor.ranges()[i].quantiles}});
  json calibration;  // null: none
  if (regressor.calibrated())
    for (const SpreadCalibration& mode : regressor.record().calibration) {
      json knots = json::array();
      for (const SpreadCalibration::Knot& knot : mode.knots())
        knots.push_back({{"stated", knot.stated}, {"found", knot.found}});
      calibration.push_back(std::move(knots));
    }
  json j = json::parse(regressor.settings_json());
  j.update(json::parse(regressor.fit_json()));
  j.update({{"model", regressor.name()},
            {"feature_set", name(regressor.feature_set())},
            {"features", features},
            {"hidden_features", p.hidden_features},
            {"models", p.models},
            {"material", json::parse(json_text(p.material))},
            {"resolution", p.resolution},
            {"runs", p.runs},
            {"samples", p.samples},
            {"samples_hash", hex(p.samples_hash)},
            {"calibration", calibration},
            {"content_hash", hex(regressor.content_hash())},
            {"spec", p.spec}});
  return text(j);
}

}  // namespace conchoid
