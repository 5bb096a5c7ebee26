// File of a regressor, little-endian throughout:
//   magic of its kind (8 bytes) · version u32 · byte-order mark u32 · length of the rest without checksum u64
//   description (JSON text: settings, provenance, feature names, ranges, label scales)
//   what the reader of the kind takes · xxHash64 of all bytes before it u64
#include "conchoid/learn/regressor_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_kinds.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

constexpr std::uint32_t byte_order_mark = 0x01020304;
constexpr std::size_t magic_size = 8;
constexpr std::size_t header_size = magic_size + 4 + 4 + 8;

constexpr const char* train_again = "train it again with `conchoid forest train`";

MaterialRecord material_from(const json& j) {
  return {j.at("youngs_modulus"), j.at("poisson_ratio"), j.at("density"),
          j.at("strength"),       j.at("toughness"),     j.at("compressive_factor")};
}

json to_json(const Provenance& p) {
  json j = {{"models", p.models},
            {"material", json::parse(json_text(p.material))},
            {"resolution", p.resolution},
            {"runs", p.runs},
            {"samples", p.samples},
            {"samples_hash", p.samples_hash},
            {"spec", p.spec}};
  if (!p.hidden_features.empty()) j["hidden_features"] = p.hidden_features;
  return j;
}

Provenance provenance_from(const json& j, FeatureSet set) {
  Provenance p;
  p.models = j.at("models").get<std::vector<std::string>>();
  p.material = material_from(j.at("material"));
  p.resolution = j.at("resolution");
  p.runs = j.at("runs");
  p.samples = j.at("samples");
  p.samples_hash = j.at("samples_hash");
  p.spec = j.at("spec");
  if (j.contains("hidden_features"))
    p.hidden_features = named_features(set, j.at("hidden_features").get<std::vector<std::string>>());
  return p;
}

json to_json(const std::vector<FeatureRange>& ranges) {
  json list = json::array();
  for (const FeatureRange& r : ranges)
    list.push_back({{"minimum", r.minimum}, {"maximum", r.maximum}, {"quantiles", r.quantiles}});
  return list;
}

json to_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Vec3 vec_from(const json& j) {
  return Vec3(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>());
}

json to_json(const std::array<SpreadCalibration, 3>& calibration) {
  json modes = json::array();
  for (const SpreadCalibration& mode : calibration) {
    json knots = json::array();
    for (const SpreadCalibration::Knot& knot : mode.knots())
      knots.push_back({knot.stated, knot.found});
    modes.push_back(std::move(knots));
  }
  return modes;
}

std::array<SpreadCalibration, 3> calibration_from(const json& modes) {
  std::array<SpreadCalibration, 3> calibration;
  for (std::size_t mode = 0; mode < 3; ++mode) {
    std::vector<SpreadCalibration::Knot> knots;
    for (const json& knot : modes.at(mode))
      knots.push_back({knot.at(0), knot.at(1)});
    calibration[mode] = SpreadCalibration(std::move(knots));
  }
  return calibration;
}

TrainingRecord record_from(const json& d) {
  TrainingRecord record;
  record.features = feature_set_from_name(d.at("features").get<std::string>());
  if (d.at("feature_names").get<std::vector<std::string>>() != feature_names(record.features))
    throw InputError("feature set " + std::string(name(record.features)) + " has changed since the training");
  // Files that do not name their labels are from before those of `versatile` became what they are.
  if (d.contains("label_names") ? d.at("label_names") != json(label_names(record.features))
                                : record.features == FeatureSet::versatile)
    throw InputError("what feature set " + std::string(name(record.features)) +
                     " predicts has changed since the training");
  for (const json& r : d.at("ranges"))
    record.ranges.push_back(
        {r.at("minimum"), r.at("maximum"), r.at("quantiles").get<std::array<double, 7>>()});
  if (record.ranges.size() != feature_count(record.features))
    throw InputError("the number of feature ranges is wrong");
  record.label_mean = vec_from(d.at("label_mean"));
  record.label_scale = vec_from(d.at("label_scale"));
  record.provenance = provenance_from(d.at("provenance"), record.features);
  if (d.contains("calibration")) record.calibration = calibration_from(d.at("calibration"));
  return record;
}

/// The kind whose files begin as these bytes do.
const RegressorKind& kind_of(std::string_view bytes, const std::string& file) {
  const std::size_t known = std::min(bytes.size(), magic_size);
  for (const RegressorKind& kind : regressor_kinds())
    if (known > 0 && bytes.substr(0, known) == kind.magic.substr(0, known)) return kind;
  throw InputError(file + ": is not a trained regressor (" + regressor_names() +
                   "); name a file written by `conchoid forest train`");
}

/// Checks version, byte order, length and checksum; returns what lies between header and checksum.
std::string_view open_envelope(std::string_view bytes, const RegressorKind& kind, const std::string& file) {
  if (bytes.size() < header_size + 8)
    throw InputError(file + ": is truncated; copy it again or " + train_again);
  ByteReader in(bytes.substr(magic_size));
  const auto version = in.get<std::uint32_t>();
  const auto order = in.get<std::uint32_t>();
  const auto length = in.get<std::uint64_t>();
  if (order != byte_order_mark)
    throw InputError(file + ": its byte order is damaged; copy it again in binary mode or " + train_again);
  if (version != kind.version)
    throw InputError(file + ": has version " + std::to_string(version) + ", this program reads version " +
                     std::to_string(kind.version) + "; use the program that wrote it or " + train_again);
  if (length > in.left() || in.left() - length < 8)
    throw InputError(file + ": is truncated; copy it again or " + train_again);
  if (in.left() - length > 8)
    throw InputError(file + ": has extra bytes at its end; copy it again or " + train_again);
  const std::string_view content = in.get_raw(length);
  if (in.get<std::uint64_t>() != hash_bytes(bytes.substr(0, bytes.size() - 8)))
    throw InputError(file + ": is corrupt (its checksum is wrong); copy it again or " + train_again);
  return content;
}

}  // namespace

std::string regressor_bytes(std::string_view kind_name, const TrainingRecord& record,
                            const std::string& settings, std::string_view fit) {
  json description = json::parse(settings);
  description.update({{"format", "conchoid " + std::string(kind_name)},
                      {"features", name(record.features)},
                      {"feature_names", feature_names(record.features)},
                      {"label_names", label_names(record.features)},
                      {"ranges", to_json(record.ranges)},
                      {"label_mean", to_json(record.label_mean)},
                      {"label_scale", to_json(record.label_scale)},
                      {"provenance", to_json(record.provenance)}});
  if (record.calibrated()) description["calibration"] = to_json(record.calibration);
  ByteWriter content;
  content.put_text(description.dump(-1, ' ', false, json::error_handler_t::replace));
  content.put_raw(fit);
  const RegressorKind& kind = regressor_kind(kind_name);
  ByteWriter out;
  out.put_raw(kind.magic);
  out.put(kind.version);
  out.put(byte_order_mark);
  out.put(static_cast<std::uint64_t>(content.bytes().size()));
  out.put_raw(content.bytes());
  out.put(hash_bytes(out.bytes()));
  return out.bytes();
}

std::unique_ptr<Regressor> load_regressor(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  const RegressorKind& kind = kind_of(bytes, file.string());
  ByteReader in(open_envelope(bytes, kind, file.string()));
  try {
    const std::string description = in.get_text();
    std::unique_ptr<Regressor> regressor = kind.read(record_from(json::parse(description)), description, in);
    if (in.left() > 0) throw InputError("there is more in it than belongs there");
    return regressor;
  } catch (const std::exception& e) {
    throw InputError(file.string() + ": does not hold a valid " + std::string(kind.title) + " (" + e.what() +
                     "); " + train_again);
  }
}

}  // namespace conchoid
