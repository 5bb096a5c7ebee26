#include "conchoid/study/experiments/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/core/stopwatch.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/study/experiments/html_report.hpp"
#include "conchoid/study/experiments/svg_plot.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

// In the order of the list, each once.
std::vector<const Experiment*> chosen(const ReproduceOptions& options, std::vector<std::string>& left_out) {
  for (const std::string& name : options.names)
    if (experiment(name).needs_armadillo && options.armadillo.empty())
      throw InputError(
          fmt::format("{} needs the scan of the Stanford Armadillo, which does not come with the program; "
                      "add --armadillo FILE",
                      name));
  std::vector<const Experiment*> out;
  for (const Experiment& e : experiments()) {
    const bool named = std::find(options.names.begin(), options.names.end(), e.name) != options.names.end();
    if (!options.names.empty() && !named) continue;
    if (e.needs_armadillo && options.armadillo.empty())
      left_out.push_back(e.name);
    else
      out.push_back(&e);
  }
  return out;
}

fs::path checked_scan(const fs::path& file) {
  if (file.empty()) return file;
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: there is no such file; --armadillo names the scan", file.string()));
  return fs::absolute(file);
}

void write_findings(const Reproduction& made, const fs::path& folder) {
  const std::string& name = made.experiment->name;
  for (const ReportTable& table : made.findings.tables)
    write_bytes(folder / "tables" / fmt::format("{}-{}.csv", name, table.name), csv_text(table));
  for (std::size_t i = 0; i < made.findings.plots.size(); ++i)
    write_bytes(folder / "figures" / fmt::format("{}-plot-{}.svg", name, i + 1),
                plot_svg(made.findings.plots[i]));
}

nlohmann::ordered_json tables_json(const std::vector<ReportTable>& tables) {
  auto out = nlohmann::ordered_json::array();
  for (const ReportTable& t : tables)
    out.push_back({{"name", t.name}, {"caption", t.caption}, {"columns", t.columns}, {"rows", t.rows}});
  return out;
}

}  // namespace

StudyReport reproduce(const std::vector<const Experiment*>& wanted, Workshop& workshop) {
  StudyReport report;
  report.scale = workshop.scale();
  report.file = workshop.folder() / "report.html";
  Progress progress("experiments", wanted.size());
  for (const Experiment* e : wanted) {
    message(fmt::format("{} …", e->title));
    const Stopwatch clock;
    Reproduction made{e, {}, 0, ""};
    try {
      made.findings = e->make(workshop);
    } catch (const ComputationError& error) {
      made.failure = error.what();
      warning(fmt::format("{}: {}", e->name, made.failure));
    }
    made.seconds = clock.seconds();
    write_findings(made, workshop.folder());
    report.made.push_back(std::move(made));
    report.specifications = {workshop.specifications().begin(), workshop.specifications().end()};
    write_bytes(report.file, html_report(report));
    progress.advance();
  }
  return report;
}

StudyReport reproduce(const ReproduceOptions& options) {
  std::vector<std::string> left_out;
  const std::vector<const Experiment*> wanted = chosen(options, left_out);
  const fs::path scan = checked_scan(options.armadillo);
  require_databases(options.folder / "cache");
  Workshop workshop(options.folder, options.scale, scan);
  for (const std::string& name : left_out)
    warning(fmt::format("{} is left out: add --armadillo FILE, the scan it needs", name));
  StudyReport report = reproduce(wanted, workshop);
  report.left_out = std::move(left_out);
  write_bytes(report.file, html_report(report));
  return report;
}

std::string study_json(const StudyReport& report) {
  nlohmann::ordered_json out;
  out["report"] = report.file.string();
  out["scale"] = name(report.scale);
  out["experiments"] = nlohmann::ordered_json::array();
  for (const Reproduction& made : report.made)
    out["experiments"].push_back({{"name", made.experiment->name},
                                  {"title", made.experiment->title},
                                  {"outcome", made.experiment->outcome},
                                  {"published", tables_json(made.experiment->published)},
                                  {"tables", tables_json(made.findings.tables)},
                                  {"remarks", made.findings.remarks},
                                  {"seconds", made.seconds},
                                  {"failure", made.failure}});
  out["left_out"] = report.left_out;
  return out.dump();
}

}  // namespace conchoid
