#include "conchoid/sim/crack_state.hpp"

#include <algorithm>
#include <set>

#include "conchoid/bem/cracked_body.hpp"

namespace conchoid {
namespace {

// Distance of x behind the front at node a: across the front's tangent.
double distance_behind(const Vec3& front, const FrontFrame& frame, const Vec3& x) {
  const Vec3 d = x - front;
  return (d - d.dot(frame.e3) * frame.e3).norm();
}

}  // namespace

void update_crack(CrackState& state, const TriMesh& surface) {
  const bool infinite = surface.corners.empty();
  state.cut = infinite ? uncut_sheet(state.sheet.mesh) : corefine(surface, state.sheet.mesh, {kMouthMerge});
  state.trimmed = {state.cut.positions, state.cut.sheet};
  state.fronts = find_fronts(state.trimmed, state.cut.mouth);
  std::vector<char> on_mouth(state.cut.positions.size(), 0), used(state.cut.positions.size(), 0);
  for (const Edge& e : state.cut.mouth)
    on_mouth[e.a.index()] = on_mouth[e.b.index()] = 1;
  for (const auto& c : state.cut.sheet)
    for (NodeId node : c)
      used[node.index()] = 1;
  state.node_in_cut.assign(state.sheet.mesh.node_count(), NodeId{});
  for (std::size_t i = 0; i < state.cut.positions.size(); ++i) {
    const NodeId of_sheet = state.cut.sheet_node[NodeId(i)];
    if (of_sheet.valid() && used[i] && !on_mouth[i]) state.node_in_cut[of_sheet] = NodeId(i);
  }
  state.points.clear();
  for (std::size_t f = 0; f < state.sheet.fronts.size(); ++f) {
    const SheetFront& front = state.sheet.fronts[f];
    const std::vector<FrontFrame> frames = front_frames(state.sheet, front);
    for (std::size_t k = 0; k < front.nodes.size(); ++k) {
      const NodeId node = front.nodes[k];
      const bool inside = state.node_in_cut[node].valid();
      FrontState& mark = state.sheet.state[node];
      if (mark != FrontState::arrested) mark = inside ? FrontState::active : FrontState::outside;
      if (!inside) continue;
      FrontPoint point{node, state.sheet.correlation[node], frames[k], 0, static_cast<int>(f)};
      if (point.correlation.valid())
        point.distance = distance_behind(state.sheet.mesh.positions[node], frames[k],
                                         state.sheet.mesh.positions[point.correlation]);
      state.points.push_back(point);
    }
  }
}

std::vector<FrontPoint> ligament_points(const CrackState& state) {
  std::set<std::size_t> parents;  // sheet triangles with a piece of front that has no node of the sheet
  for (const Front& front : state.fronts) {
    const bool has_node = std::any_of(front.nodes.begin(), front.nodes.end(), [&](NodeId node) {
      const NodeId of_sheet = state.cut.sheet_node[node];
      return of_sheet.valid() && state.node_in_cut[of_sheet].valid();
    });
    if (has_node) continue;
    for (std::size_t t = 0; t < state.cut.sheet.size(); ++t) {
      const auto& c = state.cut.sheet[TriId(t)];
      const auto on_front = std::count_if(c.begin(), c.end(), [&](NodeId node) {
        return std::find(front.nodes.begin(), front.nodes.end(), node) != front.nodes.end();
      });
      if (on_front >= 2) parents.insert(state.cut.sheet_parent[t].index());
    }
  }
  std::vector<FrontPoint> points;
  for (std::size_t f = 0; f < state.sheet.fronts.size(); ++f) {
    const SheetFront& front = state.sheet.fronts[f];
    const std::vector<FrontFrame> frames = front_frames(state.sheet, front);
    for (std::size_t k = 0; k < front.nodes.size(); ++k) {
      const NodeId node = front.nodes[k];
      if (state.sheet.state[node] != FrontState::outside) continue;
      const bool wanted = std::any_of(parents.begin(), parents.end(), [&](std::size_t t) {
        const auto& c = state.sheet.mesh.corners[TriId(t)];
        return std::find(c.begin(), c.end(), node) != c.end();
      });
      if (wanted) points.push_back({node, {}, frames[k], 0, static_cast<int>(f)});
    }
  }
  return points;
}

}  // namespace conchoid
