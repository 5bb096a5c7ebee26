#pragma once

#include <string>

#include "conchoid/study/experiments/report.hpp"

namespace conchoid {

/// A line plot as one <svg> element that stands alone inside a page: axes with round ticks, a legend on the
/// right. Same input, same text.
std::string plot_svg(const ReportPlot& plot);

/// Text as it may stand in XML and HTML.
std::string escaped_text(const std::string& text);

}  // namespace conchoid
