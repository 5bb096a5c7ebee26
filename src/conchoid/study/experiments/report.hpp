#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace conchoid {

/// A table of a report: cells as text, the first column names the row.
struct ReportTable {
  std::string name;     ///< of its CSV file, "scenes"
  std::string caption;  ///< what it shows, units
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// A line in a plot. Points that are not finite, or not positive on a logarithmic axis, are left out.
struct PlotSeries {
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< (x, y)
  bool dashed = false;
};

struct ReportPlot {
  std::string caption;
  std::string x, y;  ///< quantity and unit of the axes
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<PlotSeries> series;
};

struct ReportPicture {
  std::string caption;
  std::filesystem::path file;  ///< PNG
};

/// What an experiment has to show.
struct Findings {
  std::vector<ReportTable> tables;
  std::vector<ReportPlot> plots;
  std::vector<ReportPicture> pictures;
  std::vector<std::string> remarks;  ///< sentences: how the set-up differs, what the figures mean
};

/// As CSV (RFC 4180) with the columns' names in the first line.
std::string csv_text(const ReportTable& table);

/// "12.3 %" of a share; "–" for what is not finite.
std::string percent_text(double share);
/// Three significant digits; "–" for what is not finite.
std::string number_text(double value);

}  // namespace conchoid
