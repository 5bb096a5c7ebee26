#include "conchoid/sim/parting.hpp"

#include <algorithm>
#include <numeric>

#include "conchoid/crack/closing/last_ligament.hpp"
#include "conchoid/sim/nearly_through.hpp"
#include "conchoid/surface/separation.hpp"

namespace conchoid {
namespace {

constexpr int kUnresolvedFrames = 3;  // in a row, after which what is left to break is looked at

// All but the largest.
double smaller_parts(const std::vector<double>& volume) {
  return std::accumulate(volume.begin(), volume.end(), 0.0) - *std::max_element(volume.begin(), volume.end());
}

}  // namespace

Parting::Parting(const PreparedBody& body, const RunSpec& settings)
    : body_(body), settings_(settings), surface_(body.surface) {}

bool Parting::is_told(double volume) {
  if (volume < cut_below_) return false;
  uncut_volume_ = volume;
  return true;
}

bool Parting::by_cracks(const CrackState& crack, const SweptSheets& sheets, int frame) {
  if (body_.infinite() || !separates(crack.cut)) return false;
  if (is_told(smaller_parts(glue(crack.cut).volume))) return true;
  return parts(sheets, frame, false,
               {LigamentsOf::each, [](const LastLigament&) { return true; }, std::nullopt});
}

// The last chance is always taken.
bool Parting::parts(const SweptSheets& sheets, int frame, bool at_end, const WhatBreaks& what) {
  if (!at_end && frame < cut_again_) return false;
  BodyCut cut = cut_or_break(body_, settings_, sheets.visible(), sheets.driving(), what);
  if (cut.parted() || settings_.max_fragments == 1) cut_ = std::move(cut);
  if (!cut_) cut_again_ = frame + ++vain_cuts_;
  return cut_.has_value();
}

bool Parting::by_ligament(const FrontReadings& front, const SweptSheets& sheets, int frame, bool at_end) {
  if (body_.infinite() || front.openings.size() != front.crack.points.size()) return false;
  // A front that has a single ligament to go mostly takes it in a frame or two.
  unresolved_frames_ = is_unresolved(front) ? unresolved_frames_ + 1 : 0;
  if (!at_end && !front.carried && !is_barred(front.crack) && unresolved_frames_ < kUnresolvedFrames &&
      !nearly_through(front.crack, surface_, kWidestOverloadedLigament * body_.crack_edge))
    return false;
  const auto breaks = [&](const LastLigament& ligament) {
    return ligament_breaks_at_once(ligament, front, at_end);
  };
  // By the surface of the boundary elements first, which has fewer triangles than the detailed one.
  // Cracks that bar each other's way for good may have left little together that is much to each.
  const LigamentsOf of = at_end ? LigamentsOf::each_and_all : LigamentsOf::each;
  const auto ligaments = find_last_ligaments(body_.surface, sheets.driving(), body_.crack_edge, of);
  const auto first = std::find_if(ligaments.begin(), ligaments.end(), breaks);
  if (first == ligaments.end()) return false;
  return is_told(first->smaller_part) || parts(sheets, frame, at_end, {of, breaks, *first});
}

double Parting::volume_off() const {
  if (!cut_) return uncut_volume_;
  std::vector<double> volume;
  for (const Fragment& f : cut_->fragments)
    volume.push_back(f.volume);
  return smaller_parts(volume);
}

}  // namespace conchoid
