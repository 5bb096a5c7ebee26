#include "conchoid/sim/reports.hpp"

#include <algorithm>

#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/stopwatch.hpp"
#include "conchoid/sim/body_elements.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "conchoid/sim/resolution_warnings.hpp"

namespace conchoid {
namespace {

CrackState initial_crack(const PreparedBody& body) {
  CrackState crack;
  for (const TriMesh& sheet : body.cracks)
    append_part(crack.sheet, sheet);
  update_crack(crack, body.surface, body.crack_edge);
  return crack;
}

void solve(BemOpening& bem, const CrackState& crack) {
  bem.solve(crack.cut, crack.division);
  if (const ContactReport& contact = bem.body().contact(); !contact.converged)
    warning(contact_warning(contact));
}

void warn_of(const std::vector<std::string>& texts) {
  for (const std::string& text : texts)
    warning(text);
}

double opened_volume(const TriMesh& crack, const IdVector<NodeId, Vec3>& opening) {
  double volume = 0;
  for (std::size_t t = 0; t < crack.triangle_count(); ++t)
    for (NodeId node : crack.corners[TriId(t)])
      volume += area_vector(crack, TriId(t)).dot(opening[node]) / 3;
  return volume;
}

}  // namespace

SifReport compute_sifs(const Scene& scene) {
  const Stopwatch clock;
  const PreparedBody body = prepare(scene);
  if (body.cracks.empty())
    throw InputError(scene.file + ": there is no crack to take stress intensity factors of; add a [[crack]]");
  const SifSettings sif = sif_settings(scene.run);
  BemOpening bem(body.elastic, load_of(scene, body), sif_settings(scene.run));
  const CrackState crack = initial_crack(body);
  SifReport report;
  report.elements = elements_of(body);
  report.warnings = resolution_warnings(body, crack, scene.run.max_cracks > 0);
  warn_of(report.warnings);
  solve(bem, crack);
  for (const Front& front : crack.fronts) {
    const auto K =
        stress_intensities(crack.trimmed, front, bem.body().opening(), scene.material.elastic(), sif);
    report.fronts.push_back({front.closed, {}});
    for (std::size_t i = 0; i < K.size(); ++i)
      report.fronts.back().nodes.push_back(
          {crack.trimmed.positions[front.nodes[i]] + body.origin, K[i], front.frames[i]});
  }
  report.triangles = crack.trimmed.triangle_count();
  report.opened_volume = opened_volume(crack.trimmed, bem.body().opening());
  report.seconds = clock.seconds();
  return report;
}

StressReport compute_stress(const Scene& scene) {
  const Stopwatch clock;
  if (scene.body.infinite())
    throw InputError(scene.body.where +
                     ": the infinite body has no surface to show stress on; use a body with one");
  const PreparedBody body = prepare(scene);
  BemOpening bem(body.elastic, load_of(scene, body), sif_settings(scene.run));
  solve(bem, initial_crack(body));
  const IdVector<TriId, int> region = region_of_triangles(body.surface, body.regions);
  StressReport report;
  report.elements = elements_of(body);
  report.warnings = element_warnings(body);
  warn_of(report.warnings);
  const std::vector<Mat3> stress = bem.body().surface_stress();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    const Vec3 principal = principal_stress(stress[t]).value;
    report.triangles.push_back({centroid(body.surface, TriId(t)) + body.origin, principal,
                                region[TriId(t)] >= 0 ? body.regions[region[TriId(t)]].name : std::string()});
    report.max_principal = t == 0 ? principal[0] : std::max(report.max_principal, principal[0]);
  }
  for (const Vec3& u : bem.body().displacement())
    report.max_displacement = std::max(report.max_displacement, u.norm());
  report.seconds = clock.seconds();
  return report;
}

}  // namespace conchoid
