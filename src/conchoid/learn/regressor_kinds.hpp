#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

/// A number that the training of one kind of regressor can be given; on the command line --NAME.
struct TrainingOption {
  std::string_view name;
  std::string_view help;
  std::optional<double> standard;  ///< where none is given; none: chosen from the samples
  double minimum = 0, maximum = 0;
  bool whole = true;  ///< a whole number
};

/// What a training is asked for.
struct TrainingSettings {
  FeatureSet features = FeatureSet::paper_4;
  std::uint64_t seed = 1;                              ///< of whatever is drawn at random
  std::map<std::string, double, std::less<>> options;  ///< by name; what is missing has its standard value
};

/// A kind of regressor: how it is called, trained and read. A new one is a class in files of its own and one
/// entry in regressor_kinds.cpp; the command line and the runs find it there.
struct RegressorKind {
  std::string_view name;      ///< as --model and --method: "forest"
  std::string_view title;     ///< in a sentence: "regression forest"
  std::string_view magic;     ///< the first eight bytes of its files
  std::uint32_t version = 1;  ///< of the file, the newest this program writes and reads
  std::vector<TrainingOption> options;
  std::unique_ptr<Regressor> (*train)(const SampleSet& samples, const TrainingSettings& settings,
                                      Provenance provenance, const TrainingProgress& progress) = nullptr;
  /// @param settings  as settings_json() gave it @param fit  as write_fit() wrote it
  std::unique_ptr<Regressor> (*read)(TrainingRecord record, const std::string& settings,
                                     ByteReader& fit) = nullptr;
};

const std::vector<RegressorKind>& regressor_kinds();
/// Throws InputError that lists the known names.
const RegressorKind& regressor_kind(std::string_view name);
/// "forest, ridge"
std::string regressor_names();

/// Trains a regressor of a kind. Throws InputError if an option does not belong to the kind or is out of its
/// range, and as the kind's own training does.
std::unique_ptr<Regressor> train_regressor(const RegressorKind& kind, const SampleSet& samples,
                                           const TrainingSettings& settings, Provenance provenance = {},
                                           const TrainingProgress& progress = {});

/// The value of an option of a kind, if it is given or has a standard value.
std::optional<double> option_value(const RegressorKind& kind, const TrainingSettings& settings,
                                   std::string_view option);
/// The same of one that is a whole number and has a standard value.
int whole_option_value(const RegressorKind& kind, const TrainingSettings& settings, std::string_view option);

}  // namespace conchoid
