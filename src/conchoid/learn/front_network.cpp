#include "conchoid/learn/front_network.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "conchoid/core/random.hpp"
#include "conchoid/core/wide_clones.hpp"

namespace conchoid {
namespace {

using Matrix = FrontNetwork::Matrix;
using Eigen::Index;

// Mean over the neighbours of every column; of the column itself where it has none.
Matrix neighbour_mean(const Matrix& h, const std::vector<char>& goes_on) {
  Matrix mean(h.rows(), h.cols());
  for (Index i = 0; i < h.cols(); ++i) {
    const bool before = i > 0 && goes_on[static_cast<std::size_t>(i - 1)];
    const bool after = goes_on[static_cast<std::size_t>(i)];
    if (before && after)
      mean.col(i) = 0.5F * (h.col(i - 1) + h.col(i + 1));
    else
      mean.col(i) = h.col(before ? i - 1 : after ? i + 1 : i);
  }
  return mean;
}

// The transpose of that map.
Matrix neighbour_mean_back(const Matrix& g, const std::vector<char>& goes_on) {
  Matrix out = Matrix::Zero(g.rows(), g.cols());
  for (Index i = 0; i < g.cols(); ++i) {
    const bool before = i > 0 && goes_on[static_cast<std::size_t>(i - 1)];
    const bool after = goes_on[static_cast<std::size_t>(i)];
    if (before && after) {
      out.col(i - 1) += 0.5F * g.col(i);
      out.col(i + 1) += 0.5F * g.col(i);
    } else {
      out.col(before ? i - 1 : after ? i + 1 : i) += g.col(i);
    }
  }
  return out;
}

// Mean over every stretch, a column each. Columns are added one after the other, so that the bits of a stretch do not depend on
// what is beside it.
Matrix stretch_means(const Matrix& h, const std::vector<char>& goes_on) {
  Matrix mean(h.rows(), std::count(goes_on.begin(), goes_on.end(), 0));
  for (Index begin = 0, i = 0, stretch = 0; i < h.cols(); ++i) {
    if (goes_on[static_cast<std::size_t>(i)]) continue;
    Eigen::VectorXf sum = h.col(begin);
    for (Index k = begin + 1; k <= i; ++k)
      sum += h.col(k);
    mean.col(stretch++) = sum / static_cast<float>(i + 1 - begin);
    begin = i + 1;
  }
  return mean;
}

// What stretches have, for each of their columns.
Matrix spread_out(const Matrix& of_stretch, const std::vector<char>& goes_on) {
  Matrix out(of_stretch.rows(), static_cast<Index>(goes_on.size()));
  for (Index i = 0, stretch = 0; i < out.cols(); ++i) {
    out.col(i) = of_stretch.col(stretch);
    if (!goes_on[static_cast<std::size_t>(i)]) ++stretch;
  }
  return out;
}

// Mean over the stretch of every column; a map that is its own transpose.
Matrix stretch_mean(const Matrix& h, const std::vector<char>& goes_on) {
  return spread_out(stretch_means(h, goes_on), goes_on);
}

typedef float Floats __attribute__((vector_size(32), may_alias, aligned(alignof(float))));
constexpr Index kFloats = 8;

// Rows r … r + kFloats·Blocks of a x, of columns i … i + Columns: numbers that stay in registers while k runs.
template <int Blocks, int Columns>
CONCHOID_INTO_CLONES void product_block(const float* a, Index rows, Index terms, const float* x, Index r,
                                        Index i, float* out) {
  Floats sum[Columns][Blocks] = {};
  for (Index k = 0; k < terms; ++k)
    for (int b = 0; b < Blocks; ++b) {
      const Floats of_k = *reinterpret_cast<const Floats*>(a + k * rows + r + b * kFloats);
      for (int c = 0; c < Columns; ++c)
        sum[c][b] += x[(i + c) * terms + k] * of_k;
    }
  for (int c = 0; c < Columns; ++c)
    for (int b = 0; b < Blocks; ++b)
      *reinterpret_cast<Floats*>(out + (i + c) * rows + r + b * kFloats) = sum[c][b];
}

template <int Columns>
CONCHOID_INTO_CLONES void product_columns(const float* a, Index rows, Index terms, const float* x, Index i,
                                          float* out) {
  Index r = 0;
  for (; r + 2 * kFloats <= rows; r += 2 * kFloats)
    product_block<2, Columns>(a, rows, terms, x, r, i, out);
  for (; r + kFloats <= rows; r += kFloats)
    product_block<1, Columns>(a, rows, terms, x, r, i, out);
  for (; r < rows; ++r)
    for (int c = 0; c < Columns; ++c) {
      float sum = 0;
      for (Index k = 0; k < terms; ++k)
        sum += x[(i + c) * terms + k] * a[k * rows + r];
      out[(i + c) * rows + r] = sum;
    }
}

CONCHOID_WIDE_CLONES void put_product(const float* a, Index rows, Index terms, const float* x, Index columns,
                                      float* out) {
  constexpr int together = 4;
  Index i = 0;
  for (; i + together <= columns; i += together)
    product_columns<together>(a, rows, terms, x, i, out);
  for (; i < columns; ++i)
    product_columns<1>(a, rows, terms, x, i, out);
}

// A x, the terms of each number in their order: the same bits for a column whatever is beside it.
Matrix product(const Eigen::Map<const Matrix>& a, const Matrix& x) {
  Matrix out(a.rows(), x.cols());
  put_product(a.data(), a.rows(), a.cols(), x.data(), x.cols(), out.data());
  return out;
}

// out += op(a) op(b), for training, where bits need not be those of one row alone.
void add_product(CBLAS_TRANSPOSE op_a, const Eigen::Ref<const Matrix>& a, CBLAS_TRANSPOSE op_b,
                 const Eigen::Ref<const Matrix>& b, Eigen::Ref<Matrix> out) {
  cblas_sgemm(CblasColMajor, op_a, op_b, static_cast<int>(out.rows()), static_cast<int>(out.cols()),
              static_cast<int>(op_a == CblasNoTrans ? a.cols() : a.rows()), 1, a.data(),
              static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()), 1, out.data(),
              static_cast<int>(out.outerStride()));
}

}  // namespace

FrontNetwork::FrontNetwork(int features, int width, int convolutions, int answers) {
  Index at = 0;
  const auto add = [&](Index rows, Index columns, bool convolution) {
    const auto matrix = [&] { return std::exchange(at, at + rows * columns); };
    Layer layer{matrix(), -1, -1, 0, rows, columns};
    if (convolution) {
      layer.neighbours = matrix();
      layer.stretch = matrix();
    }
    layer.offset = std::exchange(at, at + rows);
    layers_.push_back(layer);
  };
  add(width, features, false);
  for (int l = 0; l < convolutions; ++l)
    add(width, width, true);
  add(answers, width, false);
  parameters_.assign(static_cast<std::size_t>(at), 0);
}

void FrontNetwork::draw(Random& random) {
  std::fill(parameters_.begin(), parameters_.end(), 0.0F);
  for (std::size_t l = 0; l + 1 < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Index inputs = (layer.offset - layer.own) / layer.rows;
    const double bound = std::sqrt(6.0 / static_cast<double>(inputs + layer.rows));
    for (Index i = layer.own; i < layer.offset; ++i)
      parameters_[static_cast<std::size_t>(i)] = static_cast<float>(random.uniform(-bound, bound));
  }
}

Eigen::Map<const Matrix> FrontNetwork::weights(const Layer& layer, Index begin) const {
  return {parameters_.data() + begin, layer.rows, layer.columns};
}

Eigen::Map<const Eigen::VectorXf> FrontNetwork::offset(const Layer& layer) const {
  return {parameters_.data() + layer.offset, layer.rows};
}

Matrix FrontNetwork::answer(const Matrix& rows, const std::vector<char>& goes_on) const {
  // Eigen's: the same for one number as for several side by side, and several times as fast as std::tanh.
  const auto squashed = [](const auto& x) { return Matrix(x.array().tanh()); };
  const Layer &first = layers_.front(), &last = layers_.back();
  Matrix h = squashed(product(weights(first, first.own), rows).colwise() + offset(first));
  for (std::size_t l = 1; l + 1 < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Matrix sum = product(weights(layer, layer.own), h) +
                       product(weights(layer, layer.neighbours), neighbour_mean(h, goes_on)) +
                       spread_out(product(weights(layer, layer.stretch), stretch_means(h, goes_on)), goes_on);
    h += squashed(sum.colwise() + offset(layer));
  }
  return product(weights(last, last.own), h).colwise() + offset(last);
}

FrontNetwork::Passed FrontNetwork::pass(const Matrix& rows, const std::vector<char>& goes_on) const {
  Passed p;
  const Layer &first = layers_.front(), &last = layers_.back();
  Matrix sum = offset(first).replicate(1, rows.cols());
  add_product(CblasNoTrans, weights(first, first.own), CblasNoTrans, rows, sum);
  p.squashed.push_back(sum.array().tanh());
  p.h.push_back(p.squashed.back());
  p.neighbours.emplace_back();
  p.stretch.emplace_back();
  for (std::size_t l = 1; l + 1 < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Matrix& h = p.h.back();
    p.neighbours.push_back(neighbour_mean(h, goes_on));
    p.stretch.push_back(stretch_mean(h, goes_on));
    sum = offset(layer).replicate(1, rows.cols());
    add_product(CblasNoTrans, weights(layer, layer.own), CblasNoTrans, h, sum);
    add_product(CblasNoTrans, weights(layer, layer.neighbours), CblasNoTrans, p.neighbours.back(), sum);
    add_product(CblasNoTrans, weights(layer, layer.stretch), CblasNoTrans, p.stretch.back(), sum);
    p.squashed.push_back(sum.array().tanh());
    p.h.emplace_back(h + p.squashed.back());
  }
  p.answer = offset(last).replicate(1, rows.cols());
  add_product(CblasNoTrans, weights(last, last.own), CblasNoTrans, p.h.back(), p.answer);
  return p;
}

double FrontNetwork::loss(const Matrix& rows, const std::vector<char>& goes_on, const Matrix& wanted) const {
  const Matrix error = (pass(rows, goes_on).answer - wanted).cwiseAbs();
  const Matrix square = error.cwiseMin(kLinear);
  return static_cast<double>((square.array() * (2 * error - square).array()).sum()) /
         static_cast<double>(rows.cols());
}

void FrontNetwork::loss_gradient(const Matrix& rows, const std::vector<char>& goes_on, const Matrix& wanted,
                                 std::vector<float>& gradient) const {
  gradient.assign(parameters_.size(), 0);
  const auto [h, squashed, from_neighbours, from_stretch, answer] = pass(rows, goes_on);
  const Layer& last = layers_.back();
  const auto n = static_cast<float>(rows.cols());
  const auto put = [&](const Layer& layer, Index begin, const Matrix& g, const Matrix& in) {
    add_product(CblasNoTrans, g, CblasTrans, in,
                Eigen::Map<Matrix>(gradient.data() + begin, layer.rows, layer.columns));
  };
  const auto put_offset = [&](const Layer& layer, const Matrix& g) {
    Eigen::Map<Eigen::VectorXf>(gradient.data() + layer.offset, layer.rows) = g.rowwise().sum();
  };
  const Matrix g_last = (2 / n) * (answer - wanted).cwiseMin(kLinear).cwiseMax(-kLinear);
  put(last, last.own, g_last, h.back());
  put_offset(last, g_last);
  // By what goes into a layer.
  const auto back = [&](const Layer& layer, Index begin, const Matrix& g) {
    Matrix out = Matrix::Zero(layer.columns, g.cols());
    add_product(CblasTrans, weights(layer, begin), CblasNoTrans, g, out);
    return out;
  };
  Matrix g = back(last, last.own, g_last);  // by h of the layer at hand
  for (std::size_t l = layers_.size() - 2; l > 0; --l) {
    const Matrix inner = g.array() * (1 - squashed[l].array().square());
    const Layer& layer = layers_[l];
    put(layer, layer.own, inner, h[l - 1]);
    put(layer, layer.neighbours, inner, from_neighbours[l]);
    put(layer, layer.stretch, inner, from_stretch[l]);
    put_offset(layer, inner);
    g += back(layer, layer.own, inner) + neighbour_mean_back(back(layer, layer.neighbours, inner), goes_on) +
         stretch_mean(back(layer, layer.stretch, inner), goes_on);
  }
  const Matrix inner = g.array() * (1 - squashed[0].array().square());
  put(layers_[0], layers_[0].own, inner, rows);
  put_offset(layers_[0], inner);
}

}  // namespace conchoid
