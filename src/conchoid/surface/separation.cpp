#include "conchoid/surface/separation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/mesh/sort_by_edge.hpp"

namespace conchoid {
namespace {

using HalfEdge = Gluer::HalfEdge;

class Gluing {
 public:
  Gluing(const CutComplex& cut, std::span<const HalfEdge> halves, std::span<const std::uint32_t> corner_of,
         std::size_t corner_count, UnionFind faces, const std::vector<bool>& left_out)
      : cut_(cut),
        halves_(halves),
        corner_of_(corner_of),
        corner_count_(corner_count),
        corners_(corner_count),
        faces_(std::move(faces)) {
    collect_faces(left_out);
  }

  Shells run() {
    glue_edges();
    number_vertices();
    number_solids();
    return std::move(shells_);
  }

 private:
  void collect_faces(const std::vector<bool>& left_out) {
    shells_.surface_faces = cut_.surface.size();
    shells_.sheet_faces = cut_.sheet.size();
    shells_.corners.assign(cut_.surface.begin(), cut_.surface.end());
    shells_.corners.insert(shells_.corners.end(), cut_.sheet.begin(), cut_.sheet.end());
    for (auto c : cut_.sheet) {
      std::swap(c[1], c[2]);
      shells_.corners.push_back(c);
    }
    shells_.present.assign(shells_.corners.size(), true);
    for (std::size_t s = 0; s < left_out.size(); ++s)
      if (left_out[s]) {
        shells_.present[shells_.surface_faces + s] = false;
        shells_.present[shells_.surface_faces + shells_.sheet_faces + s] = false;
      }
  }

  void glue_edges() {
    std::vector<HalfEdge> present;
    for (auto begin = halves_.begin(); begin != halves_.end();) {
      present.clear();
      auto end = begin;
      for (; end != halves_.end() && end->edge == begin->edge; ++end)
        if (shells_.present[end->face]) present.push_back(*end);
      if (!present.empty()) glue_edge(present.data(), present.size());
      begin = end;
    }
  }

  /// Same edge on the other side of a sheet face: corner order there is 0, 2, 1.
  HalfEdge turned(const HalfEdge& h) const {
    constexpr std::uint16_t corner[3] = {
        2, 1, 0};  // edge (k, k+1) is edge (corner[k], corner[k]+1) of the turned face
    return {h.edge, static_cast<std::uint32_t>(shells_.opposite(h.face)), corner[h.corner], !h.along};
  }

  void glue_edge(const HalfEdge* h, std::size_t n) {
    const std::size_t on_surface = static_cast<std::size_t>(
        std::count_if(h, h + n, [&](const HalfEdge& x) { return x.face < shells_.surface_faces; }));
    const bool two = on_surface == 2 && h[0].along != h[1].along;
    if (on_surface == 0 && n == 1) {
      glue(h[0], turned(h[0]));
    } else if (on_surface == 0 && n == 2) {
      const HalfEdge other = h[1].along != h[0].along ? h[1] : turned(h[1]);
      glue(h[0], other);
      glue(turned(h[0]), turned(other));
    } else if (two && n == 2) {
      glue(h[0], h[1]);
    } else if (two && n == 4) {
      ++shells_.overlaps;
      glue_edge(h, 2);
      const HalfEdge other = h[3].along != h[2].along ? h[3] : turned(h[3]);
      glue(h[2], other);
      glue(turned(h[2]), turned(other));
    } else if (two && n == 3) {
      const HalfEdge back = turned(h[2]);
      for (const HalfEdge& x : {h[0], h[1]})
        glue(x, x.along != h[2].along ? h[2] : back);
    } else {
      throw ComputationError("the cut body is not closed: an edge joins " + std::to_string(on_surface) +
                             " surface triangles and " + std::to_string(n - on_surface) + " crack triangles");
    }
  }

  void glue(const HalfEdge& x, const HalfEdge& y) {
    faces_.join(x.face, y.face);
    corners_.join(corner(x.face, x.corner), corner(y.face, (y.corner + 1u) % 3));
    corners_.join(corner(x.face, (x.corner + 1u) % 3), corner(y.face, y.corner));
  }

  std::size_t corner(std::size_t face, std::size_t k) const { return corner_of_[3 * face + k]; }

  void number_vertices() {
    const std::size_t n = shells_.corners.size();
    std::vector<std::int32_t> id(corner_count_, -1);
    shells_.vertex.assign(n, {-1, -1, -1});
    std::int32_t count = 0;
    for (std::size_t f = 0; f < n; ++f) {
      if (!shells_.present[f]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        auto& v = id[corners_.root(corner(f, k))];
        if (v < 0) v = count++;
        shells_.vertex[f][k] = v;
      }
    }
    shells_.vertex_count = static_cast<std::size_t>(count);
  }

  double six_volume(std::size_t face, const Vec3& origin) const {
    const auto& c = shells_.corners[face];
    return (cut_.positions[c[0]] - origin)
        .dot(cross(cut_.positions[c[1]] - origin, cut_.positions[c[2]] - origin));
  }

  /// Shells first, then cavities go to the solid around them.
  void number_solids() {
    const std::size_t n = shells_.corners.size();
    std::vector<std::int32_t> shell(n, -1), id(n, -1);
    std::vector<std::size_t> first;
    for (std::size_t f = 0; f < n; ++f) {
      if (!shells_.present[f]) continue;
      auto& s = id[faces_.root(f)];
      if (s < 0) {
        s = static_cast<std::int32_t>(first.size());
        first.push_back(f);
      }
      shell[f] = s;
    }
    const Vec3 origin = n > 0 ? cut_.positions[shells_.corners[0][0]] : Vec3::Zero();
    std::vector<double> volume(first.size(), 0.0);
    double body = 0;
    for (std::size_t f = 0; f < n; ++f)
      if (shell[f] >= 0) {
        const double part = six_volume(f, origin) / 6;
        volume[shell[f]] += part;
        if (f < shells_.surface_faces) body += part;
      }
    // Shells of negative volume are cavities; those without volume are cracks in the inside, unless their
    // other sides belong to another shell: then they are pieces, though empty.
    const double tiny = 1e-11 * body;
    std::vector<bool> faces_another(first.size(), false), cavity(first.size());
    for (std::size_t f = shells_.surface_faces; f < n; ++f)
      if (shell[f] >= 0 && shell[f] != shell[shells_.opposite(f)]) faces_another[shell[f]] = true;
    for (std::size_t s = 0; s < first.size(); ++s)
      cavity[s] = volume[s] < -tiny || (volume[s] <= tiny && !faces_another[s]);
    std::vector<std::int32_t> around(first.size(), -1);
    for (std::size_t s = 0; s < first.size(); ++s)
      if (cavity[s]) {
        around[s] = surrounding(first[s], shell, volume, cavity);
        if (around[s] < 0 && !faces_another[s])
          throw ComputationError(
              "a cavity or an inner crack lies in no piece of the body: is the surface oriented outward?");
      }
    for (std::size_t s = 0; s < first.size(); ++s)
      if (cavity[s] && around[s] < 0)
        cavity[s] = false;  // between layers of a sheet that passes through itself

    std::vector<std::int32_t> solid(first.size(), -1);
    for (std::size_t s = 0; s < first.size(); ++s)
      if (!cavity[s]) {
        solid[s] = static_cast<std::int32_t>(shells_.volume.size());
        shells_.volume.push_back(volume[s]);
      }
    for (std::size_t s = 0; s < first.size(); ++s)
      if (cavity[s]) {
        solid[s] = solid[around[s]];
        shells_.volume[solid[s]] += volume[s];
      }
    shells_.solid.assign(n, -1);
    for (std::size_t f = 0; f < n; ++f)
      if (shell[f] >= 0) shells_.solid[f] = solid[shell[f]];
  }

  /// The smallest shell with material inside that winds around the face (¾ of a full turn: a face in the
  /// shell sees half of one).
  std::int32_t surrounding(std::size_t face, const std::vector<std::int32_t>& shell,
                           const std::vector<double>& volume, const std::vector<bool>& cavity) const {
    std::vector<double> turns(volume.size(), 0.0);
    const auto& c = shells_.corners[face];
    const Vec3 x = (cut_.positions[c[0]] + cut_.positions[c[1]] + cut_.positions[c[2]]) / 3;
    for (std::size_t f = 0; f < shell.size(); ++f) {
      if (shell[f] < 0 || cavity[shell[f]]) continue;
      const auto& t = shells_.corners[f];
      const Vec3 u = cut_.positions[t[0]] - x, v = cut_.positions[t[1]] - x, w = cut_.positions[t[2]] - x;
      const double lu = u.norm(), lv = v.norm(), lw = w.norm();
      turns[shell[f]] +=
          2 * std::atan2(u.dot(cross(v, w)), lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
    }
    std::int32_t best = -1;
    for (std::size_t s = 0; s < volume.size(); ++s)
      if (!cavity[s] && turns[s] > 3 * std::numbers::pi && (best < 0 || volume[s] < volume[best]))
        best = static_cast<std::int32_t>(s);
    return best;
  }

  const CutComplex& cut_;
  std::span<const HalfEdge> halves_;
  std::span<const std::uint32_t> corner_of_;  // see Gluer
  std::size_t corner_count_;
  UnionFind corners_, faces_;
  Shells shells_;
};

/// Whether the triangles at a node make one fan around it, edge by edge.
bool is_one_fan(const CutComplex& cut, NodeId n, std::span<const TriId> star) {
  const auto corner_after = [&](TriId t, std::size_t steps) {
    const auto& c = cut.surface[t];
    return c[(static_cast<std::size_t>(std::find(c.begin(), c.end(), n) - c.begin()) + steps) % 3];
  };
  if (star.empty()) return false;
  TriId at = star[0];
  for (std::size_t step = 0; step < star.size(); ++step) {
    if (step > 0 && at == star[0]) return false;  // round already
    TriId next;
    for (const TriId t : star)
      if (corner_after(t, 1) == corner_after(at, 2)) {
        if (next.valid()) return false;
        next = t;
      }
    if (!next.valid()) return false;
    at = next;
  }
  return at == star[0];
}

/// Per node of the complex whether the sheet does not touch it and the surface makes one fan around it.
std::vector<char> whole_nodes(const CutComplex& cut) {
  constexpr std::size_t nodes_of_task = 2048;
  const NodeLists<TriId> stars = triangles_at_nodes(cut.surface, cut.positions.size());
  std::vector<char> whole(cut.positions.size(), 1);
  for (const auto& c : cut.sheet)
    for (const NodeId n : c)
      whole[n.index()] = 0;
  parallel_for(whole.size(), nodes_of_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      whole[n] = whole[n] && is_one_fan(cut, NodeId(n), stars[NodeId(n)]);
  });
  return whole;
}

}  // namespace

Gluer::Gluer(const CutComplex& cut) : cut_(cut), faces_(cut.surface.size() + 2 * cut.sheet.size()) {
  const std::vector<char> whole = whole_nodes(cut);
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> corner_at(whole.size(), none), face_at(whole.size());  // whole nodes
  corners_.reserve(3 * (cut.surface.size() + 2 * cut.sheet.size()));
  std::uint32_t corners = 0, face = 0;
  for (const auto& c : cut.surface) {
    for (std::uint16_t k = 0; k < 3; ++k) {
      const NodeId n = c[k], next = c[(k + 1u) % 3];
      if (!whole[n.index()] || !whole[next.index()]) halves_.push_back({Edge(n, next), face, k, n < next});
      if (!whole[n.index()]) {
        corners_.push_back(corners++);
        continue;
      }
      if (corner_at[n.index()] == none) {
        corner_at[n.index()] = corners++;
        face_at[n.index()] = face;
      }
      corners_.push_back(corner_at[n.index()]);
      faces_.join(face_at[n.index()], face);
    }
    ++face;
  }
  halves_.reserve(halves_.size() + 3 * cut.sheet.size());
  for (const auto& c : cut.sheet) {
    for (std::uint16_t k = 0; k < 3; ++k)
      halves_.push_back({Edge(c[k], c[(k + 1u) % 3]), face, k, c[k] < c[(k + 1u) % 3]});
    ++face;
  }
  for (std::size_t k = 0; k < 6 * cut.sheet.size(); ++k)  // both sides
    corners_.push_back(corners++);
  corner_count_ = corners;
  sort_by_edge(halves_, cut.positions.size(), [](const HalfEdge& h) { return h.edge; });  // then by face
}

Shells Gluer::glue(const std::vector<bool>& left_out) const {
  return Gluing(cut_, halves_, corners_, corner_count_, faces_, left_out).run();
}

std::size_t count_pieces(const CutComplex& cut) {
  return glue(cut).volume.size();
}

}  // namespace conchoid
