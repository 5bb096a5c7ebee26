#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/database_spec.hpp"
#include "conchoid/study/experiments/html_report.hpp"
#include "conchoid/study/experiments/method_comparison.hpp"
#include "conchoid/study/experiments/published_scenes.hpp"
#include "conchoid/study/experiments/reproduce.hpp"
#include "conchoid/study/experiments/svg_plot.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

// The published study: its list, its parts, and an experiment from the beginning to the report.
namespace conchoid {
namespace {

std::string refusal(const ReproduceOptions& options) {
  return test::refusal([&] { reproduce(options); });
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

TEST(Experiments, TheWholeChecklistIsThere) {
  std::set<std::string> names;
  for (const Experiment& e : experiments()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_FALSE(e.title.empty() || e.outcome.empty()) << e.name;
    EXPECT_EQ(e.published.empty(), !e.name.starts_with("table-")) << e.name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"table-1", "table-2", "table-3", "figure-5", "figure-6", "figure-7",
                                          "figure-8", "figure-9", "figure-10", "figure-11", "figure-12",
                                          "figure-13", "tree-study", "held-out", "calibration", "hybrid"}));
  EXPECT_EQ(experiments().front().name, "table-1");
  EXPECT_EQ(experiments()[11].name, "figure-13");
}

TEST(Experiments, WhatCannotBeMadeIsRefusedBeforeAnythingIs) {
  const test::TemporaryFolder scratch;
  const auto out = scratch / "out";
  const std::string unknown = refusal({.names = {"table-1", "figure-99"}, .folder = out, .armadillo = {}});
  for (const char* part : {"figure-99", "table-1", "tree-study"})
    EXPECT_NE(unknown.find(part), std::string::npos) << unknown;
  EXPECT_NE(refusal({.names = {"figure-10"}, .folder = out, .armadillo = {}}).find("--armadillo"),
            std::string::npos);
  EXPECT_NE(refusal({.names = {"figure-10"}, .folder = out, .armadillo = scratch / "no.ply"}).find("no.ply"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Experiments, ScenesAndDatabasesAreWellFormedInBothSizes) {
  const Variant near{.toughness = kNearToughness, .noisy_toughness = true};
  for (const std::string& text : {cube_scene(45), cube_scene(90, near), cylinder_scene(80), bar_scene(),
                                  edge_crack_scene(1), edge_crack_scene(2), edge_crack_scene(3)})
    EXPECT_NO_THROW(parse_scene(text + "solve_every = 2\n", "scene", "/tmp")) << text;
  for (const StudyScale scale : {StudyScale::smoke, StudyScale::full})
    for (const std::string& text :
         {cube_database(scale), cube_database(scale, near), small_cube_database(scale),
          cylinder_database(scale), bar_database(scale), magnitude_database(scale), held_out_cubes(scale)})
      EXPECT_NO_THROW(parse_database_spec(text, "spec", "/tmp")) << text;
  EXPECT_NE(held_out_scene(cube_scene, 0), held_out_scene(cube_scene, 1));
  EXPECT_NO_THROW(parse_scene(held_out_scene(cylinder_scene, 3), "scene", "/tmp"));
  EXPECT_EQ(parse_database_spec(cube_database(StudyScale::full), "spec", "/tmp").runs, 7502);
  EXPECT_EQ(parse_database_spec(bar_database(StudyScale::full), "spec", "/tmp").runs, 151);
}

TEST(Report, TablesAsCsv) {
  const ReportTable table{"t", "", {"a", "b,c"}, {{"1", "say \"x\""}, {"2", "plain"}}};
  EXPECT_EQ(csv_text(table), "a,\"b,c\"\n1,\"say \"\"x\"\"\"\n2,plain\n");
  EXPECT_EQ(percent_text(0.1234), "12.34 %");
  EXPECT_EQ(percent_text(std::nan("")), "–");
  EXPECT_EQ(number_text(1.23456e8), "1.23e+08");
}

TEST(Report, PlotsLeaveOutWhatAnAxisCannotShow) {
  ReportPlot plot{"caption", "x", "y < z", false, true, {}};
  plot.series = {{"one", {{1, 10}, {2, 100}, {3, 0}, {4, -5}, {5, std::nan("")}}}, {"two", {}, true}};
  const std::string svg = plot_svg(plot);
  EXPECT_EQ(count(svg, "<circle"), 2u);
  EXPECT_EQ(count(svg, "<path"), 2u);
  EXPECT_EQ(count(svg, "nan"), 0u);
  EXPECT_EQ(count(svg, "inf"), 0u);
  EXPECT_EQ(count(svg, "y &lt; z"), 1u);
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2u);
  EXPECT_EQ(count(plot_svg({"nothing", "x", "y", false, false, {}}), "nan"), 0u);
  EXPECT_EQ(svg, plot_svg(plot));
}

TEST(Report, HigherValuesStandHigher) {
  ReportPlot plot{"", "x", "y", false, false, {{"s", {{0, 1}, {1, 2}}}}};
  const std::string svg = plot_svg(plot);
  const auto y = [&](std::size_t nth) {
    std::size_t at = 0;
    for (std::size_t i = 0; i <= nth; ++i)
      at = svg.find("cy='", at) + 4;
    return std::stod(svg.substr(at));
  };
  EXPECT_GT(y(0), y(1));
}

#if CONCHOID_WITH_LEARNING

std::vector<std::string> cached_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// A database of two runs, a forest, and one scene by boundary elements, forest and a closed form.
Experiment tiny_experiment(int& made) {
  return {.name = "tiny",
          .title = "A <tiny> one",
          .outcome = "nothing",
          .published = {{"published", "as published", {"a"}, {{"42"}}}},
          .make = [&made](Workshop& workshop) {
            ++made;
            std::string spec = held_out_cubes(StudyScale::smoke);
            spec.replace(spec.find("runs = 12"), 9, "runs = 2");
            const ComparedScene scene{"Cube 30", cube_scene(30)};
            const std::vector<MethodChoice> methods = {
                {.title = "RF",
                 .method = "forest",
                 .regressor = workshop.forest(spec, {.trees = 4, .depth = 4}).regressor.get()},
                {.title = "kept, 2nd", .method = "kept", .solve_every = 2}};
            Findings f;
            f.tables.push_back(comparison_table(workshop, {scene}, methods));
            f.plots = front_plots(workshop, scene, methods);
            return f;
          }};
}

TEST(Reproduce, MakesAReportAndGoesOnFromItsCache) {
  const test::TemporaryFolder scratch;
  int made = 0;
  const Experiment tiny = tiny_experiment(made);
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> names;
  for (const bool first : {true, false}) {
    Workshop workshop(scratch / "out", StudyScale::smoke, {});
    const StudyReport report = reproduce({&tiny}, workshop);
    const ReportTable& table = report.made.at(0).findings.tables.at(0);
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[0][4], "0.00 %");
    if (first) {
      rows = table.rows;
      names = cached_names(scratch / "out");
    }
    EXPECT_EQ(table.rows, rows);  // the times, too: nothing was made again
    EXPECT_EQ(cached_names(scratch / "out"), names);
    EXPECT_NE(study_json(report).find("\"published\""), std::string::npos);
  }
  EXPECT_EQ(made, 2);
  const std::string page = test::file_content(scratch / "out" / "report.html");
  EXPECT_EQ(count(page, "<svg"), 2u);
  EXPECT_EQ(count(page, "A &lt;tiny&gt; one"), 2u);
  EXPECT_EQ(count(page, "<td>42</td>"), 1u);
  for (const char* elsewhere : {"src='http", "href='http", "<script"})
    EXPECT_EQ(count(page, elsewhere), 0u);
  EXPECT_EQ(count(test::file_content(scratch / "out" / "tables" / "tiny-comparison.csv"), "\n"), 4u);
}

TEST(Reproduce, OneThatFailsIsRecordedAndTheNextFollows) {
  const test::TemporaryFolder scratch;
  Workshop workshop(scratch / "out", StudyScale::smoke, {});
  const Experiment fails{
      .name = "fails", .title = "fails", .outcome = "", .published = {}, .make = [](Workshop&) -> Findings {
        throw ComputationError("the disk is full");
      }};
  const Experiment works{
      .name = "works", .title = "works", .outcome = "", .published = {}, .make = [](Workshop&) {
        return Findings{{{"t", "", {"a"}, {{"1"}}}}, {}, {}, {}};
      }};
  const StudyReport report = reproduce({&fails, &works}, workshop);
  EXPECT_EQ(report.made.at(0).failure, "the disk is full");
  EXPECT_EQ(report.made.at(1).failure, "");
  EXPECT_EQ(count(test::file_content(report.file), "the disk is full"), 1u);
  EXPECT_EQ(test::file_content(scratch / "out" / "tables" / "works-t.csv"), "a\n1\n");
  const Experiment stops{
      .name = "stops", .title = "stops", .outcome = "", .published = {}, .make = [](Workshop&) -> Findings {
        throw Interrupted("stop");
      }};
  EXPECT_THROW(reproduce({&stops}, workshop), Interrupted);
}

#endif

#if CONCHOID_WITH_LEARNING && CONCHOID_WITH_PICTURES

TEST(Reproduce, TheBarFromItsOwnDatabase) {
  const test::TemporaryFolder scratch;
  const StudyReport report = reproduce({.names = {"figure-8"}, .folder = scratch / "out", .armadillo = {}});
  ASSERT_EQ(report.made.size(), 1u);
  EXPECT_EQ(report.made[0].findings.tables.at(0).rows.size(), 11u);
  EXPECT_EQ(count(test::file_content(report.file), "data:image/png;base64,"), 1u);
}

#endif

}  // namespace
}  // namespace conchoid
