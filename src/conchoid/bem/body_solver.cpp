#include "conchoid/bem/body_solver.hpp"

#include <utility>

#include "conchoid/bem/dense_solver.hpp"
#include "conchoid/bem/iterative_solver.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

const std::vector<std::pair<std::string, BodySolverFactory>>& solvers() {
  static const std::vector<std::pair<std::string, BodySolverFactory>> table{
      {"dense", make_dense_solver},
      {"iterative", make_iterative_solver},
  };
  return table;
}

}  // namespace

std::vector<std::string> body_solver_names() {
  std::vector<std::string> names;
  for (const auto& [name, factory] : solvers())
    names.push_back(name);
  return names;
}

std::unique_ptr<BodySolver> make_body_solver(const std::string& name, BodyEntries& entries,
                                             const RigidMotions& motions, const KeptSystem& kept) {
  std::string known;
  for (const auto& [candidate, factory] : solvers()) {
    if (candidate == name) return factory(entries, motions, kept);
    known += (known.empty() ? "" : ", ") + candidate;
  }
  throw InputError("solver '" + name + "' is not known; use one of: " + known);
}

}  // namespace conchoid
