// Resolutions that nobody could wait for are refused before anything is computed, with the value that would do.

#include <gtest/gtest.h>

#include <string>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/prepared_body.hpp"
#include "conchoid/sim/resolution_floor.hpp"
#include "refusal.hpp"
#include "scenes.hpp"

namespace conchoid {
namespace {

std::string refusal_of(double crack, double surface, const std::string& body = "[body]\nmodel = 'cube'\n") {
  const Scene scene =
      test::scene_from_text(body + test::material_text() + test::resolution_text(crack, surface) +
                            "[[boundary]]\nregion = 'z+'\nfixed = true\n");
  return test::refusal([&] { prepare(scene); });
}

/// The number after "use ".
double advised(const std::string& refusal) {
  return std::stod(refusal.substr(refusal.find("use ") + 4));
}

}  // namespace

TEST(Floors, TheSurfaceResolutionHasOne) {
  const std::string text = refusal_of(0.1, 1e-9);
  for (const char* part : {"scene.toml", "resolution.surface", "2.3e+18 triangles", "2e+07"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(refusal_of(0.1, advised(text)), "accepted") << "the advice is good";
  EXPECT_NE(refusal_of(0.1, 0.9 * advised(text)), "accepted");
}

TEST(Floors, SoHasTheCrackResolution) {
  const std::string text = refusal_of(1e-5, 1e-5);
  EXPECT_NE(text.find("resolution.crack"), std::string::npos) << text;
  EXPECT_EQ(refusal_of(advised(text), 0.5 * advised(text)), "accepted");
}

TEST(Floors, TheyGrowWithTheSectionNotWithTheLength) {
  EXPECT_NO_THROW(require_affordable("", "", 1e-3, 1, most_surface_triangles));
  EXPECT_THROW(require_affordable("", "", 1e-4, 1, most_surface_triangles), InputError);
  EXPECT_NO_THROW(require_affordable("", "", 1e-4, 1e-2, most_surface_triangles));
}

}  // namespace conchoid
