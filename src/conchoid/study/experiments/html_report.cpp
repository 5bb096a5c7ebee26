#include "conchoid/study/experiments/html_report.hpp"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "conchoid/core/base64.hpp"
#include "conchoid/core/bytes.hpp"
#include "conchoid/study/experiments/svg_plot.hpp"

namespace conchoid {
namespace {

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:1500px;margin:2em auto;padding:0 1em;line-height:1.4}"
    "table{border-collapse:collapse;font-size:12px;margin:.5em 0}"
    "td,th{border:1px solid #ccc;padding:2px 6px;text-align:right}"
    "td:first-child,th:first-child{text-align:left}th{background:#eee}"
    "caption{text-align:left;font-size:13px;padding:.3em 0}"
    ".published table{background:#fffbe8}.wide{overflow-x:auto}figure{margin:.8em 0}img{max-width:100%}"
    "figcaption{font-size:13px}";

std::string table_html(const ReportTable& table) {
  std::string out =
      fmt::format("<div class='wide'><table><caption>{}</caption><tr>", escaped_text(table.caption));
  for (const std::string& column : table.columns)
    out += fmt::format("<th>{}</th>", escaped_text(column));
  out += "</tr>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (const std::string& cell : row)
      out += fmt::format("<td>{}</td>", escaped_text(cell));
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::string picture_html(const ReportPicture& picture) {
  return fmt::format(
      "<figure><img alt='{0}' src='data:image/png;base64,{1}'><figcaption>{0}</figcaption></figure>\n",
      escaped_text(picture.caption), base64(read_bytes(picture.file)));
}

std::string experiment_html(const Reproduction& made) {
  const Experiment& e = *made.experiment;
  std::string out =
      fmt::format("<section id='{0}'><h2>{1}</h2><p><code>{0}</code>, {2:.0f} s. Published: {3}</p>\n",
                  e.name, escaped_text(e.title), made.seconds, escaped_text(e.outcome));
  if (!made.failure.empty()) out += fmt::format("<p><b>Failed: {}</b></p>\n", escaped_text(made.failure));
  out += "<div class='published'>";
  for (const ReportTable& table : e.published)
    out += table_html(table);
  out += "</div>\n";
  for (const ReportTable& table : made.findings.tables)
    out += table_html(table);
  for (const std::string& remark : made.findings.remarks)
    out += fmt::format("<p>{}</p>\n", escaped_text(remark));
  for (const ReportPicture& picture : made.findings.pictures)
    out += picture_html(picture);
  for (const ReportPlot& plot : made.findings.plots)
    out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", plot_svg(plot),
                       escaped_text(plot.caption));
  return out + "</section>\n";
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(": "); colon != std::string::npos)
        return line.substr(colon + 2);
  return "unknown processor";
}

}  // namespace

std::string html_report(const StudyReport& report) {
  std::string out = fmt::format(
      "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>The published study, made "
      "again</title><style>{}</style></head><body>\n<h1>The published study, made again</h1>\n"
      "<p>Huang, Yu &amp; Kanai, <i>Predicting Brittle Fracture Surface Shape From Versatile Database</i>. "
      "Published tables have a yellow ground, ours follow. Scale: {}. conchoid {}, g++ {}, {}, {} threads. "
      "Loads are "
      "drawn from seeds that stand in the specifications of the databases, at the end; forests have seed "
      "1.</p>\n",
      kStyle, name(report.scale), CONCHOID_VERSION, __VERSION__, escaped_text(processor()),
      std::thread::hardware_concurrency());
  out += "<ul>\n";
  for (const Reproduction& made : report.made)
    out += fmt::format("<li><a href='#{}'>{}</a></li>\n", made.experiment->name,
                       escaped_text(made.experiment->title));
  out += "</ul>\n";
  if (!report.left_out.empty())
    out += fmt::format("<p>Left out for want of the scan (--armadillo): {}.</p>\n",
                       fmt::join(report.left_out, ", "));
  for (const Reproduction& made : report.made)
    out += experiment_html(made);
  out += "<h2>Databases</h2>\n";
  for (const std::string& text : report.specifications)
    out +=
        fmt::format("<details><summary>specification</summary><pre>{}</pre></details>\n", escaped_text(text));
  return out + "</body></html>\n";
}

}  // namespace conchoid
