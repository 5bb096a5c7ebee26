#include "conchoid/sim/recorders.hpp"

#include <algorithm>

#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/crack/front/front_frames.hpp"

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

void SampleRecorder::on_opening(const Fracture& fracture) {
  if (!fracture.solved() || fracture.predicts()) return;
  const CrackState& crack = fracture.crack();
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    auto sample = fracture.history().sample(crack, crack.points[i]);
    if (!sample) continue;
    const Vec3& opening = fracture.openings()[i].opening;
    sample->opening = in_frame(fracture.history().find(crack.points[i].correlation)->frame, opening);
    const double size = opening.norm();
    if (size > 0 && size < kLargestOpening * fracture.body().crack_edge) samples_.add(*sample);
  }
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
  folder_.write_frame(fracture.frame(), data);
}

}  // namespace conchoid
