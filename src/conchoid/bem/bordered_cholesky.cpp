#include "conchoid/bem/bordered_cholesky.hpp"

#include <cblas.h>

#include <algorithm>

#include "conchoid/bem/blas.hpp"
#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/parallel.hpp"

extern "C" void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda,
                        double* b, const int* ldb, int* info);

namespace conchoid {

void BorderedCholesky::reserve(std::size_t n) {
  if (n <= capacity_) return;
  const std::size_t grown = std::max(n, capacity_ + capacity_ / 2);
  auto moved = std::make_unique_for_overwrite<double[]>(grown * grown);
  for (std::size_t i = 0; i < n_; ++i)
    std::copy_n(&factor_[i * capacity_], i + 1, &moved[i * grown]);
  factor_ = std::move(moved);
  capacity_ = grown;
}

bool BorderedCholesky::append(std::size_t count, const std::function<const double*(std::size_t)>& row) {
  constexpr std::size_t rows_of_task = 32;
  if (count == 0) return true;
  const OneBlasThread one_blas_thread;
  reserve(n_ + count);
  if (n_ == 0) scale_ = unit_scale(*row(0));
  const int stride = static_cast<int>(capacity_), n = static_cast<int>(n_);
  double* border = &factor_[n_ * capacity_];
  double* corner = border + n_;
  parallel_for(count, rows_of_task, [&](std::size_t begin, std::size_t end) {
    double* x = border + begin * capacity_;
    for (std::size_t i = begin; i < end; ++i) {
      const double* a = row(i);
      std::transform(a, a + n_ + i + 1, border + i * capacity_, [&](double v) { return scale_ * v; });
    }
    if (n_ > 0)
      cblas_dtrsm(CblasRowMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit,
                  static_cast<int>(end - begin), n, 1.0, factor_.get(), stride, x, stride);
  });
  if (n_ > 0)
    parallel_for(count, rows_of_task, [&](std::size_t begin, std::size_t end) {
      const int own = static_cast<int>(end - begin), before = static_cast<int>(begin);
      const double* x = border + begin * capacity_;
      double* c = corner + begin * capacity_;
      cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasTrans, own, before, n, -1.0, x, stride, border, stride,
                  1.0, c, stride);
      cblas_dsyrk(CblasRowMajor, CblasLower, CblasNoTrans, own, n, -1.0, x, stride, 1.0, c + begin, stride);
    });
  if (!factor_rows_in_place(corner, count, capacity_)) return false;
  n_ += count;
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
  dpotrs_("U", &n, &columns, factor_.get(), &lead, b, &n, &info);
}

}  // namespace conchoid
