#include "conchoid/sim/run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <memory>

#include "command.hpp"
#include "conchoid/bem/body_solver.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/sim/make_runs.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/settings.hpp"

namespace conchoid {
namespace {

/// In place of a database: hybrid runs then go by a closed form.
constexpr std::string_view kNoDatabase = "none";

struct RunCommand {
  std::string scene, method = "bem", database, out, cache, solver = body_solver_names().front();
  std::vector<std::string> formats;  ///< empty: the scene's
  int frames = 0;                    ///< 0: the scene's
  int run = -1;                      ///< of a database's specification; -1: a scene
  bool resume = false;
  double tolerance = kStandardTolerance;
  bool has_tolerance = false;
};

std::string load_text(const RunDocument& d) {
  std::string text;
  if (!d.stop_details.empty()) text += "\n" + d.stop_details;
  if (d.expected_error)
    text += fmt::format("\n{} of {} frames solved, expected error of the surface {:.2f} % of the diagonal",
                        d.solved_frames, d.frames, 100 * *d.expected_error);
  text += fmt::format("\ncrack area {:.6g} m²", d.crack_area);
  if (d.largest_K_over_Kc) text += fmt::format(", largest K {:.3g} K_c", *d.largest_K_over_Kc);
  if (d.stress_over_strength)
    text += fmt::format(", largest stress at the start {:.3g} × strength", *d.stress_over_strength);
  return text;
}

std::string report_text(const RunDocument& d) {
  std::string text = fmt::format(
      "{} after {} frames, {} → {} triangles{}\n"
      "{:.3f} s: opening {:.3f}, fracture {:.3f}, other {:.3f}; opening per frame {:.4f}",
      name(d.stop), d.frames, d.initial_triangles, d.final_triangles, load_text(d), d.total_seconds,
      d.opening_seconds, d.fracture_seconds, d.other_seconds, d.opening_seconds_per_frame);
  for (std::size_t i = 0; i < d.fragments.size(); ++i)
    text += fmt::format("\nfragment {}: {:.6g} m³, {:.6g} kg, fracture area {:.6g} m², {}", i,
                        d.fragments[i].volume, d.fragments[i].mass, d.fragments[i].fracture_area,
                        d.fragments[i].watertight ? "watertight" : "not watertight");
  return text + "\nhash " + d.hash;
}

/// What is to be run: a scene, or one run of a specification, whose text then tells which.
PreparedRun run_of(const RunCommand& command) {
  const auto set = [&, cache = open_cache(command.cache)](Scene& scene) {
    scene.run.solver = command.solver;
    scene.run.cache = cache;
  };
  if (command.run < 0) {
    PreparedRun out{read_scene(command.scene), nullptr, {}};
    set(out.scene);
    return out;
  }
  DatabaseSpec spec = read_database_spec(command.scene);
  set(spec.scene);
  PreparedRun out = prepare_run(spec, command.run);
  set(out.scene);
  out.scene.file = command.scene;
  out.scene.text = fmt::format("{}\n# run {}\n", spec.scene.text, command.run);
  return out;
}

/// The finished run of the same scene that the folder holds, if there is one. A regressor is not recorded
/// well enough to know that it is the same: such runs are made again.
std::optional<RunDocument> finished_run(const RunCommand& command, const Scene& scene,
                                        const RunOptions& options) {
  const std::filesystem::path file = std::filesystem::path(command.out) / "run.json";
  if (!command.resume || !std::filesystem::exists(file) || options.regressor) return std::nullopt;
  RunDocument document = read_run_json(file);
  if (document.scene_text != scene.text || document.method != options.method)
    throw InputError(file.string() +
                     ": belongs to another scene or method; name another folder, or leave out --resume");
  const std::int64_t frames = options.frames.value_or(scene.run.frames);
  const std::string formats =
      fmt::format("{}", fmt::join(options.formats.value_or(scene.output.formats), ","));
  for (const RunSetting& s : document.settings) {
    if (s.name == "run.frames" && s.value != RunSetting{s.name, frames}.value) return std::nullopt;
    const double tolerance = options.tolerance.value_or(kStandardTolerance);
    if (s.name == "run.tolerance" && s.value != tolerance_setting(tolerance).value) return std::nullopt;
    if (s.name == "output.formats" && s.value != RunSetting{s.name, formats}.value) return std::nullopt;
  }
  if (document.stop == StopReason::interrupted) return std::nullopt;
  return document;
}

void run_and_print(const RunCommand& command, const CommonOptions& common) {
  RunOptions options;
  options.method = command.method;
  if (command.frames > 0) options.frames = command.frames;
  if (!command.out.empty()) options.folder = command.out;
  if (!command.formats.empty()) options.formats = command.formats;
  if (command.has_tolerance) options.tolerance = command.tolerance;
  options.resume = command.resume;
  if (command.resume && command.out.empty()) throw InputError("--resume needs the run folder: add --out DIR");
  std::unique_ptr<Regressor> regressor;
  std::string database = command.database;
  const OpeningMethod& method = opening_method(command.method);
  if (database.empty()) database = standard_database(method.shipped_kind());
  if (method.hybrid && database == kNoDatabase) database.clear();
  if (!database.empty()) regressor = load_regressor(database_file(database, method.shipped_kind()));
  options.regressor = regressor.get();
  checked_method(options.method, options.regressor, options.tolerance);
  const PreparedRun run = run_of(command);
  std::optional<RunDocument> document = finished_run(command, run.scene, options);
  if (document)
    message(command.out + ": finished already; reported again");
  else
    document =
        (run.body ? run_prepared(run.scene, run.body, options) : run_scene(run.scene, options)).document;
  print(common.json ? run_json(*document, RunJson::report) : report_text(*document));
  if (document->stop == StopReason::interrupted)
    throw Interrupted("stopped on request; what was computed so far has been kept");
}

}  // namespace

void add_run(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<RunCommand>();
  CLI::App* command =
      add_command(program, invocation, "run", "Fracture a body: solve or predict, grow, cut into pieces",
                  [options, &invocation] { run_and_print(*options, invocation.common); });
  std::vector<std::string> names;
  std::string help, trained;
  for (const OpeningMethod& method : opening_methods()) {
    names.push_back(method.name);
    help += (help.empty() ? "" : "; ") + method.name + " " + method.help;
    if (!method.regressor.empty()) trained += (trained.empty() ? "" : " or ") + method.name;
  }
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command
      ->add_option("--run", options->run,
                   "SCENE is a specification as for database generate: the run of that number, from 0 on")
      ->check(CLI::Range(0, 9999999));
  command->add_option("--method", options->method, "where the crack opening comes from: " + help)
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command
      ->add_option(
          "--solver", options->solver,
          "how the uncracked body is solved: by factors, or by conjugate gradients on products alone, "
          "which gives the same to rounding and is slower")
      ->check(CLI::IsMember(body_solver_names()))
      ->capture_default_str();
  command->add_option(
      "--database", options->database,
      fmt::format(
          "for --method hybrid or {}: {}, which come with conchoid, or a file written by conchoid "
          "forest train; a name without a kind is of the kind of the method, of networks for hybrid; "
          "without it forest, boosted, network and hybrid take {}; hybrid with {} predicts as kept does",
          trained, fmt::join(shipped_names(), ", "), standard_database("forest"), kNoDatabase));
  command
      ->add_option("--tolerance", options->tolerance,
                   "of --method hybrid: error that is to be expected of the crack surface at most, over the "
                   "body's diagonal; 0: every frame is solved, inf: none after the first")
      ->each([options](const std::string&) { options->has_tolerance = true; })
      ->check(CLI::Range(0.0, std::numeric_limits<double>::infinity()))
      ->capture_default_str();
  add_cache_option(*command, options->cache);
  command->add_option("--frames", options->frames, "most frames, in place of the scene's")
      ->check(CLI::Range(1, 100000));
  command->add_option("--out", options->out, "run folder to write; without it nothing is written");
  command
      ->add_option("--format", options->formats,
                   "files of the pieces, in place of the scene's output.formats, with commas between")
      ->delimiter(',')
      ->check(CLI::IsMember(fragment_format_names()));
  command->add_flag(
      "--resume", options->resume,
      "go on where a run of the same scene in the folder was stopped; report a finished one again");
  command->footer(settings_text(false));
}

}  // namespace conchoid
