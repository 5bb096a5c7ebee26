#include "conchoid/study/experiments/method_comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "conchoid/core/progress.hpp"
#include "conchoid/io/run_pictures.hpp"
#include "conchoid/study/compare.hpp"

namespace conchoid {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

MethodChoice solved() {
  return {.title = "BEM", .method = "bem"};
}

std::vector<MethodChoice> with_solved(Workshop& workshop, const ComparedScene& scene,
                                      const std::vector<MethodChoice>& methods) {
  std::vector<MethodChoice> all = {solved()};
  for (const MethodChoice& method : methods)
    all.push_back(limited(workshop, scene.text, method));
  return all;
}

std::vector<std::string> metrics_row(const std::string& scene, const std::string& method, const RunData& run,
                                     const Comparison& c) {
  const RunDocument& d = run.document;
  return {scene,
          method,
          fmt::format("{}", d.frames),
          std::string(name(d.stop)),
          percent_text(c.surface_mean / c.bbox_diagonal),
          percent_text(c.surface_p95 / c.bbox_diagonal),
          percent_text(c.surface_mean / c.crack_diagonal),
          percent_text(c.front_distance / c.bbox_diagonal),
          number_text(c.kink_angle_error * kDegrees),
          number_text(c.sif_log_error[0]),
          number_text(c.sif_log_error[1]),
          number_text(c.sif_log_error[2]),
          number_text(c.area_ratio),
          number_text(c.largest_fragment_iou),
          percent_text(c.volume_error),
          percent_text(c.fragment_chamfer / c.bbox_diagonal),
          number_text(d.opening_seconds_per_frame),
          number_text(d.total_seconds)};
}

double setting(const RunDocument& document, const std::string& name) {
  for (const RunSetting& s : document.settings)
    if (s.name == name)
      if (const double* value = std::get_if<double>(&s.value)) return *value;
  return std::nan("");
}

// In a row, from the front, the right and above.
std::filesystem::path write_panels(const Workshop& workshop, const std::string& name,
                                   const std::vector<PicturePanel>& panels, const Vec3& up) {
  const int side = workshop.full() ? 330 : 210;  // pixels
  PictureSettings settings;
  settings.up = up;
  if (up.y() != 0) settings.from = {0.62, 0.52, 1.0};
  settings.width = side * static_cast<int>(panels.size());
  settings.height = side;
  settings.samples = workshop.full() ? 4 : 2;
  const std::filesystem::path file = workshop.picture_file(name);
  write_picture(file, panels, settings);
  return file;
}

}  // namespace

std::vector<MethodChoice> baselines() {
  std::vector<MethodChoice> methods;
  for (const char* method : {"steady", "kept", "stress"})
    for (const int every : {0, 2, 3})
      methods.push_back(
          {.title = every == 0 ? std::string(method)
                               : fmt::format("{}, every {} frame solved", method, every == 2 ? "2nd" : "3rd"),
           .method = method,
           .solve_every = every});
  return methods;
}

MethodChoice limited(Workshop& workshop, const std::string& scene_text, MethodChoice method) {
  if (method.method != "bem") method.frames = 2 * workshop.run(scene_text).document.frames + 4;
  return method;
}

ReportTable comparison_table(Workshop& workshop, const std::vector<ComparedScene>& scenes,
                             const std::vector<MethodChoice>& methods) {
  ReportTable table{
      "comparison",
      "Against boundary elements: distance of the crack surfaces, mean and 95 %, over the body's diagonal, "
      "and the "
      "mean over the crack's own; distance of the fronts in the mean over the frames; root mean square error "
      "of "
      "the kink angle; error of log K; crack area over the solved one; overlap of the largest fragments; "
      "error of "
      "the fragments' volumes; Chamfer distance of the fragments over the body's diagonal; seconds.",
      {"scene", "method", "frames", "stop", "mean / diagonal", "95 % / diagonal", "mean / crack's diagonal",
       "fronts / diagonal", "kink, °", "log K_I", "log K_II", "log K_III", "area ratio", "IoU", "volumes",
       "Chamfer / diagonal", "opening s / frame", "total s"},
      {}};
  std::size_t runs = 0;
  for (const ComparedScene& scene : scenes)
    runs += 1 + scene.changed.size() + methods.size();
  Progress progress("runs", runs);
  for (const ComparedScene& scene : scenes) {
    const RunData& bem = workshop.run(scene.text);
    progress.advance();
    table.rows.push_back(metrics_row(scene.title, "BEM", bem, compare(bem, bem)));
    for (const auto& [title, text] : scene.changed) {
      const RunData& run = workshop.run(text);
      table.rows.push_back(metrics_row(scene.title, "BEM, " + title, run, compare(bem, run)));
      progress.advance();
    }
    for (const MethodChoice& method : methods) {
      const RunData& run = workshop.run(scene.text, limited(workshop, scene.text, method));
      table.rows.push_back(metrics_row(scene.title, method.title, run, compare(bem, run)));
      progress.advance();
    }
  }
  return table;
}

ReportTable time_table(Workshop& workshop, const std::vector<ComparedScene>& scenes,
                       const std::vector<MethodChoice>& methods) {
  ReportTable table{"times",
                    "Triangles and seconds: COD is the time of finding the opening, fracture that of growth.",
                    {"scene", "tri", "method", "total", "COD", "fracture", "other", "frames", "COD/frame"},
                    {}};
  for (const ComparedScene& scene : scenes)
    for (const MethodChoice& method : with_solved(workshop, scene, methods)) {
      const RunDocument& d = workshop.run(scene.text, method).document;
      table.rows.push_back({scene.title, fmt::format("{}→{}", d.initial_triangles, d.final_triangles),
                            method.title, number_text(d.total_seconds), number_text(d.opening_seconds),
                            number_text(d.fracture_seconds), number_text(d.other_seconds),
                            fmt::format("{}", d.frames), number_text(d.opening_seconds_per_frame)});
    }
  return table;
}

std::vector<ReportPlot> intensity_plots(Workshop& workshop, const ComparedScene& scene,
                                        const std::vector<MethodChoice>& methods) {
  constexpr std::array kModes = {"I", "II", "III"};
  std::vector<ReportPlot> plots;
  for (std::size_t mode = 0; mode < 3; ++mode) {
    ReportPlot plot{fmt::format("{}: mean |K_{}| along the front", scene.title, kModes[mode]),
                    "frame",
                    fmt::format("|K_{}|, Pa√m", kModes[mode]),
                    false,
                    true,
                    {}};
    for (const MethodChoice& method : with_solved(workshop, scene, methods)) {
      PlotSeries series{method.title, {}, method.solve_every > 0};
      for (const auto& [frame, average] : front_averages(workshop.run(scene.text, method).front))
        series.points.push_back({static_cast<double>(frame), average.intensity[static_cast<int>(mode)]});
      plot.series.push_back(std::move(series));
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<ReportPlot> front_plots(Workshop& workshop, const ComparedScene& scene,
                                    const std::vector<MethodChoice>& methods) {
  const RunData& bem = workshop.run(scene.text);
  const double edge = setting(bem.document, "resolution.crack");
  ReportPlot distance{scene.title + ": distance of the front from that of boundary elements",
                      "frame",
                      "distance / r̄",
                      false,
                      false,
                      {}};
  ReportPlot area{scene.title + ": area of the crack", "frame", "area, m²", false, false, {}};
  for (const MethodChoice& method : with_solved(workshop, scene, methods)) {
    const RunData& run = workshop.run(scene.text, method);
    PlotSeries apart{method.title, {}, method.solve_every > 0}, grown = apart;
    for (const FrameComparison& f : compare_frames(bem, run))
      apart.points.push_back({static_cast<double>(f.frame), f.front_distance / edge});
    for (const FrameRecord& f : run.document.timings)
      grown.points.push_back({static_cast<double>(f.frame), f.crack_area});
    if (method.method != "bem") distance.series.push_back(std::move(apart));
    area.series.push_back(std::move(grown));
  }
  return {distance, area};
}

ReportPicture pieces_picture(Workshop& workshop, const std::string& name, const ComparedScene& scene,
                             const std::vector<MethodChoice>& methods) {
  std::vector<PicturePanel> panels;
  for (const MethodChoice& method : with_solved(workshop, scene, methods)) {
    const RunData& run = workshop.run(scene.text, method);
    panels.push_back(run_panel(run, workshop.run_folder(scene.text, method), {}));
    panels.back().title = method.title;
  }
  return {scene.title, write_panels(workshop, name, panels, scene.up)};
}

ReportPicture frames_picture(Workshop& workshop, const std::string& name, const ComparedScene& scene,
                             const MethodChoice& choice, int frames) {
  const MethodChoice method = limited(workshop, scene.text, choice);
  const RunData& run = workshop.run(scene.text, method);
  const std::vector<PicturePanel> panels =
      frame_panels(run, workshop.run_folder(scene.text, method), frames, {});
  return {scene.title + ", " + method.title + ": frames in progress",
          write_panels(workshop, name, panels, scene.up)};
}

}  // namespace conchoid
