#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "command.hpp"
#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/remesh/examine.hpp"
#include "conchoid/remesh/repair.hpp"
#include "json.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 5;

struct CheckCommand {
  std::string file, out;
  bool repair = false;
  double voxel = 0;
};

std::string name_of(RepairMethod method) {
  switch (method) {
    case RepairMethod::none:
      return "none";
    case RepairMethod::tidying:
      return "tidying";
    case RepairMethod::level_set:
      return "level-set";
  }
  return "";
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

std::string place(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

// --- as text
// ------------------------------------------------------------------------------------------------

template <class List, class Describe>
std::string listed(const List& list, const Describe& describe) {
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), most_listed); ++i)
    text += "\n    " + describe(list[i]);
  if (list.size() > most_listed) text += fmt::format("\n    and {} more", list.size() - most_listed);
  return text;
}

std::string part_text(const SurfacePart& part) {
  std::string text = fmt::format("{} triangles, area {:.6g}", part.triangles.size(), part.area);
  if (!part.closed) return text + ", open";
  text += fmt::format(", volume {:.6g}", part.volume);
  if (part.cavity()) text += ", inside another: a cavity";
  if (part.inside_out()) text += part.cavity() ? ", oriented outward" : ", inside-out";
  return text;
}

std::string size_text(const SurfaceReport& r) {
  const Vec3 extent = r.box.high - r.box.low;
  std::string text = fmt::format("\n  extent {:.6g} × {:.6g} × {:.6g}, from {} to {}", extent.x(), extent.y(),
                                 extent.z(), place(r.box.low), place(r.box.high));
  text += fmt::format("\n  unit: probably {} ({})", r.unit.unit, r.unit.why);
  text += fmt::format("\n  area {:.6g}, volume {:.6g}{}", r.area, r.volume,
                      r.holes.empty() ? "" : " with the holes filled");
  text += fmt::format("\n  edges {:.4g} to {:.4g}, mean {:.4g}; smallest angle {:.3g}°", r.shortest_edge,
                      r.longest_edge, r.mean_edge, degrees(r.smallest_angle));
  return text;
}

std::string defect_text(const SurfaceReport& r) {
  std::string text = fmt::format("\n  parts: {}{}", r.parts.size(), listed(r.parts, part_text));
  text += fmt::format("\n  holes: {}{}", r.holes.size(), listed(r.holes, [](const Hole& hole) {
                        return fmt::format("{} edges, length {:.6g}, about {}, at node {}", hole.edges,
                                           hole.length, place(hole.center), hole.first_node.value);
                      }));
  text += fmt::format("\n  self-intersections: {}{}{}", r.more_intersections ? "more than " : "",
                      r.intersections.size(), listed(r.intersections, [](const Intersection& at) {
                        return fmt::format("triangles {} and {}, near {}", at.s.value, at.t.value,
                                           place(at.where));
                      }));
  if (r.usable()) return text + "\n  a scene can use it as it is";
  text += "\n  a scene cannot use it as it is:";
  for (const auto& [kind, count] : r.defect_counts) {
    const auto first = std::find_if(r.defects.begin(), r.defects.end(),
                                    [k = kind](const MeshDefect& defect) { return defect.kind == k; });
    text += fmt::format("\n    {}{} {}: {}; {}", count, count == most_counted ? " or more" : "",
                        name_of(kind), first->what, first->remedy);
  }
  return text;
}

std::string plan_text(RepairMethod method, double voxel) {
  switch (method) {
    case RepairMethod::none:
      return "\n  --repair would change nothing";
    case RepairMethod::tidying:
      return "\n  --repair would move no point: merge nodes in one place, drop bad triangles, orient the "
             "rest";
    case RepairMethod::level_set:
      return fmt::format(
          "\n  --repair would fill the holes and make the surface anew through a level set, voxel {:.4g}",
          voxel);
  }
  return "";
}

std::string advice_text(const SurfaceReport& r) {
  if (!r.advice) return "";
  std::string text = "\n  suggested in a scene:";
  const double scale = r.unit.scale;
  if (scale != 1 || r.advice->remesh) text += "\n    [body]";
  if (scale != 1) text += fmt::format("\n    scale = {}", scale);
  if (r.advice->remesh) text += fmt::format("\n    remesh = {}", *r.advice->remesh);
  text += fmt::format("\n    [resolution]\n    crack = {:.3g}\n    surface = {:.3g}", r.advice->crack * scale,
                      r.advice->surface * scale);
  return text;
}

std::string repair_text(const Repair& repair, const std::string& out) {
  std::string text;
  if (repair.method == RepairMethod::none)
    return fmt::format("{}: unchanged, there is nothing to repair", out);
  const TidyReport& tidying = repair.tidying;
  text = fmt::format(
      "{}: {} triangles, {} nodes\n  {} nodes merged, {} triangles dropped, {} turned, {} unused nodes "
      "dropped",
      out, repair.mesh.triangle_count(), repair.mesh.node_count(), tidying.merged_nodes,
      tidying.removed_triangles, tidying.turned_triangles, tidying.removed_nodes);
  if (repair.method == RepairMethod::level_set)
    text += fmt::format(
        "\n  made anew through a level set: voxel {:.4g}, {} × {} × {} points, {} holes filled, {} specks "
        "dropped"
        "\n  the new surface is at most {:.4g} away from the old one and its filled holes; old nodes at most "
        "{:.4g} "
        "from the new surface",
        repair.voxel, repair.lattice[0], repair.lattice[1], repair.lattice[2], repair.filled_holes,
        repair.dropped_specks, repair.moved, repair.lost);
  else
    text += "\n  no point has moved";
  return text +
         fmt::format("\n  volume {:.6g} before, {:.6g} after", repair.volume_before, repair.volume_after);
}

// --- as JSON
// ------------------------------------------------------------------------------------------------

using Json = nlohmann::ordered_json;

Json report_json(const CheckCommand& command, const SurfaceReport& r) {
  Json json = {
      {"file", command.file},
      {"triangles", r.triangles},
      {"nodes", r.nodes},
      {"box", {{"low", to_json(r.box.low)}, {"high", to_json(r.box.high)}}},
      {"area", r.area},
      {"volume", r.volume},
      {"unit", {{"guess", r.unit.unit}, {"scale", r.unit.scale}, {"why", r.unit.why}}},
      {"edges", {{"shortest", number(r.shortest_edge)}, {"mean", r.mean_edge}, {"longest", r.longest_edge}}},
      {"smallest_angle", number(degrees(r.smallest_angle))}};
  json["parts"] = Json::array();
  for (const SurfacePart& part : r.parts)
    json["parts"].push_back({{"triangles", part.triangles.size()},
                             {"closed", part.closed},
                             {"volume", part.closed ? Json(part.volume) : Json(nullptr)},
                             {"area", part.area},
                             {"cavity", part.cavity()},
                             {"inside_out", part.closed && part.inside_out()}});
  json["holes"] = Json::array();
  for (const Hole& hole : r.holes)
    json["holes"].push_back(
        {{"edges", hole.edges}, {"length", hole.length}, {"center", to_json(hole.center)}});
  Json first = Json::array();
  for (std::size_t i = 0; i < std::min(r.intersections.size(), most_listed); ++i) {
    const Intersection& at = r.intersections[i];
    first.push_back({{"triangles", {at.s.value, at.t.value}}, {"where", to_json(at.where)}});
  }
  json["self_intersections"] = {
      {"count", r.intersections.size()}, {"more", r.more_intersections}, {"first", first}};
  json["defects"] = Json::object();
  for (const auto& [kind, count] : r.defect_counts)
    json["defects"][name_of(kind)] = count;
  json["usable"] = r.usable();
  return json;
}

void add_advice(Json& json, const SurfaceReport& r) {
  json["advice"] = nullptr;
  if (!r.advice) return;
  json["advice"] = {{"crack", r.advice->crack}, {"surface", r.advice->surface}, {"remesh", nullptr}};
  if (r.advice->remesh) json["advice"]["remesh"] = *r.advice->remesh;
}

Json repair_json(const Repair& repair, const std::string& out) {
  Json json = {{"method", name_of(repair.method)},
               {"out", out},
               {"triangles", repair.mesh.triangle_count()},
               {"merged_nodes", repair.tidying.merged_nodes},
               {"removed_triangles", repair.tidying.removed_triangles},
               {"turned_triangles", repair.tidying.turned_triangles},
               {"removed_nodes", repair.tidying.removed_nodes},
               {"volume_before", repair.volume_before},
               {"volume_after", repair.volume_after}};
  if (repair.method != RepairMethod::level_set) return json;
  json["voxel"] = repair.voxel;
  json["lattice"] = repair.lattice;
  json["filled_holes"] = repair.filled_holes;
  json["dropped_specks"] = repair.dropped_specks;
  json["moved"] = repair.moved;
  json["lost"] = repair.lost;
  return json;
}

// --- the work
// -----------------------------------------------------------------------------------------------

/// .stl keeps single precision, in which thin triangles may meet.
void require_that_format_keeps_it(const fs::path& out, TriMesh mesh) {
  std::string ending = out.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c == 'S' || c == 'T' || c == 'L' ? static_cast<char>(c + 32) : c; });
  if (ending != ".stl") return;
  for (Vec3& x : mesh.positions)
    x = x.cast<float>().cast<double>();
  if (!find_defects(mesh, 1).empty())
    throw ComputationError(out.string() +
                           ": the single precision of .stl would bring defects back; write .ply instead");
}

void write_repaired(const CheckCommand& command, const Repair& repair) {
  const fs::path from = command.file, to = command.out;
  if (repair.method != RepairMethod::none || from.extension() != to.extension()) {
    require_that_format_keeps_it(to, repair.mesh);
    return write_mesh(to, repair.mesh);
  }
  std::error_code none;
  if (fs::equivalent(from, to, none)) return;
  std::ifstream in(from, std::ios::binary);
  AtomicFile file(to);
  file.stream() << in.rdbuf();
  file.commit();
}

void check_and_print(const CheckCommand& command, const CommonOptions& common) {
  const TriMesh mesh = read_mesh(command.file);
  const SurfaceReport report = examine(mesh);
  Json json = report_json(command, report);
  std::string text = fmt::format("{}: {} triangles, {} nodes", command.file, report.triangles, report.nodes);
  if (report.triangles > 0) text += size_text(report);
  text += defect_text(report);
  if (command.repair) {
    const Repair repair = repaired(mesh, command.voxel);
    write_repaired(command, repair);
    json["repair"] = repair_json(repair, command.out);
    text += advice_text(report) + "\n" + repair_text(repair, command.out);
  } else {
    const RepairMethod method = report.usable() ? RepairMethod::none : needed_repair(mesh);
    json["repair"] = {{"method", name_of(method)}};
    if (method == RepairMethod::level_set) json["repair"]["voxel"] = default_voxel(mesh);
    if (report.triangles > 0) text += plan_text(method, default_voxel(mesh));
    text += advice_text(report);
  }
  add_advice(json, report);
  print(common.json ? json.dump() : text);
  if (!command.repair && !report.usable())
    throw ComputationError(command.file + ": a scene cannot use it as it is; repair it with conchoid check " +
                           command.file + " --repair --out FIXED.ply");
}

}  // namespace

void add_check(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CheckCommand>();
  CLI::App* command =
      add_command(program, invocation, "check", "Tell what a mesh file is like, and repair it",
                  [options, &invocation] { check_and_print(*options, invocation.common); });
  command->add_option("FILE", options->file, "mesh file: .ply, .obj, .stl or .off")->required();
  CLI::Option* repair =
      command->add_flag("--repair", options->repair, "write a mesh that a scene accepts, with least change");
  CLI::Option* out = command->add_option("--out", options->out, "repaired mesh: .ply, .obj, .stl or .off");
  CLI::Option* voxel = command->add_option(
      "--voxel", options->voxel,
      "edge of a voxel in the unit of the file, > 0; without it the longest extent / 200");
  voxel->check(CLI::PositiveNumber);
  repair->needs(out);
  out->needs(repair);
  voxel->needs(repair);
  command->footer(
      "Exit status: 0 a scene can use the mesh (or it was repaired), 1 it has defects, 2 it cannot be read.");
}

}  // namespace conchoid
