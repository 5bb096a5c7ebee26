#pragma once

#include <span>
#include <string>
#include <vector>

#include "conchoid/learn/sample.hpp"

namespace conchoid {

// The feature set `versatile` (features.hpp): meant to hold for any body, load, size and material.
//
// S² = K_I² + K_II² + K_III²/(1−ν) of the K that drives the front (all K below are those), w = (K_I, K_II, K_III/√(1−ν))/S
// its direction. σ is the stress of the body without the crack, in the front's own frame; a prime is the frame after.
//
// Features: w at the point, of the mean over its neighbours, over the front; its slope along the front × r̄; the turn the
// front has made and what a kink by that angle leaves of K (Nuismer 1975); r⁻/r̄, r⁺/r̄; r̄/(r̄ + distance) to the surface
// straight ahead and nearest, before and after; curvature of the front × r̄, before and after; r̄/crack radius; share of the
// ligament; traction before over |σ|, all of σ′ over |σ′|; ln |σ′|/|σ|; S/(S + |σ|√(πa)); directions of greatest tension
// in the planes e1-e2 and e1-e3; ν. Of the net section (sim/net_section.hpp): traction that the ligament carries after, what it
// has taken over from the crack, growth of the first, its share with |σ′|, directions of greatest tension with it; force of the
// crack, lever arms of its moment over the crack's radius, growth of the K that this moment gives to the sides as beams, S beside
// it. Of the walls after, across the crack (±e1), across it ahead and behind, and along the front (±e3): closeness r̄/(r̄ + distance)
// in the mean of both sides, and how lopsided they are, d/d⁻ − d/d⁺ with d the nearer one. These tell which side of the crack
// is the weaker beam: cracks turn to it. Nothing tells the size of the load or K_c, so both may be anything.
//
// Label: ln(S′/S), −θ′/2, w_III′, with θ′ the angle by which K′ turns the front (kink_angle(): of w_II′ alone, as S² holds K_III;
// −θ/2 ≈ w_II where that is small, 0.62 where it is 1, so that K of a closed crack, which scatters, does not count for more than it
// turns). Nothing learned is zero: the front goes straight on, opened by the K that it had. (Learning what "K as it was in the front's own frame"
// misses is no better, and worse on most classes of bodies left out of training: K_II does not last.)
//
// Signs: reversing the crack normal, and mirroring the body across the plane of e1 and e2, each negate some of the features
// and of the labels (and only that); a regressor is trained on all four images and asked for all four, so that its answer
// has both symmetries exactly. On a straight crack in pure mode I it predicts K_II = K_III = 0.

inline constexpr int kVersatileImages = 4;

std::vector<std::string> versatile_feature_names();
void versatile_features(const Sample& sample, std::span<double> row);
/// Turns a row into that of image 0 … 3: bit 0 reverses the normal, bit 1 mirrors. Its own inverse.
void versatile_image(int image, std::span<double> row);
std::vector<std::string> versatile_label_names();
Vec3 versatile_label(const Sample& sample);
Vec3 versatile_label_image(int image, const Vec3& label);
/// K that drives the front of the frame after, in its own frame [Pa√m]: inverse of the label.
Vec3 versatile_driving(const Sample& sample, const Vec3& label);
/// Standard deviation of its K_II and K_III at the size that it has [Pa√m], from that of the label.
Vec3 versatile_driving_spread(const Sample& sample, const Vec3& label, const Vec3& label_spread);
/// Opening at distance r⁺ that belongs to such a K, in the front frame of the frame before [m].
Vec3 versatile_opening(const Sample& sample, const Vec3& driving);
/// Names of the recorded fields that must not be zero everywhere.
std::vector<std::string> versatile_fields();

}  // namespace conchoid
