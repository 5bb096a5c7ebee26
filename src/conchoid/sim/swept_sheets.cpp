#include "conchoid/sim/swept_sheets.hpp"

#include <cmath>

#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/mesh/surface_parts.hpp"

namespace conchoid {
namespace {

constexpr double kDrivingSpacing = 1.0 / 10;  // × r̄: of the markers that move the cracks
constexpr double kSameSpacing = 1e-6;         // spacings that differ by less are the same

}  // namespace

SweptSheets::SweptSheets(CrackSheet& sheet, double crack_edge, double surface_edge)
    : sheet_(sheet),
      crack_edge_(crack_edge),
      driving_(sheet, {.resolution = crack_edge, .spacing = kDrivingSpacing * crack_edge}) {
  if (std::abs(surface_edge / crack_edge / kDrivingSpacing - 1) > kSameSpacing)
    following_.emplace(sheet, FineFrontSettings{.resolution = crack_edge, .spacing = surface_edge});
}

void SweptSheets::append_parts() {
  visible_.reset();
  driving_.append_parts(sheet_);
  if (following_) following_->append_parts(sheet_);
}

void SweptSheets::advance(const std::vector<FrontStep>& steps, const GrowthModel& growth) {
  visible_.reset();
  advance_fronts(sheet_, driving_, steps, growth, crack_edge_, following_ ? &*following_ : nullptr);
}

TriMesh SweptSheets::swept() const {
  FineFront finished = following_ ? *following_ : driving_;
  if (!sheet_.fronts.empty()) finished.finish();
  return finished.surface();
}

const std::vector<TriMesh>& SweptSheets::visible() const {
  if (visible_) return *visible_;
  std::vector<TriMesh> apart = split_parts(swept());
  parallel_for(apart.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      apart[i] = unfolded_part(apart[i]);
  });
  std::erase_if(apart, [](const TriMesh& sheet) { return sheet.corners.empty(); });
  return visible_.emplace(std::move(apart));
}

}  // namespace conchoid
