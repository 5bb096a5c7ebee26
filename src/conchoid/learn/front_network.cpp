#include "conchoid/learn/front_network.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/random.hpp"

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

// A x column by column, terms in their order: the same bits for a column whatever is beside it.
Matrix product(const Eigen::Map<const Matrix>& a, const Matrix& x) {
  Matrix out = Matrix::Zero(a.rows(), x.cols());
  for (Index i = 0; i < x.cols(); ++i)
    for (Index k = 0; k < a.cols(); ++k)
      out.col(i) += x(k, i) * a.col(k);
  return out;
}

}  // namespace

FrontNetwork::FrontNetwork(int features, int width, int answers) {
  Index at = 0;
  const auto add = [&](Index rows, Index columns, bool convolution) {
    Layer layer{at, -1, 0, rows, columns};
    at += rows * columns;
    if (convolution) {
      layer.neighbours = at;
      at += rows * columns;
    }
    layer.offset = at;
    at += rows;
    layers_.push_back(layer);
  };
  add(width, features, false);
  for (int l = 0; l < kConvolutions; ++l)
    add(width, width, true);
  add(answers, width, false);
  parameters_.assign(static_cast<std::size_t>(at), 0);
}

void FrontNetwork::draw(Random& random) {
  std::fill(parameters_.begin(), parameters_.end(), 0.0F);
  for (std::size_t l = 0; l + 1 < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Index inputs = (layer.neighbours >= 0 ? 2 : 1) * layer.columns;
    const double bound = std::sqrt(6.0 / static_cast<double>(inputs + layer.rows));
    for (Index i = layer.own; i < layer.offset; ++i)
      parameters_[static_cast<std::size_t>(i)] = static_cast<float>(random.uniform(-bound, bound));
  }
}

Eigen::Map<const Matrix> FrontNetwork::own(const Layer& layer) const {
  return {parameters_.data() + layer.own, layer.rows, layer.columns};
}

Eigen::Map<const Matrix> FrontNetwork::neighbours(const Layer& layer) const {
  return {parameters_.data() + layer.neighbours, layer.rows, layer.columns};
}

Eigen::Map<const Eigen::VectorXf> FrontNetwork::offset(const Layer& layer) const {
  return {parameters_.data() + layer.offset, layer.rows};
}

Matrix FrontNetwork::answer(const Matrix& rows, const std::vector<char>& goes_on) const {
  const auto squashed = [](Matrix x) {
    for (Index i = 0; i < x.size(); ++i)
      x.data()[i] = std::tanh(x.data()[i]);
    return x;
  };
  Matrix h = squashed(product(own(layers_.front()), rows).colwise() + offset(layers_.front()));
  for (std::size_t l = 1; l + 1 < layers_.size(); ++l)
    h += squashed((product(own(layers_[l]), h) + product(neighbours(layers_[l]), neighbour_mean(h, goes_on)))
                      .colwise() +
                  offset(layers_[l]));
  return product(own(layers_.back()), h).colwise() + offset(layers_.back());
}

FrontNetwork::Passed FrontNetwork::pass(const Matrix& rows, const std::vector<char>& goes_on) const {
  Passed p;
  p.squashed.push_back(((own(layers_[0]) * rows).colwise() + offset(layers_[0])).array().tanh());
  p.h.push_back(p.squashed.back());
  p.mean.emplace_back();
  for (std::size_t l = 1; l + 1 < layers_.size(); ++l) {
    const Matrix& h = p.h.back();
    p.mean.push_back(neighbour_mean(h, goes_on));
    p.squashed.push_back(
        ((own(layers_[l]) * h + neighbours(layers_[l]) * p.mean.back()).colwise() + offset(layers_[l]))
            .array()
            .tanh());
    p.h.emplace_back(h + p.squashed.back());
  }
  p.answer = (own(layers_.back()) * p.h.back()).colwise() + offset(layers_.back());
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
  const auto [h, squashed, mean, answer] = pass(rows, goes_on);
  const Layer& last = layers_.back();
  const auto n = static_cast<float>(rows.cols());
  const auto put = [&](const Layer& layer, const Matrix& g, const Matrix& in, const Matrix* in_neighbours) {
    Eigen::Map<Matrix>(gradient.data() + layer.own, layer.rows, layer.columns).noalias() = g * in.transpose();
    if (in_neighbours)
      Eigen::Map<Matrix>(gradient.data() + layer.neighbours, layer.rows, layer.columns).noalias() =
          g * in_neighbours->transpose();
    Eigen::Map<Eigen::VectorXf>(gradient.data() + layer.offset, layer.rows) = g.rowwise().sum();
  };
  const Matrix g_last = (2 / n) * (answer - wanted).cwiseMin(kLinear).cwiseMax(-kLinear);
  put(last, g_last, h.back(), nullptr);
  Matrix g = own(last).transpose() * g_last;  // by h of the layer at hand
  for (std::size_t l = layers_.size() - 2; l > 0; --l) {
    const Matrix inner = g.array() * (1 - squashed[l].array().square());
    put(layers_[l], inner, h[l - 1], &mean[l]);
    g += own(layers_[l]).transpose() * inner +
         neighbour_mean_back(neighbours(layers_[l]).transpose() * inner, goes_on);
  }
  const Matrix inner = g.array() * (1 - squashed[0].array().square());
  put(layers_[0], inner, rows, nullptr);
}

}  // namespace conchoid
