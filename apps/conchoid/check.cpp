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
#include "conchoid/core/make_folder.hpp"
#include "conchoid/formats/formats.hpp"
#include "conchoid/mesh/carry_attributes.hpp"
#include "conchoid/remesh/examine.hpp"
#include "conchoid/remesh/repair.hpp"
#include "conchoid/remesh/separate_bodies.hpp"
#include "conchoid/remesh/weld.hpp"
#include "json.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 5;

struct CheckCommand {
  std::string file, out, split;
  bool repair = false;
  double voxel = 0;
};

std::string name_of(RepairMethod method, bool was_welded) {
  switch (method) {
    case RepairMethod::none:
      return was_welded ? "welding" : "none";
    case RepairMethod::tidying:
      return "tidying";
    case RepairMethod::mending:
      return "mending";
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
  if (r.usable() && r.bodies != 1)
    return text + fmt::format(
                      "\n  a scene cannot use it as it is: it holds {} separate bodies, and a scene takes "
                      "one; --split DIR writes them apart",
                      r.bodies);
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

std::string walls_text(const SurfaceReport& r) {
  return r.coarse_walls ? "\n  thin walls: " + r.coarse_walls->text_of_auto() : std::string();
}

std::string plan_text(RepairMethod method, double voxel) {
  switch (method) {
    case RepairMethod::none:
      return "\n  --repair would change nothing";
    case RepairMethod::tidying:
      return "\n  --repair would move no point: merge nodes in one place, drop bad triangles, orient the "
             "rest";
    case RepairMethod::mending:
      return "\n  --repair would mend it where it is bad and leave the rest alone";
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

std::string repair_text(const Repair& repair, const std::string& out, bool was_welded) {
  std::string text;
  if (repair.method == RepairMethod::none && was_welded)
    return fmt::format("{}: {} triangles, {} nodes, welded as said above; nothing else was to repair", out,
                       repair.mesh.triangle_count(), repair.mesh.node_count());
  if (repair.method == RepairMethod::none)
    return fmt::format("{}: unchanged, there is nothing to repair", out);
  text =
      fmt::format("{}: {} triangles, {} nodes", out, repair.mesh.triangle_count(), repair.mesh.node_count());
  if (repair.method == RepairMethod::mending) {
    text += "\n  mended where it was bad: " + repair.mending.text();
  } else {
    const TidyReport& tidying = repair.tidying;
    text += fmt::format("\n  {} nodes merged, {} triangles dropped, {} turned, {} unused nodes dropped",
                        tidying.merged_nodes, tidying.removed_triangles, tidying.turned_triangles,
                        tidying.removed_nodes);
  }
  if (repair.method == RepairMethod::level_set)
    text += fmt::format(
        "\n  made anew through a level set: voxel {:.4g}, {} × {} × {} points, {} holes filled, {} specks "
        "dropped, {} triangles simplified to {}"
        "\n  the new surface is at most {:.4g} away from the old one and its filled holes; old nodes at most "
        "{:.4g} "
        "from the new surface",
        repair.voxel, repair.lattice[0], repair.lattice[1], repair.lattice[2], repair.filled_holes,
        repair.dropped_specks, repair.lattice_triangles, repair.mesh.triangle_count(), repair.moved,
        repair.lost);
  else if (repair.method == RepairMethod::tidying)
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
  json["bodies"] = r.bodies;
  json["usable"] = r.usable() && r.bodies == 1;
  return json;
}

void add_walls(Json& json, const SurfaceReport& r) {
  json["thin_walls"] = nullptr;
  if (!r.coarse_walls) return;
  const CoarseWalls& walls = *r.coarse_walls;
  json["thin_walls"] = {
      {"share", walls.share},
      {"edge", walls.edge},
      {"thickness", walls.thickness},
      {"elements", walls.quadratic_by_themselves() ? "quadratic" : "linear"},
      {"shown_bending", walls.quadratic_by_themselves() ? walls.shown_by_quadratic() : walls.shown},
      {"wanted_edge", walls.quadratic_edge},
      {"wanted_triangles", walls.quadratic_triangles},
      {"text", walls.text_of_auto()}};
}

void add_advice(Json& json, const SurfaceReport& r) {
  json["advice"] = nullptr;
  if (!r.advice) return;
  json["advice"] = {{"crack", r.advice->crack}, {"surface", r.advice->surface}, {"remesh", nullptr}};
  if (r.advice->remesh) json["advice"]["remesh"] = *r.advice->remesh;
}

Json repair_json(const Repair& repair, const std::string& out, bool was_welded) {
  Json json = {{"method", name_of(repair.method, was_welded)},
               {"out", out},
               {"triangles", repair.mesh.triangle_count()},
               {"merged_nodes", repair.tidying.merged_nodes},
               {"removed_triangles", repair.tidying.removed_triangles},
               {"turned_triangles", repair.tidying.turned_triangles},
               {"removed_nodes", repair.tidying.removed_nodes},
               {"volume_before", repair.volume_before},
               {"volume_after", repair.volume_after}};
  if (repair.method == RepairMethod::mending) {
    const MendReport& m = repair.mending;
    json["mending"] = {{"welded_nodes", m.weld.nodes},     {"welded_distance", m.weld.farthest},
                       {"dropped_triangles", m.dropped},   {"flipped_triangles", m.flipped},
                       {"filled_holes", m.filled_holes},   {"inner_wall_triangles", m.inner_walls},
                       {"split_nodes", m.split_nodes},     {"flat_parts", m.flat_parts},
                       {"united_bodies", m.united_bodies}, {"replaced_triangles", m.cut_triangles}};
  }
  if (repair.method != RepairMethod::level_set) return json;
  json["lattice_triangles"] = repair.lattice_triangles;
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

void write_repaired(const CheckCommand& command, const AttributedMesh& surface, const Repair& repair,
                    bool is_as_read) {
  const fs::path from = command.file, to = command.out;
  if (!is_as_read || repair.method != RepairMethod::none || from.extension() != to.extension()) {
    require_that_format_keeps_it(to, repair.mesh);
    return write_surface(to, {repair.mesh, carried_over(surface, repair.mesh)});
  }
  std::error_code none;
  if (fs::equivalent(from, to, none)) return;
  std::ifstream in(from, std::ios::binary);
  AtomicFile file(to);
  file.stream() << in.rdbuf();
  file.commit();
}

/// One file per body, with the cavities in it, in the order in which they come in the file.
std::vector<std::string> write_bodies(const CheckCommand& command, const AttributedMesh& surface) {
  std::vector<std::string> files;
  make_folder(command.split, "--split");
  std::string ending = fs::path(command.file).extension().string();
  if (ending != ".obj" && ending != ".off" && ending != ".stl") ending = ".ply";
  for (const std::vector<TriId>& triangles : separate_bodies(surface.mesh)) {
    const TriMesh body = submesh(surface.mesh, triangles);
    const fs::path file =
        fs::path(command.split) /
        fmt::format("{}_{}{}", fs::path(command.file).stem().string(), files.size(), ending);
    require_that_format_keeps_it(file, body);
    write_surface(file, {body, attributes_of(surface.attributes, triangles)});
    files.push_back(file.string());
  }
  return files;
}

std::string unusable_text(const CheckCommand& command, const SurfaceReport& report) {
  if (report.usable())
    return fmt::format(
        "{}: holds {} separate bodies, and a scene takes one; write them apart with conchoid check "
        "{} --split DIR",
        command.file, report.bodies, command.file);
  return command.file + ": a scene cannot use it as it is; repair it with conchoid check " + command.file +
         " --repair --out FIXED.ply";
}

void check_and_print(const CheckCommand& command, const CommonOptions& common) {
  WeldReport weld;
  const AttributedMesh surface = welded_if_it_helps(read_surface(command.file), weld);
  const TriMesh& mesh = surface.mesh;
  const SurfaceReport report = examine(mesh);
  Json json = report_json(command, report);
  json["welded"] = {{"nodes", weld.nodes}, {"farthest", weld.farthest}, {"share_of_edge", weld_share}};
  std::string text = fmt::format("{}: {} triangles, {} nodes", command.file, report.triangles, report.nodes);
  if (weld.nodes > 0)
    text += fmt::format("\n  {} nodes welded, at most {:.3g} apart, less than {} of the edges there",
                        weld.nodes, weld.farthest, weld_share);
  if (report.triangles > 0) text += size_text(report);
  text += defect_text(report) + walls_text(report);
  bool fits_a_scene = report.usable() && report.bodies == 1;
  AttributedMesh bodies = surface;
  if (command.repair) {
    const Repair repair = repaired(mesh, command.voxel);
    write_repaired(command, surface, repair, weld.nodes == 0);
    json["repair"] = repair_json(repair, command.out, weld.nodes > 0);
    text += advice_text(report) + "\n" + repair_text(repair, command.out, weld.nodes > 0);
    bodies = {repair.mesh, carried_over(surface, repair.mesh)};
    const std::size_t count = separate_bodies(repair.mesh).size();
    json["repair"]["bodies"] = count;
    if (count > 1)
      text += fmt::format("\n  {} separate bodies, and a scene takes one: write them apart with --split DIR",
                          count);
    fits_a_scene = true;
  } else {
    const RepairMethod method = report.usable() ? RepairMethod::none : needed_repair(mesh);
    json["repair"] = {{"method", name_of(method, weld.nodes > 0)}};
    if (method == RepairMethod::level_set) json["repair"]["voxel"] = default_voxel(mesh);
    if (report.triangles > 0) text += plan_text(method, default_voxel(mesh));
    text += advice_text(report);
  }
  if (!command.split.empty()) {
    if (!report.usable() && !command.repair)
      throw ComputationError(command.file +
                             ": is not in a state to be taken apart; add --repair --out FIXED.ply");
    json["split"] = write_bodies(command, bodies);
    for (const Json& file : json["split"])
      text += "\n" + file.get<std::string>();
    fits_a_scene = true;
  }
  add_walls(json, report);
  add_advice(json, report);
  print(common.json ? json.dump() : text);
  if (!fits_a_scene) throw ComputationError(unusable_text(command, report));
}

}  // namespace

void add_check(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CheckCommand>();
  CLI::App* command =
      add_command(program, invocation, "check", "Tell what a mesh file is like, and repair it",
                  [options, &invocation] { check_and_print(*options, invocation.common); });
  command->add_option("FILE", options->file, "mesh file: .ply, .obj, .stl, .off or .glb")->required();
  CLI::Option* repair =
      command->add_flag("--repair", options->repair, "write a mesh that a scene accepts, with least change");
  CLI::Option* out = command->add_option("--out", options->out, "repaired mesh: .ply, .obj, .stl or .off");
  CLI::Option* voxel = command->add_option(
      "--voxel", options->voxel,
      "make it anew through a level set with voxels of this edge in the unit of the file, > 0, where tidying "
      "is "
      "not enough; without it a level set is the last resort, with the longest extent / 200");
  command->add_option("--split", options->split,
                      "folder: write the separate bodies there, one file each (with --repair: as repaired)");
  voxel->check(CLI::PositiveNumber);
  repair->needs(out);
  out->needs(repair);
  voxel->needs(repair);
  command->footer(
      "Exit status: 0 a scene can use the mesh (or it was repaired or split), 1 it has defects or holds "
      "several "
      "bodies, 2 it cannot be read.");
}

}  // namespace conchoid
