#include "conchoid/bem/iterative_solver.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void divide(std::span<const double> a, std::span<const double> by, std::span<double> out) {
  for (std::size_t i = 0; i < a.size(); ++i)
    out[i] = a[i] / by[i];
}

class IterativeSolver : public BodySolver {
 public:
  IterativeSolver(BodyEntries& entries, const RigidMotions& motions)
      : nq_(entries.body().tractions()),
        nu_(entries.body().displacements()),
        V_(nq_ * nq_),
        K_(nq_ * nu_),
        D_(nu_ * nu_) {
    entries.keep_pairs();
    const auto& held = entries.body().held_triangles;
    const auto& nodes = entries.body().free_nodes;
    parallel_for(held.size(), 4, [&](std::size_t begin, std::size_t end) {
      const auto rows = std::span(held).subspan(begin, end - begin);
      entries.system_single_layer(rows, held, {V_.data() + 3 * begin * nq_, nq_, 1});
      entries.system_double_layer(rows, nodes, {K_.data() + 3 * begin * nu_, nu_, 1});
    });
    parallel_for(nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
      entries.system_hypersingular(std::span(nodes).subspan(begin, end - begin), nodes,
                                   {D_.data() + 3 * begin * nu_, nu_, 1});
    });
    hold(motions);
    for (std::size_t i = 0; i < nq_; ++i)
      diagonal_.push_back(V_[i * nq_ + i]);
    for (std::size_t i = 0; i < nu_; ++i)
      diagonal_.push_back(D_[i * nu_ + i]);
    if (std::any_of(diagonal_.begin(), diagonal_.end(), [](double d) { return !(d > 0); }))
      throw ComputationError(
          "the body's matrix has a diagonal entry that is not positive: the surface mesh has degenerate "
          "triangles; run `conchoid mesh` on it and remesh");
  }

  void apply(const double* x, double* y, std::size_t count) const override {
    for (std::size_t c = 0; c < count; ++c)
      apply_one(x + c * size(), y + c * size());
  }

  // Nothing can be done by halves here: P is the identity.
  void reduce(double* b, std::size_t count) const override { turn_signs(b, count); }
  void middle(double* b, std::size_t count) const override {
    if (size() == 0) return;
    turn_signs(b, count);
    parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c)
        solve_by_products([&](const double* x, double* y) { apply_one(x, y); }, nq_, diagonal_,
                          {b + c * size(), size()});
    });
  }
  void expand(double*, std::size_t) const override {}

  std::size_t bytes() const override { return (V_.size() + K_.size() + D_.size()) * sizeof(double); }

 private:
  std::size_t size() const { return nq_ + nu_; }

  void turn_signs(double* b, std::size_t count) const {  // J b
    for (std::size_t c = 0; c < count; ++c, b += size())
      for (std::size_t i = 0; i < nq_; ++i)
        b[i] = -b[i];
  }

  void hold(const RigidMotions& motions) {
    double trace = 0;
    for (std::size_t i = 0; i < nu_; ++i)
      trace += D_[i * nu_ + i];
    const double alpha = trace / static_cast<double>(std::max<std::size_t>(nu_, 1));
    for (const std::vector<double>& r : motions)
      for (std::size_t i = 0; i < nu_; ++i)
        for (std::size_t j = 0; j < nu_; ++j)
          D_[i * nu_ + j] += alpha * r[i] * r[j];
  }

  // Halves of x that are zero cost nothing: the inner iterations apply V alone, the outer ones D.
  void apply_one(const double* x, double* y) const {
    const OneBlasThread one_blas_thread;
    const int nq = static_cast<int>(nq_), nu = static_cast<int>(nu_);
    const double *q = x, *u = x + nq_;
    std::fill_n(y, size(), 0.0);
    if (std::any_of(q, q + nq_, [](double v) { return v != 0; })) {
      cblas_dgemv(CblasRowMajor, CblasNoTrans, nq, nq, 1, V_.data(), nq, q, 1, 1, y, 1);
      if (nu_ > 0) cblas_dgemv(CblasRowMajor, CblasTrans, nq, nu, 1, K_.data(), nu, q, 1, 1, y + nq_, 1);
    }
    if (std::any_of(u, u + nu_, [](double v) { return v != 0; })) {
      cblas_dgemv(CblasRowMajor, CblasNoTrans, nu, nu, 1, D_.data(), nu, u, 1, 1, y + nq_, 1);
      if (nq_ > 0) cblas_dgemv(CblasRowMajor, CblasNoTrans, nq, nu, -1, K_.data(), nu, u, 1, 1, y, 1);
    }
  }

  std::size_t nq_, nu_;
  std::vector<double> V_, K_, D_;  // row-major
  std::vector<double> diagonal_;
};

}  // namespace

std::size_t conjugate_gradients(const std::function<void(const double* x, double* y)>& apply,
                                std::span<const double> diagonal, std::span<double> b,
                                const IterationSettings& settings) {
  const std::size_t n = b.size();
  std::vector<double> x(n, 0.0), r(b.begin(), b.end()), z(n), p(n), Ap(n);
  divide(r, diagonal, z);
  double rz = dot(r, z);
  const double wanted = settings.tolerance * settings.tolerance * rz;
  p = z;
  for (std::size_t iteration = 0; iteration <= settings.most_iterations; ++iteration) {
    if (rz <= wanted) {
      std::copy(x.begin(), x.end(), b.begin());
      return iteration;
    }
    apply(p.data(), Ap.data());
    const double step = rz / dot(p, Ap);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += step * p[i];
      r[i] -= step * Ap[i];
    }
    divide(r, diagonal, z);
    const double before = rz;
    rz = dot(r, z);
    for (std::size_t i = 0; i < n; ++i)
      p[i] = z[i] + rz / before * p[i];
  }
  throw ComputationError("conjugate gradients did not converge: after " +
                         std::to_string(settings.most_iterations) + " iterations the residual is " +
                         std::to_string(std::sqrt(rz / wanted)) +
                         " times what is allowed; use the dense solver, or remesh the body");
}

void solve_by_products(const std::function<void(const double* x, double* y)>& apply, std::size_t tractions,
                       std::span<const double> diagonal, std::span<double> b,
                       const IterationSettings& settings) {
  const std::size_t n = b.size(), nq = tractions;
  std::vector<double> x(n), y(n);
  // V⁻¹ in place; leaves Kᵀ V⁻¹ of it in the second half of y.
  const auto solve_single_layer = [&](std::span<double> q) {
    const IterationSettings inner{0.1 * settings.tolerance, settings.most_iterations};
    const auto product = [&](const double* in, double* out) {
      std::copy_n(in, nq, x.begin());
      std::fill(x.begin() + static_cast<std::ptrdiff_t>(nq), x.end(), 0.0);
      apply(x.data(), y.data());
      std::copy_n(y.begin(), nq, out);
    };
    conjugate_gradients(product, diagonal.first(nq), q, inner);
    product(q.data(), std::vector<double>(nq).data());
  };
  const std::span<double> f_D = b.first(nq), f_N = b.subspan(nq);
  std::vector<double> q(f_D.begin(), f_D.end());
  if (nq > 0) {
    solve_single_layer(q);
    for (std::size_t i = nq; i < n; ++i)
      f_N[i - nq] -= y[i];
  }
  const auto schur_complement = [&](const double* in, double* out) {
    std::fill_n(x.begin(), nq, 0.0);
    std::copy_n(in, n - nq, x.begin() + static_cast<std::ptrdiff_t>(nq));
    apply(x.data(), y.data());  // (−K u, D u)
    std::copy(y.begin() + static_cast<std::ptrdiff_t>(nq), y.end(), out);
    if (nq == 0) return;
    std::vector<double> Ku(nq);
    for (std::size_t i = 0; i < nq; ++i)
      Ku[i] = -y[i];
    solve_single_layer(Ku);
    for (std::size_t i = nq; i < n; ++i)
      out[i - nq] += y[i];
  };
  if (nq < n) conjugate_gradients(schur_complement, diagonal.subspan(nq), f_N, settings);
  if (nq == 0) return;
  std::fill_n(x.begin(), nq, 0.0);
  std::copy(f_N.begin(), f_N.end(), x.begin() + static_cast<std::ptrdiff_t>(nq));
  apply(x.data(), y.data());
  for (std::size_t i = 0; i < nq; ++i)
    f_D[i] -= y[i];  // f_D + K u
  solve_single_layer(f_D);
}

std::unique_ptr<BodySolver> make_iterative_solver(BodyEntries& entries, const RigidMotions& motions,
                                                  const KeptSystem&) {
  return std::make_unique<IterativeSolver>(entries, motions);
}

}  // namespace conchoid
