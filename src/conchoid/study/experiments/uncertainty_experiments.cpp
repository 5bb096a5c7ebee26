#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

#include "conchoid/core/progress.hpp"
#include "conchoid/crack/intensity/stress_intensity.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/sim/expected_error.hpp"
#include "conchoid/study/compare.hpp"
#include "conchoid/study/experiments/experiments.hpp"
#include "conchoid/study/experiments/method_comparison.hpp"
#include "conchoid/study/experiments/published_scenes.hpp"

namespace conchoid {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// What was stated of a kink angle, and by how much it was wrong [rad].
struct StatedAndTrue {
  double stated = 0, error = 0;
};

/// Of every sample, with what its run and frame are.
struct Judged {
  std::int32_t run = 0, frame = 0;
  StatedAndTrue angle;
};

std::vector<Judged> judged(const Regressor& regressor, const SampleSet& samples) {
  const std::vector<OpeningPrediction> predictions = regressor.predict_openings(samples);
  std::vector<Judged> out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    const ElasticConstants m{s.youngs_modulus, s.poisson_ratio};
    const auto intensity = [&](const Vec3& opening) {
      return stress_intensity(opening, s.distance_after, m);
    };
    FrontOpening predicted;
    predicted.intensity = intensity(predictions[i].opening);
    predicted.spread = intensity(predictions[i].spread);
    predicted.in_range = predictions[i].in_range;
    out.push_back({s.run,
                   s.frame,
                   {stated_angle_error(predicted, s.resolution, m),
                    kink_angle(predicted.intensity, m) - kink_angle(intensity(s.opening), m)}});
  }
  return out;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values)
    sum += v * v;
  return values.empty() ? std::nan("") : std::sqrt(sum / static_cast<double>(values.size()));
}

// As a run would: the first frame of a run that was predicted is solved, too, and gives the scale.
std::vector<StatedAndTrue> scaled_by_first_frame(const std::vector<Judged>& all) {
  std::map<std::int32_t, std::int32_t> first;
  for (const Judged& j : all) {
    const auto [at, fresh] = first.emplace(j.run, j.frame);
    if (!fresh) at->second = std::min(at->second, j.frame);
  }
  std::map<std::int32_t, std::array<double, 2>> sums;  // of squares: stated, true
  for (const Judged& j : all)
    if (j.frame == first[j.run]) {
      sums[j.run][0] += j.angle.stated * j.angle.stated;
      sums[j.run][1] += j.angle.error * j.angle.error;
    }
  std::vector<StatedAndTrue> out;
  for (const Judged& j : all)
    if (j.frame > first[j.run])
      out.push_back({std::sqrt(sums[j.run][1] / sums[j.run][0]) * j.angle.stated, j.angle.error});
  return out;
}

std::vector<StatedAndTrue> angles(const std::vector<Judged>& all) {
  std::vector<StatedAndTrue> out;
  for (const Judged& j : all)
    out.push_back(j.angle);
  return out;
}

// Rows and a line: samples in ten groups of the same size by what was stated.
void add_calibration(const std::string& title, std::vector<StatedAndTrue> all, ReportTable& table,
                     ReportPlot& plot) {
  constexpr std::size_t groups = 10;
  std::sort(all.begin(), all.end(),
            [](const StatedAndTrue& a, const StatedAndTrue& b) { return a.stated < b.stated; });
  PlotSeries series{title, {}};
  for (std::size_t g = 0; g < groups; ++g) {
    std::vector<double> stated, error;
    std::size_t within = 0;
    for (std::size_t i = g * all.size() / groups; i < (g + 1) * all.size() / groups; ++i) {
      stated.push_back(all[i].stated);
      error.push_back(all[i].error);
      within += std::abs(all[i].error) <= all[i].stated;
    }
    if (stated.empty()) continue;
    const double said = root_mean_square(stated) * kDegrees, was = root_mean_square(error) * kDegrees;
    table.rows.push_back({title, fmt::format("{}", stated.size()), number_text(said), number_text(was),
                          number_text(was / said),
                          percent_text(static_cast<double>(within) / static_cast<double>(stated.size()))});
    series.points.push_back({said, was});
  }
  plot.series.push_back(std::move(series));
}

Findings calibration(Workshop& workshop) {
  const StudyScale scale = workshop.scale();
  const Regressor& cube = *workshop.forest(cube_database(scale), {}).regressor;
  const Regressor& cylinder = *workshop.forest(cylinder_database(scale), {}).regressor;
  const SampleSet cubes = workshop.database(held_out_cubes(scale)).training_samples();
  const SampleSet cylinders = workshop.database(cylinder_database(scale)).training_samples();
  ReportTable table{"angles",
                    "Kink angle of a front element after one step: standard deviation that the trees state "
                    "and root mean square of the true error, in ten groups of elements by what is stated; "
                    "share of elements whose error is below it (68 % of a normal distribution)",
                    {"forest and elements", "elements", "stated, °", "true, °", "true / stated", "within"},
                    {}};
  ReportPlot plot{"What is stated against what is true, kink angle of one step",
                  "stated standard deviation, °",
                  "root mean square error, °",
                  true,
                  true,
                  {}};
  const std::vector<Judged> own = judged(cube, cubes), other = judged(cube, cylinders),
                            reverse = judged(cylinder, cubes);
  add_calibration("Cube's on cubes (own class)", angles(own), table, plot);
  add_calibration("Cube's on cylinders (left out)", angles(other), table, plot);
  add_calibration("Cylinder's on cubes (left out)", angles(reverse), table, plot);
  add_calibration("Cube's on cubes, scaled", scaled_by_first_frame(own), table, plot);
  add_calibration("Cube's on cylinders, scaled", scaled_by_first_frame(other), table, plot);
  add_calibration("Cylinder's on cubes, scaled", scaled_by_first_frame(reverse), table, plot);
  for (PlotSeries& series : plot.series)
    series.dashed = series.name.ends_with("scaled");
  plot.series.push_back({"stated = true", {{1, 1}, {100, 100}}, true});
  Findings f;
  f.tables.push_back(std::move(table));
  f.plots.push_back(std::move(plot));
  f.remarks = {
      "Scaled: times the ratio of true to stated in the first predicted frame of the run, as --method hybrid "
      "does when it solves that frame; the rows are of the frames after it."};
  return f;
}

// The cube by three surface meshes.
std::vector<ComparedScene> bodies_of_three_sizes(const Workshop& workshop) {
  std::vector<ComparedScene> out = {{"Cube, 120 triangles", cube_scene(45)}};
  for (const int triangles : workshop.full() ? std::vector{500, 2000} : std::vector{250, 500})
    out.push_back({fmt::format("Cube, {} triangles", triangles), cube_scene(45, {.remesh = triangles})});
  return out;
}

/// What hybrid runs predict by.
struct Predictor {
  std::string name;
  const Regressor* regressor;  // none: `kept`
};

MethodChoice by_hybrid(const Predictor& by, double tolerance) {
  return {.title = fmt::format("{}, X = {}", by.name, tolerance),
          .method = "hybrid",
          .regressor = by.regressor,
          .tolerance = tolerance};
}

/// A table of runs, error over cost, and the expected error against the true one.
struct CostStudy {
  ReportTable table;
  std::vector<ReportPlot> plots;
  ReportPlot expected;
};

// Boundary elements are the run with X = 0, made in the same hour as the others.
void add_costs(Workshop& workshop, const ComparedScene& scene, const Predictor& by,
               std::span<const double> tolerances, CostStudy& study, Progress& progress) {
  const auto run_with = [&](double tolerance) -> const RunData& {
    return workshop.run(scene.text, limited(workshop, scene.text, by_hybrid(by, tolerance)));
  };
  const RunData& solved = run_with(0);
  PlotSeries costs{by.name, {}, by.regressor == nullptr}, expected{scene.title + ", " + by.name, {}};
  for (const double tolerance : tolerances) {
    const RunData& run = run_with(tolerance);
    const RunDocument& d = run.document;
    const Comparison c = compare(solved, run);
    const double error = c.surface_mean / c.bbox_diagonal;
    const double cost = d.opening_seconds / solved.document.opening_seconds;
    study.table.rows.push_back({scene.title, by_hybrid(by, tolerance).title, fmt::format("{}", d.frames),
                                fmt::format("{}", d.solved_frames), percent_text(*d.expected_error),
                                percent_text(error), number_text(cost), number_text(d.opening_seconds)});
    costs.points.push_back({cost, 100 * error});
    expected.points.push_back({100 * *d.expected_error, 100 * error});
    progress.advance();
  }
  study.plots.back().series.push_back(std::move(costs));
  study.expected.series.push_back(std::move(expected));
}

Findings hybrid(Workshop& workshop) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  constexpr std::array kTolerances = {endless, 0.05, 0.02, 0.01, 0.005, 0.002, 0.0};
  const auto own = load_regressor(shipped_file("cube.network")),
             versatile = load_regressor(shipped_file("versatile.network"));
  const std::array<Predictor, 4> predictors{
      {{"cube.network", own.get()},
       {"versatile.network", versatile.get()},
       {"RF(Cube)", workshop.forest(cube_database(workshop.scale()), {}).regressor.get()},
       {"kept", nullptr}}};
  CostStudy study;
  study.table = {"cost",
                 "Error against cost: frames, of these solved; error of the surface that the run itself "
                 "expects, and the true one (mean distance from that of boundary elements), over the "
                 "body's diagonal; time of finding the opening over that of X = 0",
                 {"scene", "method", "frames", "solved", "expected", "true", "cost", "opening s"},
                 {}};
  study.expected = {"Error of the surface that a hybrid run expects, against the true one",
                    "expected mean distance / diagonal, %",
                    "true mean distance / diagonal, %",
                    true,
                    true,
                    {}};
  const std::vector<ComparedScene> scenes = bodies_of_three_sizes(workshop);
  Progress progress("runs", scenes.size() * predictors.size() * kTolerances.size());
  for (const ComparedScene& scene : scenes) {
    study.plots.push_back({scene.title + ": error against cost, from prediction alone to boundary elements",
                           "time of the opening / that of boundary elements",
                           "mean distance / diagonal, %",
                           false,
                           false,
                           {}});
    for (const Predictor& by : predictors)
      add_costs(workshop, scene, by, kTolerances, study, progress);
  }
  study.expected.series.push_back({"expected = true", {{0.1, 0.1}, {10, 10}}, true});
  study.plots.push_back(std::move(study.expected));
  Findings f;
  f.tables.push_back(std::move(study.table));
  f.plots = std::move(study.plots);
  f.remarks = {
      "X = inf is the prediction alone, X = 0 the solution; both have the bits of --method network, "
      "forest or kept, and bem. The networks come with the program and are calibrated (forest calibrate), "
      "the forest is the published one and is not. Times are those of one run each, on whatever else the "
      "machine did."};
  return f;
}

}  // namespace

std::vector<Experiment> uncertainty_experiments() {
  return {{.name = "calibration",
           .title = "How uncertain a forest says it is, and how wrong it is",
           .outcome = "Not published: the forests' spread was not looked at.",
           .published = {},
           .make = calibration},
          {.name = "hybrid",
           .title = "Error against cost: predicted, and solved where that may go astray",
           .outcome = "Not published: solving again mid-way was named as future work.",
           .published = {},
           .make = hybrid}};
}

}  // namespace conchoid
