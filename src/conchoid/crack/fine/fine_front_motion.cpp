#include <algorithm>
#include <cmath>

#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/crack/fine/front_smoothing.hpp"
#include "conchoid/crack/front/front_frames.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/length_factors.hpp"

// One sub-step of the markers.
namespace conchoid {

bool FineFront::move_markers(MarkerCurve& curve, const FrontSteps& steps, const GrowthModel& model,
                             const SubStep& part) {
  const std::vector<Toughness>& here = part.here;
  const std::vector<FrontPerturbation> perturbed =
      varied_ ? perturbations(curve, steps, part.smooth) : std::vector<FrontPerturbation>(curve.size());
  std::vector<bool> moves(curve.size(), false);
  std::vector<double> length(curve.size(), 0.0), turn(curve.size(), 0.0), angle(curve.size(), 0.0);
  std::vector<FrontFrame> frame(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    Marker& marker = curve.markers[i];
    if (marker.arrested) continue;
    length[i] = steps.length(marker.parameter, *model.law, here[i].value / perturbed[i].intensity,
                             settings_.resolution) /
                part.per_frame;
    if (!(length[i] > 0)) continue;
    frame[i] = steps.frame(marker.parameter);
    angle[i] = steps.angle(marker.parameter, part.time);
    if (varied_)
      turn[i] = weaker_side({marker.position, length[i], frame[i], angle[i],
                             perturbed[i].intensity * steps.intensity(marker.parameter), perturbed[i].height},
                            here[i], model);
    moves[i] = marker.moved = true;
  }
  if (varied_) smooth_along(curve, moves, turn);
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (moves[i])
      curve.markers[i].position += length[i] * direction_at(frame[i].e1, frame[i].e2, angle[i] + turn[i]);
  return std::find(moves.begin(), moves.end(), true) != moves.end();
}

std::vector<FineFront::FrontPerturbation> FineFront::perturbations(const MarkerCurve& curve,
                                                                   const FrontSteps& steps,
                                                                   const std::vector<Vec3>& smooth) const {
  std::vector<FrontPerturbation> out;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec3 off = (curve.markers[i].position - smooth[i]) / settings_.resolution;
    const FrontFrame frame = steps.frame(curve.markers[i].parameter);
    out.push_back(
        {std::clamp(1 - kShapeStiffness * off.dot(frame.e2), kLeastShapeFactor, kLargestShapeFactor),
         off.dot(frame.e1)});
  }
  return out;
}

/// Where the fall has turned round at the end of the sub-step there is a valley in between: the turn is
/// reduced so as to end there (secant), or the path would zigzag across it.
double FineFront::weaker_side(const Path& path, const Toughness& here, const GrowthModel& model) const {
  const Vec3 across = direction_at(-path.frame.e2, path.frame.e1, path.angle);  // towards growing angles
  const auto fall = [&](const Toughness& at, double height) {
    return -kDeflectionLength * settings_.resolution / at.value * at.gradient.dot(across) -
           kHeightFall * height;
  };
  const double begin = fall(here, path.height);
  const double full = model.law->deflection(begin, path.intensity, here.value);
  if (full == 0) return 0;
  const Vec3 way = path.length * direction_at(path.frame.e1, path.frame.e2, path.angle + full);
  const double end = fall(model.toughness(path.position + way),
                          path.height + path.length * std::sin(full) / settings_.resolution);
  return begin * end < 0 ? full * begin / (begin - end) : full;
}

}  // namespace conchoid
