#include "conchoid/bem/body_load.hpp"

#include <algorithm>

#include "conchoid/bem/pair_blocks.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

class LoadAssembler {
 public:
  LoadAssembler(const TriMesh& surface, const std::vector<BoundaryKind>& kinds, const ElasticConstants& m,
                const BodyBlocks& body, const PairIntegrator& integrator, const LoadCase& load)
      : surface_(surface), m_(m), body_(body), load_(load) {
    for (std::size_t t = 0; t < kinds.size(); ++t) {
      const auto& nodes = surface.corners[TriId(t)];
      const bool loaded = kinds[t] == BoundaryKind::traction && load.traction[t] != Vec3::Zero();
      const bool moved = std::any_of(nodes.begin(), nodes.end(), [&](NodeId i) { return moved_node(i); });
      if (loaded || moved) sources_.push_back({t, loaded, moved});
    }
    integrate(kinds, integrator);
  }

  Vec3 node_row(const CornersAround& around) const {
    Vec3 f = Vec3::Zero();
    for (const auto& [x, corner] : around) {
      const Vec3& b = body_.curls[x][corner];
      f += 0.5 * body_.panels[x].area / 3 * load_.traction[x];
      for (std::size_t s = 0; s < sources_.size(); ++s) {
        const std::size_t y = sources_[s].triangle;
        const Pair& pair = pairs_[s * body_.panels.size() + x];
        const PairBlocks blocks(pair.single, m_);
        for (int k = 0; k < 3; ++k)
          if (const NodeId node = surface_.corners[TriId(y)][k]; moved_node(node))
            f -= blocks.hypersingular(b, body_.curls[y][k]) * load_.displacement[node];
        if (sources_[s].loaded)
          f -= blocks.double_layer(b, pair.double_at_source[corner]).transpose() * load_.traction[y];
      }
    }
    return f;
  }

  Vec3 triangle_row(std::size_t x) const {
    Vec3 f = Vec3::Zero();
    for (NodeId node : surface_.corners[TriId(x)])
      f += 0.5 * body_.panels[x].area / 3 * load_.displacement[node];
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const std::size_t y = sources_[s].triangle;
      const Pair& pair = pairs_[s * body_.panels.size() + x];
      const PairBlocks blocks(pair.single, m_);
      if (sources_[s].loaded) f -= blocks.single_layer() * load_.traction[y];
      for (int k = 0; k < 3; ++k)
        if (const NodeId node = surface_.corners[TriId(y)][k]; moved_node(node))
          f += blocks.double_layer(body_.curls[y][k], pair.double_at_row[k]) * load_.displacement[node];
    }
    return f;
  }

 private:
  // A triangle that carries a prescribed value.
  struct Source {
    std::size_t triangle;
    bool loaded, moved;
  };

  bool moved_node(NodeId node) const { return load_.displacement[node] != Vec3::Zero(); }

  struct Pair {
    SingleLayerPair single;
    DoubleLayerPair double_at_source{};  // constant on the source, linear on the row's triangle
    DoubleLayerPair double_at_row{};     // the other way round
  };

  void integrate(const std::vector<BoundaryKind>& kinds, const PairIntegrator& integrator) {
    const std::size_t n = body_.panels.size();
    pairs_.resize(sources_.size() * n);
    parallel_for(pairs_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Source& source = sources_[i / n];
        const std::size_t x = i % n, y = source.triangle;
        pairs_[i].single =
            integrator.single_layer(body_.panels[std::max(x, y)], body_.panels[std::min(x, y)]);
        if (source.loaded)
          pairs_[i].double_at_source = integrator.double_layer(body_.panels[y], body_.panels[x]);
        if (source.moved && kinds[x] == BoundaryKind::displacement)
          pairs_[i].double_at_row = integrator.double_layer(body_.panels[x], body_.panels[y]);
      }
    });
  }

  const TriMesh& surface_;
  const ElasticConstants& m_;
  const BodyBlocks& body_;
  const LoadCase& load_;
  std::vector<Source> sources_;
  std::vector<Pair> pairs_;  // source by source, a triangle each
};

void store(const Vec3& v, int block, std::vector<double>& f) {
  for (int p = 0; p < 3; ++p)
    f[3 * static_cast<std::size_t>(block) + p] = v[p];
}

}  // namespace

BodyLoad assemble_load(const TriMesh& surface, const std::vector<BoundaryKind>& kinds,
                       const ElasticConstants& m, const BodyBlocks& body, const PairIntegrator& integrator,
                       const LoadCase& load) {
  const LoadAssembler assembler(surface, kinds, m, body, integrator, load);
  const std::vector<CornersAround> around = corners_around_nodes(surface);
  BodyLoad out;
  out.f_N.assign(3 * body.unknowns.displacement_count, 0.0);
  out.f_D.assign(3 * body.unknowns.traction_count, 0.0);
  parallel_for(around.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (const int at = body.unknowns.displacement[i]; at >= 0)
        store(assembler.node_row(around[i]), at, out.f_N);
  });
  parallel_for(kinds.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      if (const int at = body.unknowns.traction[x]; at >= 0) store(assembler.triangle_row(x), at, out.f_D);
  });
  return out;
}

}  // namespace conchoid
