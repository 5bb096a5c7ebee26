#pragma once

#include <cstddef>

namespace conchoid {

/// By LAPACK, inside a OneBlasThread: lower Cholesky factor in place of a symmetric matrix, column-major, `lead`
/// apart; only the lower triangle is read and written. False when it is not positive definite.
[[nodiscard]] bool factor_in_place(double* a, std::size_t n, std::size_t lead);
/// The same of a row-major matrix.
[[nodiscard]] bool factor_rows_in_place(double* a, std::size_t n, std::size_t lead);

/// A power of two that brings `first`, the first entry of a matrix, to 1 … 2, so that roots see the same
/// digits whatever the units; 1 when it is not positive.
double unit_scale(double first);

}  // namespace conchoid
