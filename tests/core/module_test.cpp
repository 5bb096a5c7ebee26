#include "conchoid/core/module.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace conchoid {
namespace {

std::string refusal(const Module& module) {
  return test::refusal([&] { module_symbol(module, "anything", "field.vdb: cannot be read"); });
}

}  // namespace

TEST(Modules, AMissingOneSaysWhatIsMissingAndWhatToDo) {
  const std::string said = refusal({"conchoid_no_such_module", "OpenVDB", "CONCHOID_WITH_VDB"});
  EXPECT_TRUE(said.starts_with("field.vdb: cannot be read: ")) << said;
  for (const char* part : {"built without OpenVDB", "rebuild it with -DCONCHOID_WITH_VDB=ON",
                           "LD_LIBRARY_PATH", "conchoid_no_such_module.so"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(Modules, OneThatIsNotOfThisVersionIsRefused) {
  const std::string said = refusal({"libtbb", "TBB", "CONCHOID_WITH_TBB"});  // a shared object, but no module
  EXPECT_NE(said.find("libtbb.so belongs to another version of conchoid"), std::string::npos) << said;
}

}  // namespace conchoid
