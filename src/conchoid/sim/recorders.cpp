#include "conchoid/sim/recorders.hpp"

#include <algorithm>

#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/sim/front_pasts.hpp"

namespace conchoid {

void FrontRecorder::on_opening(const Fracture& fracture) {
  const CrackState& crack = fracture.crack();
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontOpening& o = fracture.openings()[i];
    const FrontDecision& d = fracture.decisions()[i];
    FrontRow row;
    row.frame = fracture.frame();
    row.front = point.front;
    row.node = point.node.value;
    row.position = crack.sheet.mesh.positions[point.node] + fracture.body().origin;
    row.intensity = o.intensity;
    row.opening = in_frame(point.frame, o.opening);
    row.speed = fracture.rayleigh_speed() * d.length / fracture.body().crack_edge;
    row.kink_angle = d.angle;
    rows_.push_back(row);
  }
}

void GrowthRecorder::on_opening(const Fracture& fracture) {
  for (const FrontPoint& point : fracture.crack().points)
    largest_ = std::max(largest_, fracture.crack().sheet.travelled[point.node]);
}

FrontSurroundings* SampleRecorder::surroundings(const Fracture& fracture) {
  if (fields_ == Fields::free) return nullptr;
  if (body_ != fracture.shared_body()) {
    body_ = fracture.shared_body();
    surroundings_ = std::make_unique<FrontSurroundings>(*body_);
  }
  return surroundings_.get();
}

void SampleRecorder::on_opening(const Fracture& fracture) {
  const std::vector<FrontOpening>* truth = fracture.truth();
  if (!truth) return;
  const CrackState& crack = fracture.crack();
  FrontSurroundings* around = surroundings(fracture);
  if (around) around->measure(crack, fracture.load(), fracture.loads());
  const std::vector<FrontPast> pasts = front_pasts(crack, fracture.history());
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontPast& past = pasts[i];
    if (past.nodes.empty() || !(past.own || around)) continue;
    const NodeId old = past.nodes[0];
    auto sample = fracture.history().sample(crack, point, old);
    const FrontOpening& now = (*truth)[i];
    if (!sample || (past.own ? now.opening : now.intensity).isZero(0)) continue;
    const FrontHistory::Entry* before = fracture.history().find(old);
    if (before->seen != crack.sheet.frame - 1) continue;
    if (past.own)
      sample->opening = in_frame(before->frame, now.opening);
    else
      sample->node = point.node.value;
    sample->driving_after = now.intensity;
    if (!around || around->complete(crack, i, old, *sample)) samples_.add(*sample);
  }
  if (around) around->remember(crack, fracture.openings());
}

void FrameWriter::on_opening(const Fracture& fracture) {
  const PreparedBody& body = fracture.body();
  const CrackState& crack = fracture.crack();
  FrameData data;
  data.time = fracture.frame() * body.crack_edge / fracture.rayleigh_speed();
  data.body = body.surface;
  data.crack = crack.trimmed;
  for (TriMesh* mesh : {&data.body, &data.crack})
    for (Vec3& x : mesh->positions)
      x += body.origin;
  data.intensity.assign(data.crack.node_count(), Vec3::Zero());
  data.opening.assign(data.crack.node_count(), Vec3::Zero());
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontOpening& o = fracture.openings()[i];
    data.intensity[crack.node_in_cut[crack.points[i].node]] = o.intensity;
    if (const NodeId c = crack.points[i].correlation; c.valid() && crack.node_in_cut[c].valid())
      data.opening[crack.node_in_cut[c]] = o.opening;
  }
  if (fracture.solved()) data.opening = fracture.solution().opening();
  if (fracture.solved() && !body.infinite()) {
    data.displacement = fracture.solution().displacement();
    for (const Vec3& t : fracture.solution().traction())
      data.traction.push_back(t);
    for (const Mat3& s : fracture.solution().surface_stress()) {
      data.stress.push_back(s);
      data.principal_stress.push_back(principal_stress(s).value);
    }
  }
  data.exaggeration = exaggeration_;
  queue_.add([&folder = folder_, frame = fracture.frame(), data = std::move(data)] {
    folder.write_frame(frame, data);
  });
}

}  // namespace conchoid
