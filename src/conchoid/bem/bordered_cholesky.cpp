#include "conchoid/bem/bordered_cholesky.hpp"

#include <cblas.h>

#include <algorithm>

#include "conchoid/bem/blas.hpp"
#include "conchoid/core/blas_threads.hpp"

extern "C" void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda,
                        double* b, const int* ldb, int* info);

namespace conchoid {

void BorderedCholesky::reserve(std::size_t n) {
  if (n <= capacity_) return;
  const std::size_t grown = std::max(n, capacity_ + capacity_ / 2);
  auto moved = std::make_unique_for_overwrite<double[]>(grown * grown);
  for (std::size_t j = 0; j < n_; ++j)
    std::copy_n(&factor_[j * capacity_ + j], n_ - j, &moved[j * grown + j]);
  factor_ = std::move(moved);
  capacity_ = grown;
}

bool BorderedCholesky::append(const std::vector<double>& coupling, const std::vector<double>& diagonal) {
  const OneBlasThread one_blas_thread;
  std::size_t m = 0;
  while (m * m < diagonal.size())
    ++m;
  if (m == 0) return true;
  reserve(n_ + m);
  if (n_ == 0) scale_ = unit_scale(diagonal[0]);
  const int lead = static_cast<int>(capacity_), n = static_cast<int>(n_), k = static_cast<int>(m);
  double* border = factor_.get() + n_;  // rows n…n+m of the old columns
  double* corner = factor_.get() + n_ * capacity_ + n_;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < m; ++i)
      border[j * capacity_ + i] = scale_ * coupling[i * n_ + j];
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = j; i < m; ++i)
      corner[j * capacity_ + i] = scale_ * diagonal[i * m + j];
  if (n_ > 0) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, k, n, 1.0, factor_.get(),
                lead, border, lead);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, k, n, -1.0, border, lead, 1.0, corner, lead);
  }
  if (!factor_in_place(corner, m, capacity_)) return false;
  n_ += m;
  return true;
}

void BorderedCholesky::truncate(std::size_t n) {
  n_ = std::min(n, n_);
}

void BorderedCholesky::solve(double* b, std::size_t count) const {
  if (n_ == 0 || count == 0) return;
  const OneBlasThread one_blas_thread;
  const int n = static_cast<int>(n_), lead = static_cast<int>(capacity_), columns = static_cast<int>(count);
  for (std::size_t i = 0; i < n_ * count; ++i)
    b[i] *= scale_;
  int info = 0;
  dpotrs_("L", &n, &columns, factor_.get(), &lead, b, &n, &info);
}

}  // namespace conchoid
