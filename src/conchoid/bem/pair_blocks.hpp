#pragma once

#include "conchoid/elastic/constants.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// Notation: V single layer, K double layer, D hypersingular. A P1 shape function φ on a panel enters through
/// its surface curl c = n × ∇φ [1/m], constant per panel; its tangential derivatives are M_ij φ = ([c]×)_ij.
///                                                                                     docs/theory.md (B2)

/// Surface curls of the three corner functions of a panel.
std::array<Vec3, 3> surface_curls(const Panel& p);

/// The pair's Galerkin blocks, made from the seven numbers of the single layer once and used for all shape
/// functions on it.
class PairBlocks {
 public:
  PairBlocks(const SingleLayerPair& s, const ElasticConstants& m);

  /// ∫∫ U, the block of V between constant tractions.                                     docs/theory.md (B3)
  const Mat3& single_layer() const { return kelvin_; }

  /// <D φ_a e_q, φ_b e_p> for shape functions with curls b (test, on X) and a (trial, on Y).
  ///                                                                                   docs/theory.md (B4)
  Mat3 hypersingular(const Vec3& b, const Vec3& a) const;

  /// Σ_Y of a trial function as it meets one test panel, before that has a function: <D φ_a e_q, φ_b e_p> is linear in
  /// both curls, so that what Y leaves is twelve numbers, whatever it is tested with.
  class TrialSum {
   public:
    /// Another panel Y of the trial function, where its curl is a.
    void add(const PairBlocks& pair, const Vec3& a);
    /// The block with the test function of curl b.
    Mat3 tested(const Vec3& b) const;

   private:
    Mat3 curl_kernel_ = Mat3::Zero();  // rows × a
    Vec3 laplace_ = Vec3::Zero();
  };

  /// <K φ_a e_q, e_p>: constant test on X, trial on Y with curl a; dl is the Laplace double layer of φ_a,
  /// Σ φ_a(corner) DL.                                                                 docs/theory.md (B5)
  Mat3 double_layer(const Vec3& a, double dl) const;

 private:
  double laplace_;    // μ/(4π) ∫∫ 1/R
  double shear_;      // 1/(4π) ∫∫ 1/R
  Mat3 kelvin_;       // ∫∫ U
  Mat3 curl_kernel_;  // ∫∫ μ/(2πR) I − 4μ² U
  double mu_;
};

/// [c]× with [c]× v = c × v.
Mat3 cross_matrix(const Vec3& c);

}  // namespace conchoid
