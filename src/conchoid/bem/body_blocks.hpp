#pragma once

#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/elastic/constants.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

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

/// Which unknown a node's displacement and a triangle's traction are: −1 where they are prescribed.
struct Unknowns {
  std::vector<int> displacement;  ///< per node: 0 … displacement_count−1
  std::vector<int> traction;      ///< per triangle: 0 … traction_count−1
  std::size_t displacement_count = 0, traction_count = 0;
};
Unknowns number_unknowns(const TriMesh& surface, const BoundaryData& data);

/// The blocks of the uncracked body, unknown traction q on the displacement boundary, unknown displacement u
/// elsewhere:
///   | V  −K | |q|   |f_D|      f_D = −V g_N + (½M + K) g_D
///   | Kᵀ  D | |u| = |f_N|      f_N = (½M − Kᵀ) g_N − D g_D                              docs/theory.md (B1)
struct BodyBlocks {
  std::vector<Panel> panels;               ///< per triangle
  std::vector<std::array<Vec3, 3>> curls;  ///< per triangle, of its corner functions
  Unknowns unknowns;
  DenseMatrix V, K, D;
  std::vector<double> f_D, f_N;
};

BodyBlocks assemble_body(const TriMesh& surface, const BoundaryData& data, const ElasticConstants& m,
                         const PairIntegrator& integrator);

}  // namespace conchoid
