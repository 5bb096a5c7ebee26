#include "conchoid/material/library.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace conchoid {
namespace {

TEST(Library, HoldsTheMaterialsPeopleAskFor) {
  for (const char* name :
       {"glass", "soda-lime", "concrete", "sandstone", "marble", "ceramic", "plaster", "ice"})
    EXPECT_NE(find_material(name), nullptr) << name;
  EXPECT_EQ(find_material("unobtainium"), nullptr);
}

// A slip of a power of ten would show: brittle solids have toughness² / strength² (twice the critical flaw,
// but for a factor) between a tenth of a millimetre and a few decimetres.
TEST(Library, ConstantsAreThoseOfBrittleSolids) {
  for (const NamedMaterial& m : named_materials()) {
    EXPECT_GT(m.youngs_modulus, 1e9) << m.name;
    EXPECT_LT(m.youngs_modulus, 5e11) << m.name;
    EXPECT_GT(m.poisson_ratio, 0.1) << m.name;
    EXPECT_LT(m.poisson_ratio, 0.4) << m.name;
    EXPECT_GT(m.density, 900) << m.name;
    EXPECT_LT(m.density, 4500) << m.name;
    const double flaw = (m.toughness / m.strength) * (m.toughness / m.strength);
    EXPECT_GT(flaw, 1e-4) << m.name;
    EXPECT_LT(flaw, 0.3) << m.name;
    EXPECT_FALSE(m.source.empty());
  }
}

TEST(Library, TheDocumentationHoldsThisTable) {
  std::ifstream in(CONCHOID_SOURCE_DIR "/docs/materials.md");
  std::ostringstream page;
  page << in.rdbuf();
  for (const NamedMaterial& m : named_materials()) {
    const std::string row =
        fmt::format("| {} | {:g} | {:g} | {:g} | {:g} | {:g} | {} |", m.name, m.youngs_modulus / 1e9,
                    m.poisson_ratio, m.density, m.strength / 1e6, m.toughness / 1e6, m.source);
    EXPECT_NE(page.str().find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace conchoid
