#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/crack/law/growth_law.hpp"
#include "conchoid/sim/crack_state.hpp"
#include "conchoid/sim/front_history.hpp"
#include "conchoid/sim/prepared_body.hpp"

namespace conchoid {

/// What the scene says about SIFs.
SifSettings sif_settings(const RunSpec& run);

/// What is known at a front point: the opening behind it, and the SIFs that drive it.
struct FrontOpening {
  Vec3 opening = Vec3::Zero();         ///< Δu at the correlation node, world axes [m]
  Vec3 intensity = Vec3::Zero();       ///< K that moves the front [Pa√m]
  Vec3 node_intensity = Vec3::Zero();  ///< K from this opening alone (S3): what features are made of [Pa√m]
  Vec3 spread = Vec3::Zero();  ///< standard deviation that a predictor gives K [Pa√m]; 0 where it states none
  bool in_range = true;        ///< false: a predictor was asked beyond its training
  bool known = true;           ///< false: nothing tells K here, which is zero; the point stays
};

/// The socket: where the crack opening comes from.
class OpeningSource {
 public:
  virtual ~OpeningSource() = default;
  virtual std::string name() const = 0;
  /// Opening and K at every point of the crack as it stands, in the order of crack.points.
  virtual std::vector<FrontOpening> open(const CrackState& crack) = 0;
  /// Whether the last open() solved the boundary elements for the crack as it stood.
  virtual bool solved() const = 0;
  /// Whether open() is going to, for a crack that has grown so many times (CrackSheet::frame).
  virtual bool solves(int frame) const = 0;
  /// Whether frames after the first may be solved.
  virtual bool solves_later_frames() const { return true; }
  /// How far the crack surface so far is expected to lie from the solved one, over the body's diagonal; nothing
  /// where nobody estimates it.
  virtual std::optional<double> expected_error() const { return {}; }
  /// What boundary elements say of the crack as it stood at the last open(), where the fronts go by something else; null
  /// where nobody has asked them.
  virtual const std::vector<FrontOpening>* truth() const { return nullptr; }
  /// The crack goes on by these openings, as open() could not solve.
  virtual void take_carried(const CrackState&, const std::vector<FrontOpening>&) {}
};

/// Solves for the opening with boundary elements, incrementally; exact up to discretisation.
class BemOpening : public OpeningSource {
 public:
  BemOpening(std::shared_ptr<const BodyOperator> body, LoadCase load, const SifSettings& sif);
  std::string name() const override { return "bem"; }
  std::vector<FrontOpening> open(const CrackState& crack) override;
  bool solved() const override { return true; }
  bool solves(int /*frame*/) const override { return true; }
  /// Replaces the load; counts from the next solve() or open() on.
  void set_load(LoadCase load) {
    body_.set_load(std::move(load));
    ++loads_;
  }
  /// How often the load was replaced.
  std::size_t loads() const { return loads_; }
  /// The body as it was last solved.
  const CrackedBody& body() const { return body_; }
  /// Where the rows of the cracks are kept (bem/row_store.hpp); must outlive the source.
  void keep_rows(RowStore* store) { body_.keep_rows(store); }
  /// Solves without asking for SIFs (no crack yet).
  void solve(const CutComplex& cut, const CutDivision& division = {});

 private:
  CrackedBody body_;
  ElasticConstants m_;
  SifSettings sif_;
  std::size_t loads_ = 0;
};

/// Where nothing can be solved any more, as a piece hangs by a ligament too thin for the elements: each point
/// goes straight ahead with the K_eff that its correlation node (or itself, if it stayed) had when last
/// solved. Points without one take the mean of the nearest on their connected front that have one
/// (fill_gaps).
std::vector<FrontOpening> carried_openings(const CrackState& crack, const FrontHistory& history,
                                           const GrowthLaw& law);

}  // namespace conchoid
