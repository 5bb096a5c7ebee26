#include "conchoid/learn/sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

constexpr std::array<SampleField, SampleSet::field_count> field_table = {{
    {"K_I", "Pa*sqrt(m)"},
    {"K_II", "Pa*sqrt(m)"},
    {"K_III", "Pa*sqrt(m)"},
    {"toughness", "Pa*sqrt(m)"},
    {"resolution", "m"},
    {"distance_before", "m"},
    {"distance_after", "m"},
    {"travelled", "m"},
    {"youngs_modulus", "Pa"},
    {"poisson_ratio", "1"},
    {"front_curvature", "1/m"},
    {"surface_distance", "m"},
    {"traction_I", "Pa"},
    {"traction_II", "Pa"},
    {"traction_III", "Pa"},
    {"opening_I", "m"},
    {"opening_II", "m"},
    {"opening_III", "m"},
    {"lateral_22", "Pa"},
    {"lateral_33", "Pa"},
    {"lateral_23", "Pa"},
    {"wall_distance", "m"},
    {"driving_I", "Pa*sqrt(m)"},
    {"driving_II", "Pa*sqrt(m)"},
    {"driving_III", "Pa*sqrt(m)"},
    {"driving_nearby_I", "Pa*sqrt(m)"},
    {"driving_nearby_II", "Pa*sqrt(m)"},
    {"driving_nearby_III", "Pa*sqrt(m)"},
    {"driving_slope_I", "Pa/sqrt(m)"},
    {"driving_slope_II", "Pa/sqrt(m)"},
    {"driving_slope_III", "Pa/sqrt(m)"},
    {"driving_front_I", "Pa*sqrt(m)"},
    {"driving_front_II", "Pa*sqrt(m)"},
    {"driving_front_III", "Pa*sqrt(m)"},
    {"crack_radius", "m"},
    {"ligament_share", "1"},
    {"front_curvature_after", "1/m"},
    {"surface_distance_after", "m"},
    {"wall_distance_after", "m"},
    {"traction_after_I", "Pa"},
    {"traction_after_II", "Pa"},
    {"traction_after_III", "Pa"},
    {"lateral_after_22", "Pa"},
    {"lateral_after_33", "Pa"},
    {"lateral_after_23", "Pa"},
    {"turn_21", "1"},
    {"turn_31", "1"},
    {"turn_23", "1"},
    {"taken_over_I", "Pa"},
    {"taken_over_II", "Pa"},
    {"taken_over_III", "Pa"},
    {"taken_over_after_I", "Pa"},
    {"taken_over_after_II", "Pa"},
    {"taken_over_after_III", "Pa"},
    {"crack_force_I", "N"},
    {"crack_force_II", "N"},
    {"crack_force_III", "N"},
    {"crack_moment_I", "N*m"},
    {"crack_moment_II", "N*m"},
    {"crack_moment_III", "N*m"},
    {"arms", "Pa*sqrt(m)"},
    {"arms_after", "Pa*sqrt(m)"},
    {"up_distance_after", "m"},
    {"down_distance_after", "m"},
    {"ahead_up_distance_after", "m"},
    {"ahead_down_distance_after", "m"},
    {"behind_up_distance_after", "m"},
    {"behind_down_distance_after", "m"},
    {"left_distance_after", "m"},
    {"right_distance_after", "m"},
    {"driving_after_I", "Pa*sqrt(m)"},
    {"driving_after_II", "Pa*sqrt(m)"},
    {"driving_after_III", "Pa*sqrt(m)"},
}};

/// Calls visit(value) for every real-valued field, in the order of the table.
template <class AnySample, class Visit>
void visit_values(AnySample& s, const Visit& visit) {
  const auto each = [&](auto& v) {
    for (int k = 0; k < 3; ++k)
      visit(v[k]);
  };
  each(s.K);
  for (auto* value : {&s.toughness, &s.resolution, &s.distance_before, &s.distance_after, &s.travelled,
                      &s.youngs_modulus, &s.poisson_ratio, &s.front_curvature, &s.surface_distance})
    visit(*value);
  each(s.traction);
  each(s.opening);
  each(s.lateral);
  visit(s.wall_distance);
  each(s.driving);
  each(s.driving_nearby);
  each(s.driving_slope);
  each(s.driving_front);
  for (auto* value : {&s.crack_radius, &s.ligament_share, &s.front_curvature_after, &s.surface_distance_after,
                      &s.wall_distance_after})
    visit(*value);
  each(s.traction_after);
  each(s.lateral_after);
  each(s.turn);
  each(s.taken_over);
  each(s.taken_over_after);
  each(s.crack_force);
  each(s.crack_moment);
  visit(s.arms);
  visit(s.arms_after);
  for (auto& distance : s.beside)
    visit(distance);
  each(s.driving_after);
}

std::array<double, SampleSet::field_count> values_of(const Sample& s) {
  std::array<double, SampleSet::field_count> values;
  std::size_t f = 0;
  visit_values(s, [&](double value) { values[f++] = value; });
  return values;
}

Sample sample_from(const std::array<double, SampleSet::field_count>& values) {
  Sample s;
  std::size_t f = 0;
  visit_values(s, [&](double& value) { value = values[f++]; });
  return s;
}

/// What is wrong with a sample, empty if nothing.
std::string defect(const Sample& s) {
  const auto values = values_of(s);
  for (std::size_t f = 0; f < values.size(); ++f) {
    const bool endless = field_table[f].name.find("_distance") != std::string_view::npos &&
                         values[f] == std::numeric_limits<double>::infinity();
    if (!std::isfinite(values[f]) && !endless)
      return std::string(field_table[f].name) + " is not a finite number";
  }
  if (s.toughness <= 0) return "toughness must be positive";
  if (s.resolution <= 0) return "resolution must be positive";
  if (s.distance_before <= 0 || s.distance_after <= 0) return "the correlation distance must be positive";
  if (s.youngs_modulus <= 0) return "Young's modulus must be positive";
  if (s.poisson_ratio <= -1 || s.poisson_ratio >= 0.5) return "Poisson's ratio must lie between -1 and 0.5";
  if (std::min({s.travelled, s.surface_distance, s.wall_distance, s.surface_distance_after,
                s.wall_distance_after}) < 0)
    return "travelled and distances from the surface must not be negative";
  return {};
}

}  // namespace

const std::array<SampleField, SampleSet::field_count>& SampleSet::fields() {
  return field_table;
}

void SampleSet::reserve(std::size_t n) {
  for (auto* ids : {&run_, &frame_, &node_, &front_})
    ids->reserve(n);
  for (auto& column : values_)
    column.reserve(n);
}

void SampleSet::resize(std::size_t n) {
  for (auto* ids : {&run_, &frame_, &node_, &front_})
    ids->resize(n);
  for (auto& column : values_)
    column.resize(n);
}

void SampleSet::add(const Sample& sample) {
  run_.push_back(sample.run);
  frame_.push_back(sample.frame);
  node_.push_back(sample.node);
  front_.push_back(sample.front);
  const auto values = values_of(sample);
  for (std::size_t f = 0; f < field_count; ++f)
    values_[f].push_back(values[f]);
}

void SampleSet::append(const SampleSet& other) {
  const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join(run_, other.run_);
  join(frame_, other.frame_);
  join(node_, other.node_);
  join(front_, other.front_);
  for (std::size_t f = 0; f < field_count; ++f)
    join(values_[f], other.values_[f]);
}

Sample SampleSet::operator[](std::size_t i) const {
  std::array<double, field_count> values;
  for (std::size_t f = 0; f < field_count; ++f)
    values[f] = values_[f][i];
  Sample s = sample_from(values);
  s.run = run_[i];
  s.frame = frame_[i];
  s.node = node_[i];
  s.front = front_[i];
  return s;
}

SampleSet SampleSet::subset(const std::vector<std::size_t>& indices) const {
  SampleSet result;
  result.reserve(indices.size());
  for (const std::size_t i : indices)
    result.add((*this)[i]);
  return result;
}

std::uint64_t SampleSet::hash() const {
  std::uint64_t h = hash_bytes("conchoid samples", size());
  const auto add_column = [&h](const auto& column) {
    ByteWriter bytes;
    bytes.put_all(std::span<const typename std::decay_t<decltype(column)>::value_type>(column));
    h = hash_bytes(bytes.bytes(), h);
  };
  add_column(run_);
  add_column(frame_);
  add_column(node_);
  add_column(front_);
  for (const auto& column : values_)
    add_column(column);
  return h;
}

void SampleSet::validate() const {
  for (std::size_t i = 0; i < size(); ++i) {
    const std::string what = defect((*this)[i]);
    if (!what.empty())
      throw InputError("sample " + std::to_string(i) + " (run " + std::to_string(run_[i]) + ", frame " +
                       std::to_string(frame_[i]) + ", front node " + std::to_string(node_[i]) + "): " + what +
                       "; leave the sample out or generate the run again");
  }
}

}  // namespace conchoid
