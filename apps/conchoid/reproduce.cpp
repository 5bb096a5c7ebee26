#include "conchoid/study/experiments/reproduce.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

struct ReproduceCommand {
  ReproduceOptions options;
  std::string scale = "smoke", out, armadillo;
  bool list = false;
};

void print_list(bool json) {
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const Experiment& e : experiments())
      list.push_back({{"name", e.name}, {"title", e.title}, {"needs_armadillo", e.needs_armadillo}});
    return print(nlohmann::ordered_json{{"experiments", list}}.dump());
  }
  std::string text;
  for (const Experiment& e : experiments())
    text += fmt::format("{}{:<12}{}{}", text.empty() ? "" : "\n", e.name, e.title,
                        e.needs_armadillo ? " (needs --armadillo)" : "");
  print(text);
}

std::string report_text(const StudyReport& report) {
  std::string text;
  for (const Reproduction& made : report.made)
    text += fmt::format("{:<12}{:8.1f} s  {}\n", made.experiment->name, made.seconds, made.experiment->title);
  return text + report.file.string();
}

void reproduce_and_print(ReproduceCommand command, const CommonOptions& common) {
  if (command.list) return print_list(common.json);
  if (command.out.empty())
    throw InputError("reproduce writes a report; name its folder with --out DIR, or use --list");
  command.options.scale = study_scale_from_name(command.scale);
  command.options.folder = command.out;
  command.options.armadillo = command.armadillo;
  const StudyReport report = reproduce(command.options);
  print(common.json ? study_json(report) : report_text(report));
  for (const Reproduction& made : report.made)
    if (!made.failure.empty())
      throw ComputationError(fmt::format("{} could not be made; the report tells why, and has the others",
                                         made.experiment->name));
}

}  // namespace

void add_reproduce(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<ReproduceCommand>();
  CLI::App* command = add_command(
      program, invocation, "reproduce", "Make the published study again: tables, figures, a report",
      [options, &invocation] { reproduce_and_print(*options, invocation.common); });
  command->add_option("EXPERIMENT", options->options.names,
                      "table-1, figure-5, … (--list shows all); none: all of them");
  command
      ->add_option("--scale", options->scale,
                   "smoke: small databases, minutes; full: the published sizes, days")
      ->check(CLI::IsMember({"smoke", "full"}))
      ->capture_default_str();
  command->add_option(
      "--out", options->out,
      "folder for report.html, tables/ and figures/, and for cache/, which a later call goes on from");
  command->add_option(
      "--armadillo", options->armadillo,
      "the scan of the Stanford Armadillo (99,976 triangles), for the experiments that need it");
  command->add_flag("--list", options->list, "the experiments, and nothing is made");
}

}  // namespace conchoid
