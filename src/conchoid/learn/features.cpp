#include "conchoid/learn/features.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "conchoid/core/error.hpp"
#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/learn/versatile_features.hpp"

namespace conchoid {
namespace {

constexpr std::array<FeatureSet, 6> sets = {FeatureSet::paper_3,
                                            FeatureSet::paper_4,
                                            FeatureSet::paper_5,
                                            FeatureSet::dimensionless,
                                            FeatureSet::dimensionless_context,
                                            FeatureSet::versatile};

bool is_paper(FeatureSet set) {
  return set == FeatureSet::paper_3 || set == FeatureSet::paper_4 || set == FeatureSet::paper_5;
}

ElasticConstants material(const Sample& s) {
  return {s.youngs_modulus, s.poisson_ratio};
}

/// S, the size of all intensities together [Pa√m].
double intensity_scale(const Sample& s) {
  return std::sqrt(s.K[0] * s.K[0] + s.K[1] * s.K[1] + s.K[2] * s.K[2] / (1 - s.poisson_ratio) +
                   s.toughness * s.toughness);
}

/// +1 or −1 per mode: the sense in which modes II and III act.
Vec3 senses(const Sample& s) {
  return {1.0, s.K[1] < 0 ? -1.0 : 1.0, s.K[2] < 0 ? -1.0 : 1.0};
}

}  // namespace

std::vector<FeatureSet> all_feature_sets() {
  return {sets.begin(), sets.end()};
}

std::string_view name(FeatureSet set) {
  switch (set) {
    case FeatureSet::paper_3:
      return "paper-3";
    case FeatureSet::paper_4:
      return "paper-4";
    case FeatureSet::paper_5:
      return "paper-5";
    case FeatureSet::dimensionless:
      return "dimensionless";
    case FeatureSet::dimensionless_context:
      return "dimensionless-context";
    case FeatureSet::versatile:
      return "versatile";
  }
  return "";
}

FeatureSet feature_set_from_name(std::string_view wanted) {
  std::string known;
  for (const FeatureSet set : sets) {
    if (name(set) == wanted) return set;
    known += (known.empty() ? "" : ", ") + std::string(name(set));
  }
  throw InputError("unknown feature set \"" + std::string(wanted) + "\"; choose one of " + known);
}

std::vector<std::string> feature_names(FeatureSet set) {
  if (set == FeatureSet::versatile) return versatile_feature_names();
  std::vector<std::string> names;
  if (is_paper(set)) {
    names = {"K_I/sqrt(r_bar)", "K_II/sqrt(r_bar)", "K_III/sqrt(r_bar)"};
    if (set != FeatureSet::paper_3) names.push_back("K_c");
    if (set == FeatureSet::paper_5) names.push_back("travelled");
    return names;
  }
  names = {"K_I/S",         "|K_II|/S",         "|K_III|/S",       "K_c/S",        "r_before/r_bar",
           "r_after/r_bar", "r_after/r_before", "travelled/r_bar", "poisson_ratio"};
  if (set == FeatureSet::dimensionless_context)
    for (const char* extra :
         {"curvature*r_bar", "surface_proximity", "traction_I/S", "traction_II/S", "traction_III/S"})
      names.emplace_back(extra);
  return names;
}

std::vector<std::string> named_features(FeatureSet set, const std::vector<std::string>& names) {
  const std::vector<std::string> known = feature_names(set);
  const auto stands_for = [](const std::string& wanted, const std::string& feature) {
    return wanted.ends_with('*') ? feature.starts_with(wanted.substr(0, wanted.size() - 1))
                                 : feature == wanted;
  };
  for (const std::string& wanted : names)
    if (std::none_of(known.begin(), known.end(), [&](const auto& f) { return stands_for(wanted, f); }))
      throw InputError(fmt::format("feature set {} has no feature \"{}\"; it has {}", name(set), wanted,
                                   fmt::join(known, ", ")));
  std::vector<std::string> chosen;
  std::copy_if(known.begin(), known.end(), std::back_inserter(chosen), [&](const auto& feature) {
    return std::any_of(names.begin(), names.end(), [&](const auto& n) { return stands_for(n, feature); });
  });
  if (chosen.size() == known.size())
    throw InputError(fmt::format("all features of {} would be hidden; leave one at least", name(set)));
  return chosen;
}

void hide_features(FeatureMatrix& rows, const std::vector<std::string>& names) {
  const std::vector<std::string> known = feature_names(rows.set);
  for (const std::string& name : names) {
    const auto c = static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
    if (c == known.size()) throw std::logic_error("no such feature: " + name);
    for (std::size_t i = 0; i < rows.rows(); ++i)
      rows.row_of(i)[c] = 0;
  }
}

std::size_t feature_count(FeatureSet set) {
  switch (set) {
    case FeatureSet::paper_3:
      return 3;
    case FeatureSet::paper_4:
      return 4;
    case FeatureSet::paper_5:
      return 5;
    case FeatureSet::dimensionless:
      return 9;
    case FeatureSet::dimensionless_context:
      return 14;
    case FeatureSet::versatile:
      return versatile_feature_names().size();
  }
  return 0;
}

std::vector<std::string> context_fields(FeatureSet set) {
  if (set == FeatureSet::versatile) return versatile_fields();
  if (set != FeatureSet::dimensionless_context) return {};
  return {"front_curvature", "surface_distance", "traction_I", "traction_II", "traction_III"};
}

void refuse_empty_fields(FeatureSet set, const std::vector<std::string>& empty, const std::string& where) {
  std::string names;
  for (const std::string& name : empty)
    names += (names.empty() ? "" : ", ") + name;
  throw InputError("feature set " + std::string(name(set)) + " looks at " + names + ", which " + where +
                   " nowhere hold; use another feature set, such as dimensionless");
}

void require_recorded(FeatureSet set, const SampleSet& samples) {
  std::vector<std::string> empty;
  for (const std::string& wanted : context_fields(set)) {
    const auto& fields = SampleSet::fields();
    const auto at = std::find_if(fields.begin(), fields.end(),
                                 [&](const SampleField& field) { return field.name == wanted; });
    const std::vector<double>& values = samples.field(static_cast<std::size_t>(at - fields.begin()));
    if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) empty.push_back(wanted);
  }
  if (!empty.empty()) refuse_empty_fields(set, empty, "these samples");
}

void features(const Sample& s, FeatureSet set, std::span<double> row) {
  if (row.size() != feature_count(set)) throw std::logic_error("features: the row has the wrong length");
  if (set == FeatureSet::versatile) return versatile_features(s, row);
  std::size_t n = 0;
  if (is_paper(set)) {
    for (int mode = 0; mode < 3; ++mode)
      row[n++] = s.K[mode] / std::sqrt(s.resolution);
    if (set != FeatureSet::paper_3) row[n++] = s.toughness;
    if (set == FeatureSet::paper_5) row[n++] = s.travelled;
    return;
  }
  const double S = intensity_scale(s);
  row[n++] = s.K[0] / S;
  row[n++] = std::abs(s.K[1]) / S;
  row[n++] = std::abs(s.K[2]) / S;
  row[n++] = s.toughness / S;
  row[n++] = s.distance_before / s.resolution;
  row[n++] = s.distance_after / s.resolution;
  row[n++] = s.distance_after / s.distance_before;
  row[n++] = s.travelled / s.resolution;
  row[n++] = s.poisson_ratio;
  if (set == FeatureSet::dimensionless) return;
  row[n++] = s.front_curvature * s.resolution;
  row[n++] = s.resolution / (s.resolution + s.surface_distance);
  const Vec3 sense = senses(s);
  for (int mode = 0; mode < 3; ++mode)
    row[n++] = sense[mode] * s.traction[mode] * std::sqrt(s.resolution) / S;
}

int image_count(FeatureSet set) {
  return set == FeatureSet::versatile ? kVersatileImages : 1;
}

void apply_image(FeatureSet set, int image, std::span<double> row) {
  if (set == FeatureSet::versatile) versatile_image(image, row);
}

Vec3 label_image(FeatureSet set, int image, const Vec3& label) {
  return set == FeatureSet::versatile ? versatile_label_image(image, label) : label;
}

bool learns_all_samples(FeatureSet set) {
  return set == FeatureSet::versatile;
}

std::optional<Vec3> driving_from_label(const Sample& s, FeatureSet set, const Vec3& label) {
  if (set != FeatureSet::versatile) return std::nullopt;
  return versatile_driving(s, label);
}

Vec3 driving_spread(const Sample& s, FeatureSet set, const Vec3& label, const Vec3& label_spread) {
  return set == FeatureSet::versatile ? versatile_driving_spread(s, label, label_spread) : Vec3::Zero();
}

std::vector<std::string> label_names(FeatureSet set) {
  if (set == FeatureSet::versatile) return versatile_label_names();
  if (is_paper(set)) return {"du_I/r_bar", "du_II/r_bar", "du_III/r_bar"};
  return {"dK_I/S", "|dK_II|/S", "|dK_III|/S"};
}

Vec3 label(const Sample& s, FeatureSet set) {
  if (set == FeatureSet::versatile) return versatile_label(s);
  if (is_paper(set)) return s.opening / s.resolution;
  const Vec3 K_after = stress_intensity(s.opening, s.distance_after, material(s));
  return senses(s).cwiseProduct(K_after - s.K) / intensity_scale(s);
}

Vec3 opening_from_label(const Sample& s, FeatureSet set, const Vec3& label) {
  if (set == FeatureSet::versatile) return versatile_opening(s, versatile_driving(s, label));
  if (is_paper(set)) return label * s.resolution;
  const Vec3 K_after = s.K + intensity_scale(s) * senses(s).cwiseProduct(label);
  return opening_from_intensity(K_after, s.distance_after, material(s));
}

Vec3 opening_spread(const Sample& s, FeatureSet set, const Vec3& label_spread) {
  if (set == FeatureSet::versatile)
    return opening_from_intensity(s.driving.norm() * label_spread, s.distance_after, material(s)).cwiseAbs();
  if (is_paper(set)) return label_spread * s.resolution;
  return opening_from_intensity(intensity_scale(s) * label_spread, s.distance_after, material(s)).cwiseAbs();
}

Vec3 steady_opening(const Sample& s) {
  return opening_from_intensity(s.K, s.distance_after, material(s));
}

FeatureMatrix feature_matrix(const SampleSet& samples, FeatureSet set) {
  FeatureMatrix matrix{set, feature_count(set), {}, {}};
  matrix.values.resize(samples.size() * matrix.columns);
  std::int32_t stretch = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    features(samples[i], set, {matrix.values.data() + i * matrix.columns, matrix.columns});
    if (i > 0 && !samples.neighbours(i - 1, i)) ++stretch;
    matrix.stretch.push_back(stretch);
  }
  return matrix;
}

}  // namespace conchoid
