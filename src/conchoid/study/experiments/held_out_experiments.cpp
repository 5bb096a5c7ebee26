#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/progress.hpp"
#include "conchoid/study/compare.hpp"
#include "conchoid/study/experiments/experiments.hpp"
#include "conchoid/study/experiments/method_comparison.hpp"
#include "conchoid/study/experiments/published_scenes.hpp"

namespace conchoid {
namespace {

constexpr int kFewestFrames = 4;  // solved: below it a chip came off, which says nothing of a predictor

/// Over the scenes of one method.
struct Errors {
  std::vector<double> mean, crack, p95, frames, chamfer;
  int lost = 0;  // at the frame limit

  void add(const Comparison& c) {
    mean.push_back(c.surface_mean / c.bbox_diagonal);
    p95.push_back(c.surface_p95 / c.bbox_diagonal);
    crack.push_back(c.surface_mean / c.crack_diagonal);
    frames.push_back(static_cast<double>(c.frames[1]) / c.frames[0]);
    chamfer.push_back(c.fragment_chamfer / c.bbox_diagonal);
    lost += c.stop[1] == StopReason::frame_limit;
  }
};

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::vector<std::string> errors_row(const std::string& body, const std::string& method, const Errors& e) {
  return {body,
          method,
          percent_text(quantile(e.mean, 0.5)),
          percent_text(quantile(e.mean, 0.95)),
          percent_text(quantile(e.mean, 1)),
          percent_text(quantile(e.p95, 0.5)),
          percent_text(quantile(e.crack, 0.5)),
          number_text(quantile(e.frames, 0.5)),
          percent_text(quantile(e.chamfer, 0.5)),
          fmt::format("{} of {}", e.lost, e.mean.size())};
}

struct HeldOutBody {
  std::string title;
  SceneOfLoad scene;
};

// Of the body's scenes those in which boundary elements take enough frames.
std::vector<std::string> usable_scenes(Workshop& workshop, const HeldOutBody& body, int count) {
  std::vector<RunChoice> solved;
  for (int i = 0; i < count; ++i)
    solved.push_back({held_out_scene(body.scene, i), {}});
  workshop.make_runs(solved);
  std::vector<std::string> scenes;
  for (const RunChoice& run : solved)
    if (workshop.run(run.text).document.frames >= kFewestFrames) scenes.push_back(run.text);
  return scenes;
}

Findings held_out(Workshop& workshop) {
  const int count = workshop.full() ? 60 : 3;
  std::vector<MethodChoice> methods = {
      {.title = "RF(Cube)",
       .method = "forest",
       .regressor = workshop.forest(cube_database(workshop.scale()), {}).regressor.get()},
      {.title = "RF(Cylinder)",
       .method = "forest",
       .regressor = workshop.forest(cylinder_database(workshop.scale()), {}).regressor.get()}};
  for (MethodChoice& baseline : baselines())
    methods.push_back(std::move(baseline));
  Findings f;
  ReportTable table{
      "errors",
      "Loads that no database has seen, against boundary elements: mean distance of the crack surfaces "
      "over the body's diagonal (median, 95 %, largest), 95 % distance, mean over the crack's own "
      "diagonal, frames over those of boundary elements, Chamfer distance of the fragments over the "
      "body's diagonal; runs at the frame limit",
      {"body", "method", "mean, median", "mean, 95 %", "mean, largest", "95 % distance, median",
       "mean / crack's diagonal, median", "frames ratio, median", "Chamfer, median", "lost"},
      {}};
  const std::vector<HeldOutBody> bodies = {{"Cube", cube_scene}, {"Cylinder", cylinder_scene}};
  Progress progress("methods", bodies.size() * methods.size());
  for (const HeldOutBody& body : bodies) {
    const std::vector<std::string> scenes = usable_scenes(workshop, body, count);
    f.remarks.push_back(
        fmt::format("{}: {} of {} scenes count; in the others a chip came off within {} frames.", body.title,
                    scenes.size(), count, kFewestFrames - 1));
    for (const MethodChoice& method : methods) {
      std::vector<RunChoice> predicted;
      for (const std::string& text : scenes)
        predicted.push_back({text, limited(workshop, text, method)});
      workshop.make_runs(predicted);
      Errors errors;
      for (const RunChoice& run : predicted)
        errors.add(compare(workshop.run(run.text), workshop.run(run.text, run.method)));
      table.rows.push_back(errors_row(body.title, method.title, errors));
      progress.advance();
    }
  }
  f.tables.push_back(std::move(table));
  f.remarks.push_back("Slopes to 60°. Each row of a forest stands for its own class or for the other one.");
  return f;
}

}  // namespace

std::vector<Experiment> held_out_experiments() {
  return {{.name = "held-out",
           .title = "Whole runs under loads that no database has seen, in figures",
           .outcome = "Not published: no error measure and no held-out split was given.",
           .published = {},
           .make = held_out}};
}

}  // namespace conchoid
