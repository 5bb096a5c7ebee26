#include <algorithm>
#include <limits>

#include "conchoid/crack/closing/bridge_triangulation.hpp"
#include "conchoid/crack/closing/front_joint.hpp"
#include "conchoid/crack/closing/touching.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/length_factors.hpp"

// The search for the next two stretches of fronts to join.
namespace conchoid {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A stretch of a front: `count` places from `begin` on, round the ring where it is one.
struct Run {
  std::size_t front = 0, begin = 0, count = 0;
};

/// Places on two fronts that lie opposite each other.
struct Cell {
  std::size_t front, other, i, j;
  auto operator<=>(const Cell&) const = default;
};

class JointFinder {
 public:
  JointFinder(const CrackSheet& sheet, double target_edge)
      : sheet_(sheet), edge_(target_edge), normals_(unit_node_normals(sheet.mesh)) {}

  std::optional<FrontJoint> run(const std::vector<FrontMotion>& motions) const {
    const auto touches = front_touches(sheet_, motions, edge_);
    std::vector<std::vector<Cell>> groups = neighbouring(facing_cells(touches));
    const auto smallest = [&](const std::vector<Cell>& group) {
      NodeId least = front(group[0].front).nodes[group[0].i];
      for (const Cell& c : group)
        least = std::min({least, front(c.front).nodes[c.i], front(c.other).nodes[c.j]});
      return least;
    };
    std::sort(groups.begin(), groups.end(), [&](const auto& x, const auto& y) {
      return x.size() != y.size() ? x.size() > y.size() : smallest(x) < smallest(y);
    });
    for (const std::vector<Cell>& group : groups)
      if (auto joint = joint_of(group)) return joint;
    if (auto joint = narrow_bay(motions)) return joint;
    return narrow_corner(motions);
  }

 private:
  /// A last ligament at the body's surface: the front is inside at a few nodes only, between two outside.
  std::optional<FrontJoint> narrow_bay(const std::vector<FrontMotion>& motions) const {
    const auto moves = moving(motions);
    for (std::size_t f = 0; f < sheet_.fronts.size(); ++f) {
      const std::size_t n = size(f);
      if (n < kLastLigamentNodes + 3) continue;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t begin = next_index(i, n, front(f).closed);
        if (begin == i || is_inside(front(f).nodes[i]) || !is_inside(front(f).nodes[begin])) continue;
        Run run{f, i, 2};
        bool any = false;
        while (run.count <= kLastLigamentNodes + 1 && (front(f).closed || i + run.count < n) &&
               is_inside(node(run, run.count - 1))) {
          any = any || moves[node(run, run.count - 1).index()];
          ++run.count;
        }
        if (!any || is_inside(node(run, run.count - 1)) || !opens(run)) continue;
        if (auto joint = split(f, run, kLongestBridgeOutside)) return joint;
      }
    }
    return std::nullopt;
  }

  /// Whether the front turns inwards somewhere between the ends of a stretch; what runs straight across a
  /// corner of the body goes on by itself.
  bool opens(const Run& run) const {
    const SheetFront& f = front(run.front);
    const std::vector<FrontFrame> frames = front_frames(sheet_, f);
    for (std::size_t k = 1; k + 1 < run.count; ++k) {
      const std::size_t i = (run.begin + k) % f.nodes.size();
      if (opening_angle(sheet_, f, frames[i], i) < kLastLigamentWedge) return true;
    }
    return false;
  }

  std::vector<bool> moving(const std::vector<FrontMotion>& motions) const {
    std::vector<bool> moves(sheet_.mesh.node_count(), false);
    for (const FrontMotion& motion : motions)
      moves[motion.node.index()] = true;
    return moves;
  }

  /// Of all corners the one at the node with the smallest id: the same for every walk along the front.
  std::optional<FrontJoint> narrow_corner(const std::vector<FrontMotion>& motions) const {
    const auto moves = moving(motions);
    std::optional<FrontJoint> found;
    const auto area_vectors = node_area_vectors(sheet_.mesh);
    for (const SheetFront& front : sheet_.fronts) {
      const std::size_t n = front.nodes.size();
      if (n < 4) continue;
      const std::vector<FrontFrame> frames = front_frames(sheet_, front, area_vectors);
      for (std::size_t i = 0; i < n; ++i) {
        const NodeId before = front.nodes[previous_index(i, n, front.closed)], node = front.nodes[i];
        const NodeId after = front.nodes[next_index(i, n, front.closed)];
        if (!moves[before.index()] || !moves[after.index()] || sheet_.state[node] == FrontState::outside)
          continue;
        if (opening_angle(sheet_, front, frames[i], i) > kBridgedWedge) continue;
        if ((position(before) - position(after)).norm() > kWidestLigament * edge_) continue;
        const FrontJoint joint{{before, node}, {node, after}};
        if (sound(joint) && (!found || node < found->first.back())) found = joint;
      }
    }
    return found;
  }

  const SheetFront& front(std::size_t f) const { return sheet_.fronts[f]; }
  std::size_t size(std::size_t f) const { return front(f).nodes.size(); }
  bool is_inside(NodeId n) const { return sheet_.state[n] != FrontState::outside; }
  const Vec3& position(NodeId n) const { return sheet_.mesh.positions[n]; }
  NodeId node(const Run& run, std::size_t k) const {
    return front(run.front).nodes[(run.begin + k) % size(run.front)];
  }

  std::vector<Cell> facing_cells(const std::vector<FrontTouch>& touches) const {
    std::vector<Cell> cells;
    for (const FrontTouch& t : touches) {
      if (t.gap > kWidestLigament * edge_ || !is_inside(front(t.front).nodes[t.index])) continue;
      for (const std::size_t j : {t.edge, next_index(t.edge, size(t.other), front(t.other).closed)}) {
        if (normals_[front(t.front).nodes[t.index]].dot(normals_[front(t.other).nodes[j]]) < kAlikeSheets)
          continue;
        const bool order = t.front != t.other ? t.front < t.other : t.index < j;
        cells.push_back(order ? Cell{t.front, t.other, t.index, j} : Cell{t.other, t.front, j, t.index});
      }
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

  bool next_to(std::size_t f, std::size_t a, std::size_t b) const {
    const std::size_t d = a > b ? a - b : b - a;
    return d <= 1 || (front(f).closed && d + 1 == size(f));
  }

  /// Cells whose places follow each other on both fronts.
  std::vector<std::vector<Cell>> neighbouring(const std::vector<Cell>& cells) const {
    std::vector<bool> taken(cells.size(), false);
    std::vector<std::vector<Cell>> groups;
    for (std::size_t start = 0; start < cells.size(); ++start) {
      if (taken[start]) continue;
      std::vector<Cell> group{cells[start]};
      taken[start] = true;
      for (std::size_t k = 0; k < group.size(); ++k)
        for (std::size_t c = start + 1; c < cells.size(); ++c) {
          const Cell &x = group[k], &y = cells[c];
          if (taken[c] || x.front != y.front || x.other != y.other || !next_to(x.front, x.i, y.i) ||
              !next_to(x.other, x.j, y.j))
            continue;
          taken[c] = true;
          group.push_back(y);
        }
      groups.push_back(std::move(group));
    }
    return groups;
  }

  /// The places as one stretch; none if they go all the way round a ring.
  std::optional<Run> run_of(std::size_t f, std::vector<std::size_t> places) const {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    if (front(f).closed && places.size() >= size(f)) return std::nullopt;
    std::size_t begin = places.front();
    for (std::size_t k = 1; k < places.size(); ++k)
      if (places[k] != places[k - 1] + 1) begin = places[k];
    return Run{f, begin, places.size()};
  }

  /// Places from the end of one stretch to the beginning of the next on the same front; more than a pocket
  /// where there is no way.
  std::size_t between(const Run& a, const Run& b) const {
    const std::size_t n = size(a.front), end = a.begin + a.count;
    if (b.begin >= end) return b.begin - end;
    return front(a.front).closed && b.begin + n >= end ? b.begin + n - end : kPocketNodes + 1;
  }

  std::optional<FrontJoint> joint_of(const std::vector<Cell>& group) const {
    const std::size_t f = group[0].front, g = group[0].other;
    std::vector<std::size_t> is, js;
    for (const Cell& c : group) {
      is.push_back(c.i);
      js.push_back(c.j);
    }
    std::optional<Run> first = run_of(f, is), second = run_of(g, js);
    if (!first || !second) return std::nullopt;
    if (f == g) {
      is.insert(is.end(), js.begin(), js.end());
      const std::optional<Run> all = run_of(f, is);
      if (!all || all->count < first->count + second->count || is_one_run(f, is)) return split(f, all);
    }
    lengthen(*first, *second);
    lengthen(*second, *first);
    FrontJoint joint{nodes_of(*first), nodes_of(*second)};
    const std::size_t ahead = f == g ? between(*first, *second) : kPocketNodes + 1;
    const std::size_t behind = f == g ? between(*second, *first) : kPocketNodes + 1;
    if (ahead <= kPocketNodes) take_pocket(*first, ahead, joint.first, joint.second);
    if (behind <= kPocketNodes) take_pocket(*second, behind, joint.second, joint.first);
    if (ahead > kPocketNodes) trim(joint.first, joint.second);
    if (behind > kPocketNodes) trim(joint.second, joint.first);
    if (ahead > kPocketNodes) reach_outside(*first, *second, joint.first, joint.second);
    if (behind > kPocketNodes) reach_outside(*second, *first, joint.second, joint.first);
    return sound(joint) ? std::optional(joint) : std::nullopt;
  }

  bool is_one_run(std::size_t f, std::vector<std::size_t> places) const {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::size_t breaks = front(f).closed && (places.front() != 0 || places.back() + 1 != size(f)) ? 1 : 0;
    for (std::size_t k = 1; k < places.size(); ++k)
      breaks += places[k] != places[k - 1] + 1 ? 1 : 0;
    return front(f).closed ? breaks <= 1 : breaks == 0;
  }

  /// Both sides of one stretch that folds on itself, at its middle; of a whole ring, at its two nodes
  /// farthest from each other.
  std::optional<FrontJoint> split(std::size_t f, const std::optional<Run>& all,
                                  double longest = kLongestBridgeEdge) const {
    const auto& nodes = front(f).nodes;
    FrontJoint joint;
    if (all) {
      const std::vector<NodeId> run = nodes_of(*all);
      if (run.size() < 3) return std::nullopt;
      auto middle = static_cast<std::ptrdiff_t>(run.size() / 2);
      if (run.size() % 2 == 0 && run[middle - 1] < run[middle]) --middle;
      joint.first.assign(run.begin(), run.begin() + middle + 1);
      joint.second.assign(run.begin() + middle, run.end());
    } else {
      std::size_t a = 0, b = 0;
      double farthest = -1;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = i + 1; j < nodes.size(); ++j)
          if (const double d = (position(nodes[i]) - position(nodes[j])).norm(); d > farthest) {
            farthest = d;
            a = i;
            b = j;
          }
      joint.first = nodes_of({f, a, b - a + 1});
      joint.second = nodes_of({f, b, nodes.size() - (b - a) + 1});
    }
    return sound(joint, longest) ? std::optional(joint) : std::nullopt;
  }

  std::vector<NodeId> nodes_of(const Run& run) const {
    std::vector<NodeId> out;
    for (std::size_t k = 0; k < run.count; ++k)
      out.push_back(node(run, k));
    return out;
  }

  /// A stretch of a single node takes its neighbour nearer to the other stretch along.
  void lengthen(Run& run, const Run& other) const {
    const std::size_t n = size(run.front);
    if (run.count > 1 || n < 2) return;
    const auto apart = [&](std::size_t place) {
      double least = kNever;
      for (const NodeId x : nodes_of(other)) {
        const NodeId at = front(run.front).nodes[place];
        if (x == at) return kNever;
        least = std::min(least, (position(x) - position(at)).norm());
      }
      return least;
    };
    const bool closed = front(run.front).closed;
    const std::size_t before = previous_index(run.begin, n, closed), after = next_index(run.begin, n, closed);
    const double back = before == run.begin ? kNever : apart(before);
    const double on = after == run.begin ? kNever : apart(after);
    if (back == kNever && on == kNever) return;
    if (back < on) run.begin = before;
    run.count = 2;
  }

  /// The `count` nodes that follow `run` up to the other stretch are divided among both, who share the one in
  /// the middle.
  void take_pocket(const Run& run, std::size_t count, std::vector<NodeId>& nodes,
                   std::vector<NodeId>& other) const {
    std::size_t tip = (count + 1) / 2;  // 0: the last node of the run itself
    if (count % 2 == 0 && node(run, run.count + tip) < node(run, run.count - 1 + tip)) ++tip;
    std::vector<NodeId> rest;
    for (std::size_t k = 1; k <= count; ++k)
      (k <= tip ? nodes : rest).push_back(node(run, run.count - 1 + k));
    rest.insert(rest.begin(), nodes.back());
    other.insert(other.begin(), rest.begin(), rest.end());
  }

  /// At the ends nodes.back() and others.front(): nodes too far from the other side are left out, and those
  /// by which a stretch runs away from it.
  void trim(std::vector<NodeId>& nodes, std::vector<NodeId>& others) const {
    const auto apart = [&](NodeId a, NodeId b) { return (position(a) - position(b)).norm(); };
    const auto runs_away = [&](NodeId end, NodeId before, NodeId other) {
      return (position(end) - position(before)).dot(position(other) - position(before)) <
             kRunningAway * apart(end, before) * apart(other, before);
    };
    while (nodes.size() > 1 && others.size() > 1) {
      const NodeId end = nodes.back(), before = nodes[nodes.size() - 2];
      const NodeId other = others.front(), before_other = others[1];
      const bool away = runs_away(end, before, other), other_away = runs_away(other, before_other, end);
      if (!away && !other_away && apart(end, other) < kWidestLigament * edge_) return;
      const bool drop = away != other_away ? away : apart(before, other) <= apart(end, before_other);
      if (drop)
        nodes.pop_back();
      else
        others.erase(others.begin());
    }
  }

  /// At the ends first.back() and second.front(): on to the first node outside of the body.
  void reach_outside(const Run& run, const Run& other, std::vector<NodeId>& nodes,
                     std::vector<NodeId>& others) const {
    const auto& own = front(run.front).nodes;
    const auto& theirs = front(other.front).nodes;
    const auto place = [](const std::vector<NodeId>& ring, NodeId n) {
      return static_cast<std::size_t>(std::find(ring.begin(), ring.end(), n) - ring.begin());
    };
    const NodeId after = own[next_index(place(own, nodes.back()), own.size(), front(run.front).closed)];
    const NodeId before =
        theirs[previous_index(place(theirs, others.front()), theirs.size(), front(other.front).closed)];
    const auto near = [&](NodeId a, NodeId b) {
      return (position(a) - position(b)).norm() < kLongestBridgeEdge * edge_;
    };
    const bool in = is_inside(nodes.back()), other_in = is_inside(others.front());
    if (after == before || (in && is_inside(after)) || (other_in && is_inside(before))) return;
    if (!near(in ? after : nodes.back(), other_in ? before : others.front())) return;
    if (in) nodes.push_back(after);
    if (other_in) others.insert(others.begin(), before);
  }

  bool sound(const FrontJoint& joint, double longest = kLongestBridgeEdge) const;

  const CrackSheet& sheet_;
  double edge_;
  IdVector<NodeId, Vec3> normals_;
};

bool JointFinder::sound(const FrontJoint& joint, double longest) const {
  if (joint.first.size() < 2 || joint.second.size() < 2) return false;
  std::vector<NodeId> all = joint.first;
  all.insert(all.end(), joint.second.begin(), joint.second.end());
  std::sort(all.begin(), all.end());
  const auto twice = static_cast<std::size_t>(all.end() - std::unique(all.begin(), all.end()));
  const std::size_t shared = (joint.first.back() == joint.second.front() ? 1 : 0) +
                             (joint.first.front() == joint.second.back() ? 1 : 0);
  if (twice != shared) return false;
  const auto triangles = triangles_between(sheet_.mesh.positions, normals_, joint.first, joint.second);
  const auto close = [&](NodeId a, NodeId b) { return (position(a) - position(b)).norm() < longest * edge_; };
  return !triangles.empty() && std::all_of(triangles.begin(), triangles.end(), [&](const auto& t) {
    return !folds(sheet_.mesh.positions, normals_, t) && close(t[0], t[1]) && close(t[1], t[2]) &&
           close(t[2], t[0]);
  });
}

}  // namespace

std::optional<FrontJoint> find_joint(const CrackSheet& sheet, const std::vector<FrontMotion>& motions,
                                     double target_edge) {
  auto joint = JointFinder(sheet, target_edge).run(motions);
  // The same way round for every walk along the fronts.
  const auto sorted = [](std::vector<NodeId> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  if (joint && sorted(joint->second) < sorted(joint->first)) std::swap(joint->first, joint->second);
  return joint;
}

}  // namespace conchoid
