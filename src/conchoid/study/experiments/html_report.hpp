#pragma once

#include <string>

#include "conchoid/study/experiments/reproduce.hpp"

namespace conchoid {

/// The report as one HTML page: published tables beside ours, plots as SVG and pictures as PNG inside it,
/// machine and versions.
std::string html_report(const StudyReport& report);

}  // namespace conchoid
