#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/learn/sample.hpp"

namespace conchoid {

// clang-format off
/// What a regressor looks at and what it predicts. K at frame n−1 [Pa√m], r⁻ and r⁺ the correlation distances at
/// frames n−1 and n [m], Δu the opening at frame n [m], r̄ the resolution [m], κ the front's curvature [1/m].
///
/// | set                   | features                                                     | label        |
/// |-----------------------|--------------------------------------------------------------|--------------|
/// | paper-3               | K_I/√r̄, K_II/√r̄, K_III/√r̄ [Pa]                               | Δu/r̄         |
/// | paper-4               | the same and K_c [Pa√m]                                      | Δu/r̄         |
/// | paper-5               | the same, K_c and the travelled distance [m]                 | Δu/r̄         |
/// | dimensionless         | K_I/S, abs K_II/S, abs K_III/S, K_c/S, r⁻/r̄, r⁺/r̄, r⁺/r⁻,    | (K⁺ − K)/S,  |
/// |                       | travelled/r̄, ν                                               | signs below  |
/// | dimensionless-context | the same, κ r̄, r̄/(r̄ + surface distance), √r̄ traction/S       | the same     |
/// | versatile             | direction of K, turn, stress without crack, walls, front      | versatile_features.hpp |
///
/// S² = K_I² + K_II² + K_III²/(1−ν) + K_c² > 0, and K⁺ is the intensity that the opening Δu at distance r⁺ stands
/// for (displacement correlation). K⁺ = K says "K stays as it is": a dimensionless regressor learns the correction
/// to the steady prediction, so a load never seen before is still met by a correction of the right order.
///
/// Scale: a physically scaled copy (size × s, E × k, stress × k, K_c × k√s, r̄ × s) has the same dimensionless
/// features and labels. E enters nowhere else: elasticity is linear, so K and K_c already tell the load, and
/// K_c/(E√r̄) would only tie a regressor to one material.
///
/// Signs: reversing the crack normal negates (K_II, Δu_II) and nothing else; mirroring the body across the plane
/// of e1 and e2 negates (K_III, Δu_III). The dimensionless sets look at the absolute values and give labels and
/// tractions II and III relative to the signs of K_II and K_III, so both symmetries hold exactly.
// clang-format on
enum class FeatureSet { paper_3, paper_4, paper_5, dimensionless, dimensionless_context, versatile };

/// All sets in the order of the enumeration.
std::vector<FeatureSet> all_feature_sets();
std::string_view name(FeatureSet set);
/// Throws InputError that lists the known names.
FeatureSet feature_set_from_name(std::string_view name);
std::vector<std::string> feature_names(FeatureSet set);
std::size_t feature_count(FeatureSet set);

/// Recorded quantities that the set looks at and that a sample need not hold, by their names in
/// SampleSet::fields(): zero where nobody measured them.
std::vector<std::string> context_fields(FeatureSet set);
/// Throws InputError that names those of them that are zero in every sample.
void require_recorded(FeatureSet set, const SampleSet& samples);
/// The error of require_recorded. @param empty  names of the fields @param where  what does not hold them
[[noreturn]] void refuse_empty_fields(FeatureSet set, const std::vector<std::string>& empty,
                                      const std::string& where);

/// Writes the features of one sample to row (feature_count(set) numbers).
void features(const Sample& sample, FeatureSet set, std::span<double> row);
/// What the three labels are called; files tell them, so that none is read with other labels than it was trained on.
std::vector<std::string> label_names(FeatureSet set);
/// The three labels, modes I, II, III.
Vec3 label(const Sample& sample, FeatureSet set);
/// Number of images of a row under the signs of its quantities that a regressor is trained on and asked for; 1: the row
/// alone. Image 0 is the row itself.
int image_count(FeatureSet set);
/// Turns a row, or a label, into an image of it, and back.
void apply_image(FeatureSet set, int image, std::span<double> row);
Vec3 label_image(FeatureSet set, int image, const Vec3& label);
/// Whether it learns from all samples: from openings beyond kLargestOpening and nodes that are new on the front
/// (is_new_on_front()), too, which the published method leaves out.
bool learns_all_samples(FeatureSet set);
/// K that drives the front of frame n, in its own frame [Pa√m], where a label tells that; else none.
std::optional<Vec3> driving_from_label(const Sample& sample, FeatureSet set, const Vec3& label);
/// Standard deviation of its K_II and K_III at the size that it has [Pa√m], from that of the label; else zero.
Vec3 driving_spread(const Sample& sample, FeatureSet set, const Vec3& label, const Vec3& label_spread);
/// Inverse of label: the opening [m] in the front frame of frame n−1; uses everything of the sample but its
/// opening.
Vec3 opening_from_label(const Sample& sample, FeatureSet set, const Vec3& label);
/// Standard deviation of the opening [m] that belongs to one of the label; ≥ 0 per mode.
Vec3 opening_spread(const Sample& sample, FeatureSet set, const Vec3& label_spread);
/// "K stays as it is": the opening [m] that K of frame n−1 gives at distance r⁺. No training.
Vec3 steady_opening(const Sample& sample);

/// Rows of features that know which set they are of, and which of them are neighbours along a front.
struct FeatureMatrix {
  FeatureSet set = FeatureSet::paper_4;
  std::size_t columns = 0;
  std::vector<double> values;  ///< row after row
  std::vector<std::int32_t>
      stretch;  ///< per row: the same number as its neighbours have; empty: every row is alone

  std::size_t rows() const { return columns ? values.size() / columns : 0; }
  std::span<const double> row(std::size_t i) const { return {values.data() + i * columns, columns}; }
  /// Whether row i + 1 is a neighbour of row i.
  bool goes_on(std::size_t i) const { return i + 1 < stretch.size() && stretch[i] == stretch[i + 1]; }
  std::span<double> row_of(std::size_t i) { return {values.data() + i * columns, columns}; }
};

FeatureMatrix feature_matrix(const SampleSet& samples, FeatureSet set);

/// Features of the set that are named, in its order; a name that ends in * stands for all that begin so. Throws InputError
/// that lists the known names if nothing is named so, or if nothing would be left.
std::vector<std::string> named_features(FeatureSet set, const std::vector<std::string>& names);
/// Sets the features of these names to zero in every row.
void hide_features(FeatureMatrix& rows, const std::vector<std::string>& names);

}  // namespace conchoid
