#include "conchoid/crack/fine/fine_front.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/fine/front_smoothing.hpp"
#include "conchoid/crack/fine/subdivide.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/front/strip.hpp"
#include "conchoid/crack/length_factors.hpp"

namespace conchoid {

namespace {

double mean_front_edge(const TriMesh& mesh, const SheetFront& front) {
  const std::size_t n = front.nodes.size(), edges = edge_count(n, front.closed);
  double sum = 0;
  for (std::size_t i = 0; i < edges; ++i)
    sum +=
        (mesh.positions[front.nodes[next_index(i, n, front.closed)]] - mesh.positions[front.nodes[i]]).norm();
  return edges > 0 ? sum / static_cast<double>(edges) : 0;
}

MarkerCurve initial_curve(const TriMesh& surface, const Subdivision& fine, const SheetFront& coarse) {
  MarkerCurve curve;
  curve.closed = coarse.closed;
  const auto add = [&](NodeId node, NodeId attached) {
    Marker marker;
    marker.node = node;
    marker.position = surface.positions[node];
    marker.coarse = attached;
    curve.markers.push_back(marker);
  };
  const std::size_t n = coarse.nodes.size();
  for (std::size_t i = 0; i < edge_count(n, coarse.closed); ++i) {
    const auto along = fine.along(coarse.nodes[i], coarse.nodes[next_index(i, n, coarse.closed)]);
    for (std::size_t k = 0; k < along.size(); ++k)
      add(along[k], k == 0 ? coarse.nodes[i] : NodeId());
  }
  if (!coarse.closed) add(fine.corner(coarse.nodes.back()), coarse.nodes.back());
  return curve;
}

/// Middle of the curve's edge (a, b) by the cubic through four points, of a run of several nodes the mean of
/// its ends.
Vec3 smooth_middle(const StripCurve& curve, std::size_t a, std::size_t b) {
  const std::size_t n = curve.nodes.size();
  const auto at = [&](std::size_t i) -> const Vec3& { return curve.target[i]; };
  const std::size_t before = previous_index(a, n, curve.closed), after = next_index(b, n, curve.closed);
  const Vec3 middle = 0.5 * (at(a) + at(b));
  if (next_index(a, n, curve.closed) != b || before == a || after == b) return middle;
  return middle + 0.125 * (middle - 0.5 * (at(before) + at(after)));
}

std::size_t index_of(const MarkerCurve& curve, NodeId coarse) {
  const auto at = std::find_if(curve.markers.begin(), curve.markers.end(),
                               [&](const Marker& m) { return m.coarse == coarse; });
  return static_cast<std::size_t>(at - curve.markers.begin());
}

/// The marker at a node of the new row.
Marker marker_of(const StripNode& node, const MarkerCurve& old, const TriMesh& surface,
                 const std::vector<bool>& wanted, double period) {
  Marker marker = old.markers[node.first];
  const Marker& last = old.markers[node.last];
  const Vec3& x = surface.positions[node.id];
  switch (node.kind) {
    case StripNode::Kind::kept:
      if (wanted[node.first]) marker.position = x;  // it could not leave a sound row: held back
      return marker;
    case StripNode::Kind::moved:
      break;
    case StripNode::Kind::merged:
      for (std::size_t i = node.first; i != node.last;) {
        i = old.next(i);
        const bool attached = old.markers[i].coarse.valid();
        if (attached || (!marker.coarse.valid() && old.markers[i].node < marker.node))
          marker = old.markers[i];
      }
      break;
    case StripNode::Kind::inserted: {
      const double to = last.parameter < marker.parameter ? last.parameter + period : last.parameter;
      marker.parameter += node.s * (to - marker.parameter);
      marker.coarse = NodeId();
      marker.arrested = marker.arrested && last.arrested;
      break;
    }
  }
  marker.node = node.id;
  marker.position = x;
  return marker;
}

}  // namespace

FineFront::FineFront(const CrackSheet& sheet, const FineFrontSettings& settings)
    : settings_(settings),
      longest_spacing_(0),
      faces_(2 * std::min(settings.spacing, settings.resolution / 4)) {
  settings_.spacing = std::min(settings.spacing, settings.resolution / 4);
  longest_spacing_ = kLongestSpacing * settings_.spacing;
  append_parts(sheet);
}

void FineFront::append_parts(const CrackSheet& sheet) {
  if (known_triangles_ == sheet.mesh.triangle_count()) return;
  double edge = 0;
  for (std::size_t f = curves_.size(); f < sheet.fronts.size(); ++f)
    edge = std::max(edge, mean_front_edge(sheet.mesh, sheet.fronts[f]));
  const int parts =
      std::clamp(static_cast<int>(std::ceil(edge / settings_.spacing - kRoundOff)), 1, kInitialDivisions);
  const Subdivision fine(sheet.mesh, known_triangles_, parts, surface_);
  const std::vector<int> connected = connected_parts(surface_);
  std::map<int, int> part;  // numbers that no earlier part has
  const auto part_of = [&](NodeId node) {
    const auto [at, added] = part.try_emplace(connected[node.index()], next_part_);
    next_part_ += added ? 1 : 0;
    return at->second;
  };
  for (std::size_t f = curves_.size(); f < sheet.fronts.size(); ++f) {
    curves_.push_back(initial_curve(surface_, fine, sheet.fronts[f]));
    const MarkerCurve& curve = curves_.back();
    for (std::size_t i = 0; i < curve.size(); ++i)
      longest_spacing_ = std::max(longest_spacing_, curve.spacing(i));
    curves_.back().part = part_of(curve.markers.front().node);
  }
  for (std::size_t t = birth_.size(); t < surface_.triangle_count(); ++t)
    faces_.take(surface_, TriId(t), part_of(surface_.corners[TriId(t)][0]));
  birth_.resize(surface_.triangle_count(), sheet.frame);
  known_triangles_ = sheet.mesh.triangle_count();
}

std::vector<FrontMotion> FineFront::advance(const CrackSheet& sheet, const std::vector<FrontStep>& steps,
                                            const GrowthModel& model) {
  return advance(sheet, steps, model, nullptr);
}

void FineFront::advance(const CrackSheet& sheet, const std::vector<FrontStep>& steps,
                        const GrowthModel& model, const FineFront& driving) {
  advance(sheet, steps, model, &driving.tracks_);
}

std::vector<FrontMotion> FineFront::advance(const CrackSheet& sheet, const std::vector<FrontStep>& given,
                                            const GrowthModel& model,
                                            const std::vector<FrontTrack>* driving) {
  append_parts(sheet);
  frame_ = sheet.frame + 1;
  std::unordered_map<NodeId, FrontStep> step_of;
  for (const FrontStep& step : given)
    step_of.emplace(step.node, step);
  const auto normals = node_area_vectors(sheet.mesh);
  std::vector<FrontMotion> motions;
  tracks_.assign(curves_.size(), {});
  for (std::size_t f = 0; f < curves_.size(); ++f) {
    FrontSteps steps(sheet, sheet.fronts[f], normals, step_of);
    if (settings_.smooth_angles) steps.smooth_angles();
    MarkerCurve& curve = curves_[f];
    if (driving) reattach_nodes(curve, steps.nodes(), sheet.mesh.positions);
    set_parameters(curve, steps.nodes());
    for (Marker& marker : curve.markers) {
      marker.moved = false;
      if (driving && marker.at_own_face) marker.arrested = marker.at_own_face = false;
    }
    std::vector<bool> inside;  // per edge of the coarse front: not both of its nodes are outside
    for (std::size_t k = 0; k < steps.size(); ++k)
      inside.push_back(sheet.state[steps.nodes()[k]] != FrontState::outside ||
                       sheet.state[steps.nodes()[next_index(k, steps.size(), steps.closed())]] !=
                           FrontState::outside);
    sweep(curve, steps, inside, model, tracks_[f], driving ? &(*driving)[f] : nullptr);
    if (!driving) append_motions(sheet, curve, steps, motions);
  }
  return motions;
}

void FineFront::sweep(MarkerCurve& curve, const FrontSteps& steps, const std::vector<bool>& inside,
                      const GrowthModel& model, FrontTrack& track, const FrontTrack* driving) {
  const auto smooth_front = [&](double time) {
    if (!driving || driving->empty()) return smoothed_positions(curve, settings_.resolution);
    std::vector<Vec3> on_track;
    for (const Marker& marker : curve.markers)
      on_track.push_back(driving->at(marker.parameter, time));
    return on_track;
  };
  const double divided = settings_.resolution / settings_.spacing / settings_.sub_steps;
  const int parts = std::clamp(static_cast<int>(std::ceil(divided - kRoundOff)), 1, kSubStepParts);
  const int count = parts * settings_.sub_steps;
  for (int step = 0; step < count; ++step) {
    const double begin = static_cast<double>(step) / count;
    SubStep part;
    part.per_frame = count;
    part.time = (step + 0.5) / count;
    std::vector<Vec3> from;
    for (const Marker& marker : curve.markers) {
      from.push_back(marker.position);
      part.here.push_back(model.toughness(marker.position));
      varied_ = varied_ || !part.here.back().gradient.isZero(0);
    }
    if (varied_) {
      part.smooth = smooth_front(begin);
      track.add(begin, curve, part.smooth, steps.size());
    }
    if (!move_markers(curve, steps, model, part)) continue;
    stop_at_faces(curve, from, inside);
    leave_row(curve, kRowDistance * settings_.spacing);
  }
  if (varied_) track.add(1, curve, smooth_front(1), steps.size());
}

void FineFront::stop_at_faces(MarkerCurve& curve, const std::vector<Vec3>& from,
                              const std::vector<bool>& inside) const {
  const double h = settings_.spacing;
  const auto stop_at_face = [&](std::size_t i) {
    Marker& marker = curve.markers[i];
    const Vec3 way = marker.position - from[i];
    const auto edge = static_cast<std::size_t>(std::max(0.0, marker.parameter));
    if (marker.arrested || way.isZero(0) || (edge < inside.size() && !inside[edge])) return;
    std::array<NodeId, 2 * (kOwnMarkers + 1)> own;
    for (std::size_t k = 0, a = i, b = i; k <= kOwnMarkers; ++k) {
      own[2 * k] = curve.markers[a].node;
      own[2 * k + 1] = curve.markers[b].node;
      a = curve.previous(a);
      b = curve.next(b);
    }
    std::sort(own.begin(), own.end());
    const Vec3 ahead = marker.position + kFaceDistance * h * way.normalized();
    const auto hit = faces_.first_hit(surface_, from[i], ahead, own);
    if (!hit) return;
    const double length = (ahead - from[i]).norm(), at = hit->fraction * length;
    if (hit->part != curve.part && at > (1 + kRoundOff) * way.norm()) return;  // not there yet
    marker.arrested = true;
    marker.at_own_face = hit->part == curve.part;
    const double stop =
        hit->part == curve.part ? std::max(0.0, at - kFaceDistance * h) : at + kFaceDistance * h;
    marker.position = from[i] + std::min(stop, length) * way.normalized();
  };
  parallel_for(curve.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      stop_at_face(i);
  });
}

std::vector<NodeId> FineFront::stopped_nodes() const {
  std::vector<NodeId> out;
  for (const MarkerCurve& curve : curves_)
    for (const Marker& marker : curve.markers)
      if (marker.arrested && marker.coarse.valid()) out.push_back(marker.coarse);
  return out;
}

void FineFront::leave_row(MarkerCurve& curve, double least) {
  StripCurve row;
  row.closed = curve.closed;
  bool any = false;
  for (const Marker& marker : curve.markers) {
    row.nodes.push_back(marker.node);
    row.target.push_back(marker.position);
    row.moved.push_back((marker.position - surface_.positions[marker.node]).norm() >= least);
    row.pinned.push_back(marker.coarse.valid());
    any = any || row.moved.back();
  }
  if (!any) return;
  const double h = settings_.spacing;
  const StripSettings strip_settings{kLongestSpacing * h, kShortestSpacing * h, kShortestSpacing * h,
                                     [&](std::size_t a, std::size_t b, double s) {
                                       if (s != 0.5) return Vec3((1 - s) * row.target[a] + s * row.target[b]);
                                       return smooth_middle(row, a, b);
                                     }};
  const Strip strip = append_strip(surface_, row, strip_settings);
  for (std::size_t t = birth_.size(); t < surface_.triangle_count(); ++t)
    faces_.take(surface_, TriId(t), curve.part);
  birth_.resize(surface_.triangle_count(), frame_);
  double period = 0;
  for (const Marker& marker : curve.markers)
    period = std::max(period, std::floor(marker.parameter) + 1);
  MarkerCurve next;
  next.closed = curve.closed;
  next.part = curve.part;
  for (const StripNode& node : strip.curve)
    next.markers.push_back(marker_of(node, curve, surface_, row.moved, period));
  curve = std::move(next);
}

/// A marker moved in this frame if its coarse node did; a coarse node without a marker follows the curve, and
/// where the fine front has closed already the coarse one closes on its centre.
void FineFront::append_motions(const CrackSheet& sheet, MarkerCurve& curve, const FrontSteps& steps,
                               std::vector<FrontMotion>& motions) const {
  std::unordered_set<NodeId> held;  // coarse nodes that wait in tough material
  for (const Marker& marker : curve.markers)
    if (varied_ && marker.coarse.valid() && !marker.moved) held.insert(marker.coarse);
  std::vector<bool> moves;
  Vec3 center = Vec3::Zero();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    moves.push_back(steps.moves(k) && !held.contains(steps.nodes()[k]));
    center += sheet.mesh.positions[steps.nodes()[k]] / static_cast<double>(steps.size());
  }
  slide_attached_nodes(curve, steps.nodes(), moves);
  std::unordered_map<NodeId, Vec3> position;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.markers[i].coarse.valid()) position.emplace(curve.markers[i].coarse, coarse_position(curve, i));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (!moves[k]) continue;
    const NodeId node = steps.nodes()[k];
    const auto at = position.find(node);
    Vec3 to = center;
    if (!curve.markers.empty())
      to = at != position.end() ? at->second : point_at(curve, static_cast<double>(k), steps.size());
    const Vec3 displacement = to - sheet.mesh.positions[node];
    if (!displacement.isZero(0)) motions.push_back({node, displacement});
  }
}

Vec3 FineFront::coarse_position(const MarkerCurve& curve, std::size_t i) const {
  return varied_ ? smoothed_position(curve, i, settings_.resolution) : curve.markers[i].position;
}

std::optional<Vec3> FineFront::between(NodeId a, NodeId b, double s) const {
  for (const MarkerCurve& curve : curves_) {
    const std::size_t i = index_of(curve, a), j = index_of(curve, b);
    if (i < curve.size() && j < curve.size())
      return coarse_position(curve, marker_between(curve, i, j, s, true));
  }
  return std::nullopt;
}

void FineFront::adopt(const CrackSheet& sheet, const AdvanceResult& result) {
  std::vector<MarkerCurve> kept;
  for (std::size_t f = 0; f < curves_.size(); ++f) {
    if (result.succession[f].empty()) {
      close(curves_[f]);
      continue;
    }
    follow(curves_[f], result.succession[f]);
    kept.push_back(std::move(curves_[f]));
  }
  curves_ = std::move(kept);
  known_triangles_ = sheet.mesh.triangle_count();
}

void FineFront::follow(MarkerCurve& curve, const std::vector<FrontSuccession>& succession) const {
  std::unordered_map<NodeId, std::size_t> at;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (curve.markers[i].coarse.valid()) at.emplace(curve.markers[i].coarse, i);
  std::vector<NodeId> attached(curve.size());
  for (const FrontSuccession& s : succession) {
    const auto first = at.find(s.first), last = at.find(s.last);
    if (first == at.end() || last == at.end()) continue;
    std::size_t marker = first->second;
    if (s.kind == FrontSuccession::Kind::merged)
      marker = marker_between(curve, first->second, last->second, 0.5, true);
    if (s.kind == FrontSuccession::Kind::inserted)
      marker = marker_between(curve, first->second, last->second, s.s, false);
    if (!attached[marker].valid()) attached[marker] = s.node;
  }
  for (std::size_t i = 0; i < curve.size(); ++i)
    curve.markers[i].coarse = attached[i];
}

void FineFront::close(MarkerCurve& curve) {
  if (curve.size() < 3) return;
  Vec3 center = Vec3::Zero();
  for (const Marker& marker : curve.markers)
    center += surface_.positions[marker.node] / static_cast<double>(curve.size());
  const NodeId tip = surface_.positions.add(center);
  for (std::size_t i = 0; i < curve.size(); ++i)
    surface_.corners.push_back({curve.markers[curve.next(i)].node, curve.markers[i].node, tip});
  for (std::size_t t = birth_.size(); t < surface_.triangle_count(); ++t)
    faces_.take(surface_, TriId(t), curve.part);
  birth_.resize(surface_.triangle_count(), frame_);
}

void FineFront::finish() {
  for (MarkerCurve& curve : curves_)
    leave_row(curve, kLastRowDistance * settings_.spacing);
}

}  // namespace conchoid
