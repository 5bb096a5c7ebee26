#include "conchoid/bem/blas.hpp"

#include <cmath>

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace conchoid {
namespace {

/// @param triangle  "L" or "U", as a column-major matrix has it
bool factor(const char* triangle, double* a, std::size_t n, std::size_t lead) {
  if (n == 0) return true;
  const int size = static_cast<int>(n), stride = static_cast<int>(lead);
  int info = 0;
  dpotrf_(triangle, &size, a, &stride, &info);
  return info == 0;
}

}  // namespace

bool factor_in_place(double* a, std::size_t n, std::size_t lead) {
  return factor("L", a, n, lead);
}

bool factor_rows_in_place(double* a, std::size_t n, std::size_t lead) {
  return factor("U", a, n, lead);
}

double unit_scale(double first) {
  return first > 0 && std::isfinite(first) ? std::ldexp(1.0, -std::ilogb(first)) : 1.0;
}

}  // namespace conchoid
