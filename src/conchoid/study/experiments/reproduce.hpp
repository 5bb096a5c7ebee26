#pragma once

#include "conchoid/study/experiments/experiments.hpp"

namespace conchoid {

struct ReproduceOptions {
  std::vector<std::string> names;  ///< of experiments; empty: all that can be made
  StudyScale scale = StudyScale::smoke;
  std::filesystem::path folder;     ///< report.html, tables/, figures/, cache/
  std::filesystem::path armadillo;  ///< the scan; empty: none
};

/// An experiment that was made.
struct Reproduction {
  const Experiment* experiment = nullptr;
  Findings findings;
  double seconds = 0;   ///< this time; what the cache held costs none
  std::string failure;  ///< why it could not be made; empty: it was
};

struct StudyReport {
  std::filesystem::path file;  ///< report.html
  StudyScale scale = StudyScale::smoke;
  std::vector<Reproduction> made;
  std::vector<std::string> left_out;        ///< names of experiments that lack their scan
  std::vector<std::string> specifications;  ///< of the databases, with their seeds
};

/// Makes these experiments in a workshop and writes after each the report of those made so far, one page that needs nothing else,
/// and the tables as CSV. One that cannot be computed is recorded with the reason, and the next one follows. What was made before in the same folder is not made again, whatever interrupted it.
StudyReport reproduce(const std::vector<const Experiment*>& wanted, Workshop& workshop);
/// The same for those named. Throws InputError for an unknown name, and for one that lacks its scan, before
/// anything is made.
StudyReport reproduce(const ReproduceOptions& options);

/// The object that `reproduce --json` prints: per experiment the published rows and ours.
std::string study_json(const StudyReport& report);

}  // namespace conchoid
