#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/summary.hpp"
#include "conchoid/sim/generate.hpp"
#include "conchoid/sim/settings.hpp"

namespace conchoid {
namespace {

struct DatabaseOptions {
  std::vector<std::string> files;
  std::string out, spec, cache, shard = "1/1";
  int runs = 0;  ///< 0: the specification's
  bool resume = false, close = false;
};

/// "2/5": shard 2 of 5.
std::pair<int, int> parse_shard(const std::string& text) {
  int shard = 0, shards = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%d/%d%c", &shard, &shards, &end) != 2 || shard < 1 || shard > shards)
    throw InputError(fmt::format("--shard {}: must be I/N with 1 ≤ I ≤ N, for instance 2/5", text));
  return {shard, shards};
}

/// One file as it is, several merged in memory.
Database read_files(const DatabaseOptions& options) {
  if (options.files.size() == 1) return read_database(options.files.front());
  return merge_databases({options.files.begin(), options.files.end()});
}

std::string info_text(const DatabaseInfo& info) {
  std::string text = fmt::format(
      "models      {}\nruns        {} of {}{}\nexcluded    {}\nsamples     {}, of which {} to be learned "
      "from, {} by versatile alone\n"
      "resolution  {:g} m\nmaterial    E {:g} Pa, ν {:g}, K_c {:g} Pa√m\nframes      {:.1f} per run\nstops   "
      "   ",
      fmt::join(info.header.models, ", "), info.runs, info.header.planned_here(),
      info.complete ? "" : " (incomplete: go on with database generate --resume)", info.excluded_runs,
      info.samples, info.training_samples, info.end_game_samples + info.new_node_samples,
      info.header.resolution, info.header.material.youngs_modulus, info.header.material.poisson_ratio,
      info.header.material.toughness, info.mean_frames);
  for (const auto& [stop, count] : info.stops)
    text += fmt::format(" {} {}", count, stop);
  for (const auto& [reason, count] : info.exclusions)
    text += fmt::format("\nexcluded    {} × {}", count, reason);
  return text;
}

std::string statistics_text(const DatabaseStatistics& statistics) {
  std::string text = fmt::format("{} samples\n          median          mean       coefficient of variation",
                                 statistics.samples);
  constexpr std::array kNames = {"K_I  ", "K_II ", "K_III"};
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const Statistics& s = statistics.K[mode];
    text += fmt::format("\n{}  {:13.4e} {:13.4e} {:13.4g}   Pa√m", kNames[mode], s.median, s.mean,
                        s.coefficient_of_variation);
  }
  return text;
}

void merge_and_print(const DatabaseOptions& options, const CommonOptions& common) {
  const Database merged = merge_databases({options.files.begin(), options.files.end()});
  write_database(options.out, merged);
  const DatabaseInfo info = database_info(merged);
  print(common.json ? json_text(info) : info_text(info));
}

void generate_and_print(const DatabaseOptions& options, const CommonOptions& common) {
  const auto [shard, shards] = parse_shard(options.shard);
  DatabaseSpec spec = read_database_spec(options.spec);
  if (options.runs > 0) spec.runs = options.runs;
  spec.scene.run.cache = open_cache(options.cache);
  std::optional<Ranks> ranks;
  if (Ranks::launched()) ranks.emplace();
  generate_database(spec, {.out = options.out,
                           .shard = shard,
                           .shards = shards,
                           .resume = options.resume || options.close,
                           .close = options.close,
                           .ranks = ranks ? &*ranks : nullptr});
  if (ranks && ranks->rank() > 0) return;
  const DatabaseInfo info = database_info(read_database(options.out));
  print(common.json ? json_text(info) : info_text(info));
}

void add_generate(CLI::App& group, Invocation& invocation, const std::shared_ptr<DatabaseOptions>& options) {
  CLI::App* command = add_command(
      group, invocation, "generate", "Run many scenes under random loads, keep what their fronts did",
      [options, &invocation] { generate_and_print(*options, invocation.common); });
  command->add_option("SPEC", options->spec, "specification: a scene with a table [database] (TOML)")
      ->required();
  command
      ->add_option("--out", options->out, "database file to write (HDF5); finished runs wait in FILE.parts")
      ->required();
  command->add_option("--runs", options->runs, "number of runs, in place of the specification's")
      ->check(CLI::Range(1, 10000000));
  command
      ->add_option("--shard", options->shard,
                   "I/N: make only every N-th run, starting with the I-th; merge the files later")
      ->capture_default_str();
  add_cache_option(*command, options->cache);
  command->add_flag("--resume", options->resume, "go on with what FILE and FILE.parts hold");
  command->add_flag("--close", options->close,
                    "make no more runs: write FILE from those that are finished, fewer than planned");
  command->footer(settings_text(true));
}

}  // namespace

void add_database(CLI::App& program, Invocation& invocation) {
  CLI::App* group = program.add_subcommand("database", "Make and look at databases of samples");
  allow_one_command(*group);
  const auto options = std::make_shared<DatabaseOptions>();
  add_generate(*group, invocation, options);
  const auto add_files = [options](CLI::App* command, int least) {
    command->add_option("FILE", options->files, "database file (HDF5)")->required()->expected(least, 100000);
  };

  add_files(add_command(*group, invocation, "info", "Runs, samples, material, exclusions",
                        [options, &invocation] {
                          const DatabaseInfo info = database_info(read_files(*options));
                          print(invocation.common.json ? json_text(info) : info_text(info));
                        }),
            1);
  add_files(add_command(*group, invocation, "stats", "Median, mean and variation of K_I, K_II, K_III",
                        [options, &invocation] {
                          const DatabaseStatistics s = database_statistics(read_files(*options));
                          print(invocation.common.json ? json_text(s) : statistics_text(s));
                        }),
            1);
  CLI::App* merge = add_command(*group, invocation, "merge", "Join the shards of one specification",
                                [options, &invocation] { merge_and_print(*options, invocation.common); });
  add_files(merge, 2);
  merge->add_option("--out", options->out, "database file to write")->required();
}

}  // namespace conchoid
