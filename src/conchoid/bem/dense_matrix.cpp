#include "conchoid/bem/dense_matrix.hpp"

namespace conchoid {

DenseMatrix transposed(const DenseMatrix& a) {
  DenseMatrix t(a.columns, a.rows);
  for (std::size_t i = 0; i < a.rows; ++i)
    for (std::size_t j = 0; j < a.columns; ++j)
      t(j, i) = a(i, j);
  return t;
}

void add_transposed_product(const DenseMatrix& a, const DenseMatrix& b, DenseMatrix& y) {
  for (std::size_t k = 0; k < a.rows; ++k)
    for (std::size_t i = 0; i < a.columns; ++i) {
      const double aki = a(k, i);
      if (aki == 0) continue;
      for (std::size_t j = 0; j < b.columns; ++j)
        y(i, j) += aki * b(k, j);
    }
}

}  // namespace conchoid
