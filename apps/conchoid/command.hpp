#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "conchoid/core/byte_cache.hpp"

namespace CLI {
class App;
}

namespace conchoid {

/// What every sub-command offers.
struct CommonOptions {
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

/// What the command line asked for: options and the work to do. Parsing fills it in, main() carries it out.
struct Invocation {
  CommonOptions common;
  std::function<void()> action;
};

/// Adds a sub-command with --threads, --quiet and --json to `parent`; `action` runs when it is chosen.
CLI::App* add_command(CLI::App& parent, Invocation& invocation, const std::string& name,
                      const std::string& help, std::function<void()> action);

/// One command and no more: what follows it is never taken for another, be it a folder of that name.
void allow_one_command(CLI::App& parent);

/// --cache DIR of what prepares bodies; `folder` stays empty without it.
void add_cache_option(CLI::App& command, std::string& folder);
/// The folder's cache, or null for an empty name. Throws InputError where it cannot be made.
std::shared_ptr<const ByteCache> open_cache(const std::string& folder);

/// Adds the argument FILE, a regressor: a file, or the name of one that comes with the program (learn/shipped.hpp).
void add_regressor_argument(CLI::App& command, std::string& file);

/// Names of the modes of fracture, as in every output.
inline constexpr std::array kModes = {"I", "II", "III"};

/// Writes text and a line end to stdout. Throws ComputationError when that fails (closed pipe, full disk).
void print(const std::string& text);

// One per file named after it.
void add_check(CLI::App& program, Invocation& invocation);
void add_compare(CLI::App& program, Invocation& invocation);
void add_database(CLI::App& program, Invocation& invocation);
void add_forest(CLI::App& program, Invocation& invocation);
void add_forest_evaluate(CLI::App& group, Invocation& invocation);
void add_forest_inspect(CLI::App& group, Invocation& invocation);
void add_help(CLI::App& program, Invocation& invocation);
void add_help_scene(CLI::App& program, Invocation& invocation);
void add_materials(CLI::App& program, Invocation& invocation);
void add_mesh(CLI::App& program, Invocation& invocation);
void add_picture(CLI::App& program, Invocation& invocation);
void add_reproduce(CLI::App& program, Invocation& invocation);
void add_run(CLI::App& program, Invocation& invocation);
void add_sif(CLI::App& program, Invocation& invocation);
void add_stress(CLI::App& program, Invocation& invocation);

}  // namespace conchoid
