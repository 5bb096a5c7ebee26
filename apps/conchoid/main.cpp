#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "command.hpp"
#include "conchoid/core/blas_kernels.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/terminal_sink.hpp"
#include "signals.hpp"

namespace conchoid {
namespace {

enum ExitStatus { kDone = 0, kFailed = 1, kBadInput = 2 };

int carry_out(const Invocation& invocation) {
  try {
    ExecutionContext context(invocation.common.threads,
                             std::make_shared<TerminalSink>(invocation.common.quiet));
    const StopOnSignals stop_on_signals(context);
    context.run(invocation.action);
    return kDone;
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return kBadInput;
  } catch (const Interrupted& stop) {
    std::cerr << stop.what() << '\n';
  } catch (const ComputationError& error) {
    std::cerr << "failed: " << error.what() << '\n';
  } catch (const WriteError& error) {
    std::cerr << "failed: " << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    std::cerr << "failed: not enough memory; use fewer triangles (body.remesh, resolution.crack) or a larger "
                 "machine\n";
  } catch (const std::exception& error) {
    std::cerr << "failed: " << error.what()
              << "; this is a mistake in conchoid, please report it with the scene\n";
  }
  return kFailed;
}

/// Memory that was freed is used again instead of being given back to the system and zeroed anew: meshes come and go.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that it takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

int run_program(int argc, char** argv) {
  keep_freed_memory();
  use_common_blas_kernels();
  CLI::App program("Brittle fracture by boundary elements and by prediction. Everything is SI.", "conchoid");
  program.set_version_flag("--version", CONCHOID_VERSION);
  program.footer(
      "Exit status: 0 done, 1 the computation failed, 2 bad usage or bad input.\n"
      "conchoid COMMAND --help tells more; conchoid help-scene lists the keys of a scene, conchoid materials "
      "the "
      "materials it can name.");
  program.get_formatter()->column_width(34);
  Invocation invocation;
  allow_one_command(program);
  add_run(program, invocation);
  add_sif(program, invocation);
  add_stress(program, invocation);
  add_mesh(program, invocation);
  add_check(program, invocation);
  add_compare(program, invocation);
  add_picture(program, invocation);
  add_database(program, invocation);
  add_forest(program, invocation);
  add_reproduce(program, invocation);
  add_materials(program, invocation);
  add_help_scene(program, invocation);
  add_help(program, invocation);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = program.exit(error, std::cout, std::cerr);
    return status == 0 ? kDone : kBadInput;
  }
  if (!invocation.action) {
    const auto chosen = program.get_subcommands();
    std::cerr << "error: a command is missing\n" << (chosen.empty() ? program : *chosen.front()).help();
    return kBadInput;
  }
  return carry_out(invocation);
}

}  // namespace
}  // namespace conchoid

int main(int argc, char** argv) {
  return conchoid::run_program(argc, argv);
}
