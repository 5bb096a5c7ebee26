#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace conchoid {

class Random;

/// A small network with convolution along the front. Rows x_i of one stretch of a front (n of them, F features each,
/// standardised), M x_i the mean over the neighbours of row i (x_i itself where it has none), S x the mean over the stretch:
///   h⁰ = tanh(A₀ x + b₀)
///   h^l = h^(l−1) + tanh(A_l h^(l−1) + B_l M h^(l−1) + D_l S h^(l−1) + b_l),   l = 1 … L
///   y = C h^L + c
/// So an answer depends on the row, on L neighbours on either side, and on the front as a whole, whatever the number of its
/// rows: how a crack opens at one place is a matter of its whole front. Both neighbours count alike: the sense of a front is
/// arbitrary, and what has a sense (slopes) changes its sign with it among the features.
class FrontNetwork {
 public:
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;

  /// @param features  F  @param width  of h  @param convolutions  L  @param answers  of y
  FrontNetwork(int features, int width, int convolutions, int answers);

  /// Weights uniform within √(6/(inputs + outputs)) (Glorot & Bengio 2010), no offsets, the last layer all zero.
  void draw(Random& random);

  /// All parameters in the order A₀ b₀ (A_l B_l D_l b_l)… C c, matrices column by column.
  std::vector<float>& parameters() { return parameters_; }
  const std::vector<float>& parameters() const { return parameters_; }

  /// Answers for rows side by side (F × n): answers × n. Column after column by itself, so that the answer of a row has
  /// the same bits whatever else is asked, as long as its stretch is there.
  /// @param goes_on  per column, whether the next one is its neighbour
  Matrix answer(const Matrix& rows, const std::vector<char>& goes_on) const;

  /// Mean over rows of the sum over answers of e² where e = |y − wanted| ≤ δ, 2 δ e − δ² beyond (Huber 1964), δ = kLinear:
  /// K at mouths and last ligaments scatters far, and its squares would outweigh everything else.
  double loss(const Matrix& rows, const std::vector<char>& goes_on, const Matrix& wanted) const;
  /// Its gradient by the parameters.
  void loss_gradient(const Matrix& rows, const std::vector<char>& goes_on, const Matrix& wanted,
                     std::vector<float>& gradient) const;

  static constexpr float kLinear = 0.5F;  // × deviation of the label

 private:
  struct Layer {
    Eigen::Index own, neighbours, stretch, offset;  ///< where A, B, D and b begin; no B, no D: −1
    Eigen::Index rows, columns;                     ///< of A
  };
  /// What the layers pass on: per layer but the last h, its tanh, and what neighbours and the stretch gave it; y at the end.
  struct Passed {
    std::vector<Matrix> h, squashed, neighbours, stretch;
    Matrix answer;
  };
  Passed pass(const Matrix& rows, const std::vector<char>& goes_on) const;
  Eigen::Map<const Matrix> weights(const Layer& layer, Eigen::Index begin) const;
  Eigen::Map<const Eigen::VectorXf> offset(const Layer& layer) const;

  std::vector<Layer> layers_;  // first, convolutions, last
  std::vector<float> parameters_;
};

}  // namespace conchoid
