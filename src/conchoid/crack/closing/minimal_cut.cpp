#include "conchoid/crack/closing/minimal_cut.hpp"

#include <algorithm>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <cmath>
#include <utility>

#include "conchoid/core/interrupt.hpp"
#include "conchoid/crack/closing/cell_sets.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {
namespace {

constexpr int kFaceCost = 20;    // of one face of a cell, in whole numbers: exact, whatever the order of sums
constexpr int kNever = 1 << 29;  // beyond the cost of all faces

using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                 boost::no_property, std::int32_t, std::int32_t>;
using Arc = boost::graph_traits<Graph>::edge_descriptor;

// Calls see(number, faces) for cells inside: surplus of faces of the crack that look at it from its upper over those from its
// lower side.
template <class See>
void for_faces_seen(const CellGrid& grid, const std::vector<bool>& crack, const See& see) {
  const auto& crossings = grid.crossings();
  const auto same_edge = [](const SheetCrossing& x, const SheetCrossing& y) {
    return x.cell == y.cell && x.axis == y.axis;
  };
  const auto see_inside = [&](std::size_t cell, int faces) {
    if (const std::int32_t i = grid.number(cell); i >= 0) see(static_cast<std::size_t>(i), faces);
  };
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const SheetCrossing& x = crossings[i];
    if (!crack[x.triangle.index()]) continue;
    if (i == 0 || !same_edge(crossings[i - 1], x)) see_inside(x.cell, x.upwards ? -1 : 1);
    if (i + 1 == crossings.size() || !same_edge(crossings[i + 1], x))
      see_inside(grid.next(x.cell, x.axis), x.upwards ? 1 : -1);
  }
}

// Vertices of the graph: a cell of the band, or all cells beyond it that hang together there.
CellSets vertices_of(const CellGrid& grid, const std::vector<std::uint8_t>& band) {
  return sets_of_cells(grid, [&](std::size_t i, int axis, std::size_t next) {
    return !band[i] && !band[next] && grid.open(i, axis);
  });
}

// Arcs out of each vertex, one after the other; each with its capacity and its opposite.
struct Network {
  std::vector<std::pair<std::int32_t, std::int32_t>> arcs;
  std::vector<int> capacity;
  std::vector<std::size_t> opposite;
};

class NetworkBuilder {
 public:
  explicit NetworkBuilder(std::size_t vertices) : first_(vertices + 1, 0) {}
  void connect(std::int32_t a, std::int32_t b, int there, int back) {
    links_.push_back({a, b, there, back});
    ++first_[static_cast<std::size_t>(a) + 1];
    ++first_[static_cast<std::size_t>(b) + 1];
  }
  /// Once. The arcs of a vertex in the order in which they were made.
  Network build() {
    for (std::size_t v = 1; v < first_.size(); ++v)
      first_[v] += first_[v - 1];
    Network network;
    network.arcs.resize(first_.back());
    network.capacity.resize(first_.back());
    network.opposite.resize(first_.back());
    for (const Link& l : links_) {
      const std::size_t there = first_[static_cast<std::size_t>(l.a)]++,
                        back = first_[static_cast<std::size_t>(l.b)]++;
      network.arcs[there] = {l.a, l.b};
      network.arcs[back] = {l.b, l.a};
      network.capacity[there] = l.there;
      network.capacity[back] = l.back;
      network.opposite[there] = back;
      network.opposite[back] = there;
    }
    return network;
  }

 private:
  struct Link {
    std::int32_t a, b;
    int there, back;
  };
  std::vector<Link> links_;
  std::vector<std::size_t> first_;  // arc of each vertex
};

}  // namespace

CellPartition minimal_cut(const CellGrid& grid, const std::vector<bool>& crack,
                          const std::vector<std::uint8_t>& band, const std::vector<std::int8_t>& known) {
  throw_if_interrupted();
  const CellSets vertices = vertices_of(grid, band);
  const std::vector<std::int32_t>& vertex = vertices.of_cell;
  const std::int32_t count = vertices.count, source = count, sink = count + 1;
  NetworkBuilder builder(static_cast<std::size_t>(count) + 2);
  std::vector<int> surplus(static_cast<std::size_t>(count), 0);
  std::vector<char> up(static_cast<std::size_t>(count), 0), down(up);  // that cells are known to lie there
  for_faces_seen(grid, crack, [&](std::size_t cell, int faces) {
    surplus[static_cast<std::size_t>(vertex[cell])] += faces;
  });
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] != 0) (known[i] > 0 ? up : down)[static_cast<std::size_t>(vertex[i])] = 1;
  for_faces_in_band(grid, band, [&](std::size_t i, std::size_t next, std::size_t, int) {
    builder.connect(vertex[i], vertex[next], kFaceCost, kFaceCost);
  });
  const int unused = static_cast<int>(std::lround(kUnusedFace * kFaceCost));
  for (std::int32_t v = 0; v < count; ++v) {
    const int faces = surplus[static_cast<std::size_t>(v)];
    const char above = up[static_cast<std::size_t>(v)], below = down[static_cast<std::size_t>(v)];
    if (above != below) builder.connect(above ? source : v, above ? v : sink, kNever, 0);
    if (faces > 0) builder.connect(source, v, unused * faces, 0);
    if (faces < 0) builder.connect(v, sink, -unused * faces, 0);
  }
  const Network network = builder.build();
  const Graph graph(boost::edges_are_sorted, network.arcs.begin(), network.arcs.end(), count + 2);
  std::vector<Arc> arcs, opposite;
  for (auto [a, end] = boost::edges(graph); a != end; ++a)
    arcs.push_back(*a);
  for (const std::size_t o : network.opposite)
    opposite.push_back(arcs[o]);
  std::vector<int> residual = network.capacity, distance(count + 2);
  std::vector<boost::default_color_type> color(count + 2);
  std::vector<Arc> predecessor(count + 2);
  const auto by_arc = boost::get(boost::edge_index, graph);
  const auto by_vertex = boost::get(boost::vertex_index, graph);
  boost::boykov_kolmogorov_max_flow(
      graph, boost::make_iterator_property_map(network.capacity.begin(), by_arc),
      boost::make_iterator_property_map(residual.begin(), by_arc),
      boost::make_iterator_property_map(opposite.begin(), by_arc),
      boost::make_iterator_property_map(predecessor.begin(), by_vertex),
      boost::make_iterator_property_map(color.begin(), by_vertex),
      boost::make_iterator_property_map(distance.begin(), by_vertex), by_vertex, source, sink);
  CellPartition out;
  out.side.resize(vertex.size());
  for (const CellSets::Chain& chain : vertices.chains) {
    const bool upper = color[static_cast<std::size_t>(chain.set)] == color[static_cast<std::size_t>(source)];
    std::fill(out.side.begin() + chain.first, out.side.begin() + chain.end, std::int8_t(upper ? 1 : -1));
  }
  return out;
}

}  // namespace conchoid
