#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/study/experiments/report.hpp"
#include "conchoid/study/experiments/workshop.hpp"

namespace conchoid {

/// A table, figure or study of the publication: what was reported, and how it is made again. A new one is an
/// entry in one of the lists below.
struct Experiment {
  std::string name;                    ///< on the command line: "table-1", "figure-13"
  std::string title;                   ///< one line
  std::string outcome;                 ///< what was published, in words
  std::vector<ReportTable> published;  ///< what was published, in figures
  bool needs_armadillo = false;
  std::function<Findings(Workshop&)> make;
};

/// Those about databases and training, about scenes, about loads that no database has seen, and about errors that
/// a run knows of.
std::vector<Experiment> database_experiments();
std::vector<Experiment> scene_experiments();
std::vector<Experiment> held_out_experiments();
std::vector<Experiment> uncertainty_experiments();

/// All, in the order of the publication.
const std::vector<Experiment>& experiments();
/// Throws InputError that lists the known names.
const Experiment& experiment(std::string_view name);

}  // namespace conchoid
