#include "conchoid/bem/crack_system.hpp"

#include <cblas.h>

#include <algorithm>
#include <map>

#include "conchoid/bem/row_store.hpp"
#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

Mat3 block_of(const DenseMatrix& m, std::size_t i, std::size_t j) {
  Mat3 block;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q)
      block(p, q) = m(i + static_cast<std::size_t>(p), j + static_cast<std::size_t>(q));
  return block;
}

CrackSystem::Function make_function(const EnrichedSpace& space, const EnrichmentFunction& f,
                                    EnrichmentRows& rows) {
  CrackSystem::Function out{f.kind, f.node, f.key, std::move(rows.body), std::move(rows.sources), {}};
  for (const PanelValues& v : f.support)
    if (v.panel >= space.surface_count)
      out.normal += space.panels[v.panel].area * space.panels[v.panel].normal;
  if (!f.carries_opening()) return out;
  out.normal.normalize();
  if (!f.free.isIdentity(0)) out.normal = f.free * out.normal;
  return out;
}

// Appends columns on the right.
void widen(DenseMatrix& m, const DenseMatrix& by) {
  DenseMatrix out(3, m.columns + by.columns);
  for (std::size_t p = 0; p < 3; ++p) {
    std::copy_n(m.data.data() + p * m.columns, m.columns, out.data.data() + p * out.columns);
    std::copy_n(by.data.data() + p * by.columns, by.columns, out.data.data() + p * out.columns + m.columns);
  }
  m = std::move(out);
}

}  // namespace

// Which functions of the new space are known, and which rows are wanted.
struct CrackSystem::Plan {
  std::vector<std::size_t> order;   // functions of the space, in the order of the system
  std::vector<std::size_t> before;  // of the known ones: their position in the old system
  std::vector<std::size_t> wanted;  // functions of the space to be assembled: the rest of `order`
  std::size_t unchanged = 0;        // leading functions that stay where they are
};

CrackSystem::CrackSystem(std::shared_ptr<const BodyOperator> body)
    : body_(std::move(body)),
      host_(make_crack_host(body_)),
      space_(make_enriched_space(whole_surface(body_->surface()), body_->surface(), body_->kinds())) {}

void CrackSystem::set_crack(const CutComplex& cut, const CutDivision& division, RowStore* store) {
  space_ = make_enriched_space(cut, body_->surface(), body_->kinds(), division);
  const Plan plan = plan_replacement();
  append(plan, stored_rows(*host_, space_, sources_, plan.wanted, store, pairs_));
  factored_ = std::min(factored_, plan.unchanged);
  factor_.truncate(3 * factored_);
  statistics_ = {functions_.size(), plan.wanted.size(), functions_.size() - factored_};
  eliminate();
}

CrackSystem::Plan CrackSystem::plan_replacement() const {
  std::map<std::vector<double>, std::size_t> index_of_key;
  for (std::size_t f = 0; f < space_.functions.size(); ++f)
    index_of_key.emplace(space_.functions[f].key, f);
  Plan plan;
  std::vector<char> taken(space_.functions.size(), 0);
  for (std::size_t i = 0; i < functions_.size(); ++i) {
    const auto found = index_of_key.find(functions_[i].key);
    if (found == index_of_key.end() || taken[found->second]) continue;
    if (plan.order.size() == i) plan.unchanged = i + 1;
    taken[found->second] = 1;
    plan.order.push_back(found->second);
    plan.before.push_back(i);
  }
  for (std::size_t f = 0; f < space_.functions.size(); ++f)
    if (!taken[f]) plan.wanted.push_back(f);
  plan.order.insert(plan.order.end(), plan.wanted.begin(), plan.wanted.end());
  return plan;
}

void CrackSystem::append(const Plan& plan, std::vector<EnrichmentRows> rows) {
  constexpr std::size_t functions_of_task = 16;
  const std::size_t kept = plan.before.size(), count = plan.order.size();
  std::vector<Function> functions;
  for (std::size_t i = 0; i < kept; ++i) {
    functions.push_back(std::move(functions_[plan.before[i]]));
    functions.back().node = space_.functions[plan.order[i]].node;
  }
  for (std::size_t w = 0; w < plan.wanted.size(); ++w)
    functions.push_back(make_function(space_, space_.functions[plan.wanted[w]], rows[w]));
  functions_ = std::move(functions);
  reduce_rows(kept);
  const DenseMatrix coupling = couplings(kept);
  const auto put = [&](std::size_t w) {
    const std::size_t i = kept + w;
    const Mat3& free = space_.functions[plan.wanted[w]].free;
    functions_[i].stiffness = DenseMatrix(3, 3 * (i + 1));
    for (std::size_t j = 0; j <= i; ++j) {
      Mat3 block = block_of(rows[w].enriched, 0, 3 * plan.order[j]) - block_of(coupling, 3 * w, 3 * j);
      if (j == i && !free.isIdentity(0))  // components that are prescribed stand alone
        block += block.trace() / free.trace() * (Mat3::Identity() - free);
      functions_[i].stiffness.add(0, 3 * j, block);
    }
  };
  parallel_for(count, functions_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      i < kept ? keep_stiffness(plan, i) : put(i - kept);
  });
  position_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    position_[plan.order[i]] = i;
}

// Leaves out what is gone.
void CrackSystem::keep_stiffness(const Plan& plan, std::size_t i) {
  if (i < plan.unchanged) return;
  DenseMatrix kept(3, 3 * (i + 1));
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t j = 0; j <= i; ++j)
      std::copy_n(
          functions_[i].stiffness.data.data() + p * functions_[i].stiffness.columns + 3 * plan.before[j], 3,
          kept.data.data() + p * kept.columns + 3 * j);
  functions_[i].stiffness = std::move(kept);
}

// Rows of some functions, one after the other.
std::vector<double> CrackSystem::rows_of(std::size_t first, std::size_t last) const {
  std::vector<double> rows;
  rows.reserve(3 * (last - first) * host_->unknowns());
  for (std::size_t f = first; f < last; ++f)
    rows.insert(rows.end(), functions_[f].rows.data.begin(), functions_[f].rows.data.end());
  return rows;
}

// Rows of R of the functions from `first` on become rows of Y.
void CrackSystem::reduce_rows(std::size_t first) {
  const std::size_t n = host_->unknowns(), nq = host_->tractions(), columns = 3 * (functions_.size() - first);
  if (n == 0 || columns == 0) return;
  std::vector<double> y = rows_of(first, functions_.size());
  for (std::size_t c = 0; c < columns; ++c)  // columns of B = J Rᵀ
    for (std::size_t i = 0; i < nq; ++i)
      y[c * n + i] = -y[c * n + i];
  host_->solver().reduce(y.data(), columns);
  for (std::size_t f = first; f < functions_.size(); ++f)
    std::copy_n(y.data() + 3 * (f - first) * n, 3 * n, functions_[f].rows.data.data());
}

// Y M Yᵀ of the rows of the functions from `first` on and the columns of all.
DenseMatrix CrackSystem::couplings(std::size_t first) const {
  constexpr std::size_t functions_of_task = 32;
  const std::size_t n = host_->unknowns(), count = 3 * (functions_.size() - first);
  DenseMatrix out(count, size());
  if (n == 0 || count == 0) return out;
  std::vector<double> x = rows_of(first, functions_.size());
  host_->solver().middle(x.data(), count);
  const OneBlasThread one_blas_thread;
  parallel_for(functions_.size(), functions_of_task, [&](std::size_t begin, std::size_t end) {
    const std::vector<double> rows = rows_of(begin, end);
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasTrans, static_cast<int>(count),
                static_cast<int>(3 * (end - begin)), static_cast<int>(n), 1.0, x.data(), static_cast<int>(n),
                rows.data(), static_cast<int>(n), 0.0, out.data.data() + 3 * begin, static_cast<int>(size()));
  });
  return out;
}

void CrackSystem::eliminate() {
  const auto row = [&](std::size_t i) {
    const DenseMatrix& stiffness = functions_[factored_ + i / 3].stiffness;
    return stiffness.data.data() + i % 3 * stiffness.columns;
  };
  if (!factor_.append(size() - 3 * factored_, row))
    throw SingularSystem(
        "the cracked body's stiffness is not positive definite: a piece has come off, or the crack mesh "
        "touches itself");
  factored_ = functions_.size();
}

void CrackSystem::need_sources(std::span<const LoadSource> sources) {
  std::vector<LoadSource> missing;
  for (const LoadSource& s : sources)
    if (std::find(sources_.begin(), sources_.end(), s) == sources_.end()) missing.push_back(s);
  if (missing.empty()) return;
  if (!functions_.empty()) {
    const std::vector<DenseMatrix> columns = assemble_source_columns(*body_, space_, missing);
    for (std::size_t f = 0; f < columns.size(); ++f)
      widen(functions_[position_[f]].sources, columns[f]);
  }
  sources_.insert(sources_.end(), missing.begin(), missing.end());
}

std::vector<double> CrackSystem::right_hand_side(const LoadCase& load) const {
  std::vector<Vec3> values;
  for (const LoadSource& s : sources_)
    values.push_back(value_at(load, s));
  std::vector<double> g(size());
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    const std::size_t i = position_[f];
    const Mat3& free = space_.functions[f].free;
    Vec3 sum = enrichment_load(space_, space_.functions[f], load);
    if (!free.isIdentity(0)) sum = (free * sum).eval();
    for (std::size_t s = 0; s < values.size(); ++s)
      sum -= block_of(functions_[i].sources, 0, 3 * s) * values[s];
    std::copy_n(sum.data(), 3, &g[3 * i]);
  }
  return g;
}

void CrackSystem::subtract_load(const double* z, std::vector<double>& g) const {
  const int n = static_cast<int>(host_->unknowns());
  if (n == 0) return;
  const OneBlasThread one_blas_thread;
  for (std::size_t f = 0; f < functions_.size(); ++f)
    cblas_dgemv(CblasRowMajor, CblasNoTrans, 3, n, -1.0, functions_[f].rows.data.data(), n, z, 1, 1.0,
                &g[3 * f], 1);
}

std::vector<double> CrackSystem::body_unknowns(std::vector<double> z, const std::vector<double>& a) const {
  const int n = static_cast<int>(z.size());
  if (n == 0) return z;
  std::vector<double> y(z.size(), 0.0);
  {
    const OneBlasThread one_blas_thread;
    for (std::size_t f = 0; f < functions_.size(); ++f)
      cblas_dgemv(CblasRowMajor, CblasTrans, 3, n, 1.0, functions_[f].rows.data.data(), n, &a[3 * f], 1, 1.0,
                  y.data(), 1);
  }
  host_->solver().middle(y.data(), 1);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] -= y[i];
  host_->solver().expand(z.data(), 1);
  return z;
}

}  // namespace conchoid
