#include "conchoid/bem/load_columns.hpp"

#include "conchoid/core/parallel.hpp"

namespace conchoid {

std::vector<LoadSource> sources_of(const LoadCase& load) {
  std::vector<LoadSource> sources;
  for (std::size_t t = 0; t < load.traction.size(); ++t)
    if (!load.traction[t].isZero(0)) sources.push_back({Prescribed::traction, t});
  for (std::size_t i = 0; i < load.displacement.size(); ++i)
    if (!load.displacement[NodeId(i)].isZero(0)) sources.push_back({Prescribed::displacement, i});
  return sources;
}

Vec3 value_at(const LoadCase& load, const LoadSource& source) {
  return source.kind == Prescribed::traction ? load.traction[source.index]
                                             : load.displacement[NodeId(source.index)];
}

std::vector<double> LoadColumns::integrate(const LoadSource& source) const {
  const BodyDiscretisation& body = entries_.body();
  const std::size_t n = body.unknowns(), nq = body.tractions();
  std::vector<double> out(3 * n);
  const BlockView tractions{out.data(), 1, n};
  const BlockView displacements{out.data() + nq, n, 1};  // the source's rows, transposed
  if (source.kind == Prescribed::traction) {
    const TriId self[] = {TriId(source.index)};
    entries_.single_layer(body.held_triangles, self, tractions);
    entries_.double_layer(self, body.free_nodes, displacements);
  } else {
    const NodeId self[] = {NodeId(source.index)};
    entries_.double_layer(body.held_triangles, self, tractions);
    entries_.hypersingular(self, body.free_nodes, displacements);
  }
  const bool negative_tractions = source.kind == Prescribed::traction;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < n; ++i)
      if (i >= nq || negative_tractions) out[c * n + i] = -out[c * n + i];
  return out;
}

// Integration runs outside of the lock: a thread that waits for its tasks may be given one that comes here.
std::vector<const double*> LoadColumns::columns(std::span<const LoadSource> sources) {
  std::vector<LoadSource> missing;
  {
    const std::lock_guard lock(mutex_);
    for (const LoadSource& s : sources)
      if (!kept_.contains(s)) missing.push_back(s);
  }
  auto made = parallel_values(missing.size(), 1, [&](std::size_t i) { return integrate(missing[i]); });
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const auto column = std::make_shared<const std::vector<double>>(std::move(made[i]));
    kept_.try_emplace(missing[i], column, column->data());
  }
  std::vector<const double*> out;
  for (const LoadSource& s : sources)
    out.push_back(kept_.at(s).get());
  return out;
}

void LoadColumns::add_mass(const LoadCase& load, std::vector<double>& f) const {
  const BodyDiscretisation& body = entries_.body();
  const auto add = [&](std::size_t at, double weight, const Vec3& value) {
    for (int p = 0; p < 3; ++p)
      f[at + p] += weight * value[p];
  };
  for (std::size_t x = 0; x < body.panels.size(); ++x)
    for (NodeId node : body.surface.corners[TriId(x)]) {
      const double weight = 0.5 * body.panels[x].area / 3;
      if (const int q = body.traction_unknown[x]; q >= 0)
        add(3 * static_cast<std::size_t>(q), weight, load.displacement[node]);
      if (const int u = body.displacement_unknown[node.index()]; u >= 0)
        add(body.tractions() + 3 * static_cast<std::size_t>(u), weight, load.traction[x]);
    }
}

std::vector<double> LoadColumns::right_hand_side(const LoadCase& load) {
  const std::size_t n = entries_.body().unknowns();
  std::vector<double> f(n, 0.0);
  add_mass(load, f);
  const std::vector<LoadSource> sources = sources_of(load);
  const std::vector<const double*> column = columns(sources);
  constexpr std::size_t of_task = 512;
  parallel_for(n, of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const Vec3 value = value_at(load, sources[s]);
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = begin; i < end; ++i)
          f[i] += value[c] * column[s][static_cast<std::size_t>(c) * n + i];
    }
  });
  entries_.body().keep_unknown(f.data());
  return f;
}

// How many there are, kind and index of each, then the columns of each.
void LoadColumns::put(ByteWriter& out) const {
  const std::lock_guard lock(mutex_);
  const std::size_t length = 3 * entries_.body().unknowns() * sizeof(double);
  out.put(static_cast<std::uint64_t>(kept_.size()));
  for (const auto& [source, column] : kept_) {
    out.put(static_cast<std::uint64_t>(source.kind == Prescribed::displacement));
    out.put(static_cast<std::uint64_t>(source.index));
  }
  for (const auto& [source, column] : kept_)
    out.put_raw({reinterpret_cast<const char*>(column.get()), length});
}

void LoadColumns::take(const KeptBytes& kept) {
  const std::lock_guard lock(mutex_);
  const std::size_t length = 3 * entries_.body().unknowns() * sizeof(double);
  ByteReader in(kept.bytes);
  std::vector<LoadSource> sources;
  for (auto n = in.get<std::uint64_t>(); n > 0; --n) {
    const auto kind = in.get<std::uint64_t>() == 0 ? Prescribed::traction : Prescribed::displacement;
    sources.push_back({kind, static_cast<std::size_t>(in.get<std::uint64_t>())});
  }
  for (const LoadSource& source : sources)
    kept_.try_emplace(source, kept.owner, reinterpret_cast<const double*>(in.get_raw(length).data()));
}

std::size_t LoadColumns::bytes() const {
  const std::lock_guard lock(mutex_);
  return kept_.size() * 3 * entries_.body().unknowns() * sizeof(double);
}

}  // namespace conchoid
