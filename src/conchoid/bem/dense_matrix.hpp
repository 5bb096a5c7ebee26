#pragma once

#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// Dense row-major matrix.
struct DenseMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> data;

  DenseMatrix() = default;
  DenseMatrix(std::size_t r, std::size_t c) : rows(r), columns(c), data(r * c, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return data[i * columns + j]; }
  double operator()(std::size_t i, std::size_t j) const { return data[i * columns + j]; }
  void add(std::size_t i, std::size_t j, const Mat3& block) {
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q)
        (*this)(i + p, j + q) += block(p, q);
  }
};

DenseMatrix transposed(const DenseMatrix& a);

/// y += Aᵀ B for A (k × m), B (k × n), y (m × n).
void add_transposed_product(const DenseMatrix& a, const DenseMatrix& b, DenseMatrix& y);

}  // namespace conchoid
