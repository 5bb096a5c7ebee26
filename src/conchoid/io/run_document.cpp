#include "conchoid/io/run_document.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "conchoid-run";
constexpr int format_version = 1;

Json to_json(const Vec3& v) {
  return Json::array({v[0], v[1], v[2]});
}

Json to_json(const Mat3& m) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i)
    rows.push_back(Json::array({m(i, 0), m(i, 1), m(i, 2)}));
  return rows;
}

Json to_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json to_json(const FragmentRecord& f) {
  Json out;
  out["volume"] = f.volume;
  out["mass"] = f.mass;
  out["watertight"] = f.watertight;
  out["triangles"] = f.triangles;
  out["fracture_area"] = f.fracture_area;
  out["center_of_mass"] = to_json(f.center_of_mass);
  out["inertia"] = to_json(f.inertia);
  return out;
}

Json to_json(const FrameRecord& f) {
  Json out;
  out["frame"] = f.frame;
  out["source"] = f.source;
  if (f.expected_error) out["expected_error"] = *f.expected_error;
  out["crack_triangles"] = f.crack_triangles;
  out["front_nodes"] = f.front_nodes;
  out["crack_area"] = f.crack_area;
  out["max_K_eff"] = f.max_K_eff;
  out["seconds"] = {
      {"opening", f.opening_seconds}, {"fracture", f.fracture_seconds}, {"other", f.other_seconds}};
  return out;
}

Json to_json(const std::vector<RunSetting>& settings) {
  Json out = Json::object();
  for (const RunSetting& s : settings)
    std::visit([&](const auto& value) { out[s.name] = value; }, s.value);
  return out;
}

/// A number that may have been written as null because it was not finite.
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::optional<double> optional_from(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

Vec3 vector_from(const Json& json) {
  return {number(json.at(0)), number(json.at(1)), number(json.at(2))};
}

std::vector<RunSetting> settings_from(const Json& json) {
  std::vector<RunSetting> out;
  for (const auto& [name, value] : json.items()) {
    if (value.is_boolean()) {
      out.push_back({name, value.get<bool>()});
    } else if (value.is_number_integer()) {
      out.push_back({name, value.get<std::int64_t>()});
    } else if (value.is_string()) {
      out.push_back({name, value.get<std::string>()});
    } else {
      out.push_back({name, number(value)});
    }
  }
  return out;
}

FragmentRecord fragment_from(const Json& json) {
  FragmentRecord f;
  f.volume = number(json.at("volume"));
  f.mass = number(json.at("mass"));
  f.watertight = json.at("watertight").get<bool>();
  f.triangles = json.at("triangles").get<std::size_t>();
  f.fracture_area = number(json.at("fracture_area"));
  f.center_of_mass = vector_from(json.at("center_of_mass"));
  for (std::size_t i = 0; i < 3; ++i)
    f.inertia.row(static_cast<Eigen::Index>(i)) = vector_from(json.at("inertia").at(i)).transpose();
  return f;
}

FrameRecord frame_from(const Json& json) {
  FrameRecord f;
  f.frame = json.at("frame").get<int>();
  f.source = json.at("source").get<std::string>();
  f.expected_error = optional_from(json, "expected_error");
  f.crack_triangles = json.at("crack_triangles").get<std::size_t>();
  f.front_nodes = json.at("front_nodes").get<std::size_t>();
  f.crack_area = json.value("crack_area", 0.0);
  f.max_K_eff = number(json.at("max_K_eff"));
  const Json& seconds = json.at("seconds");
  f.opening_seconds = number(seconds.at("opening"));
  f.fracture_seconds = number(seconds.at("fracture"));
  f.other_seconds = number(seconds.at("other"));
  return f;
}

RunDocument document_from(const Json& json, const std::filesystem::path& path) {
  RunDocument d;
  d.method = json.at("method").get<std::string>();
  d.frames = json.at("frames").get<int>();
  d.solved_frames = json.value("solved_frames", 0);
  d.expected_error = optional_from(json, "expected_error");
  d.resumed_after = json.value("resumed_after", 0);
  const std::string stop = json.at("stop").get<std::string>();
  const auto reason = stop_reason_from_name(stop);
  if (!reason)
    throw InputError(path.string() + ": 'stop' is '" + stop +
                     "', which no run of this program says; run the scene again with this program");
  d.stop = *reason;
  d.stop_details = json.value("stop_details", std::string());
  d.crack_area = json.value("crack_area", 0.0);
  d.largest_K_over_Kc = optional_from(json, "largest_K_over_Kc");
  d.stress_over_strength = optional_from(json, "stress_over_strength");
  d.initial_triangles = json.at("triangles").at("initial").get<std::size_t>();
  d.final_triangles = json.at("triangles").at("final").get<std::size_t>();
  const Json& seconds = json.at("seconds");
  d.total_seconds = number(seconds.at("total"));
  d.opening_seconds = number(seconds.at("opening"));
  d.fracture_seconds = number(seconds.at("fracture"));
  d.other_seconds = number(seconds.at("other"));
  d.opening_seconds_per_frame = number(json.at("opening_seconds_per_frame"));
  for (const Json& f : json.at("fragments"))
    d.fragments.push_back(fragment_from(f));
  for (const Json& c : json.value("contacts", Json::array()))
    d.contacts.push_back({c.at("fragments").at(0).get<std::size_t>(),
                          c.at("fragments").at(1).get<std::size_t>(), number(c.at("area"))});
  d.hash = json.at("hash").get<std::string>();
  for (const Json& w : json.at("warnings"))
    d.warnings.push_back(w.get<std::string>());
  const Json& body = json.at("body");
  if (!body.is_null()) {
    d.body = Box{vector_from(body.at("low")), vector_from(body.at("high"))};
    d.body_volume = number(body.at("volume"));
  }
  d.scene_file = json.at("scene").at("file").get<std::string>();
  d.scene_text = json.at("scene").at("text").get<std::string>();
  d.settings = settings_from(json.at("settings"));
  d.versions = settings_from(json.at("versions"));
  for (const Json& f : json.at("timings"))
    d.timings.push_back(frame_from(f));
  return d;
}

}  // namespace

RunSetting tolerance_setting(double tolerance) {
  if (std::isfinite(tolerance)) return {"run.tolerance", tolerance};
  return {"run.tolerance", std::string("inf")};
}

FragmentRecord fragment_record(const Fragment& fragment) {
  FragmentRecord record{fragment.volume,
                        fragment.mass,
                        fragment.center_of_mass,
                        fragment.inertia,
                        fragment.watertight,
                        fragment.mesh.triangle_count(),
                        0};
  for (std::size_t t = 0; t < fragment.mesh.triangle_count(); ++t)
    if (fragment.face_kind[t] == FaceKind::fracture)
      record.fracture_area += area_vector(fragment.mesh, TriId(t)).norm();
  return record;
}

std::string run_json(const RunDocument& d, RunJson extent) {
  Json out;
  if (extent == RunJson::document) {
    out["format"] = format_name;
    out["version"] = format_version;
  }
  out["method"] = d.method;
  out["frames"] = d.frames;
  out["solved_frames"] = d.solved_frames;
  if (d.expected_error) out["expected_error"] = *d.expected_error;
  if (d.resumed_after > 0) out["resumed_after"] = d.resumed_after;
  out["stop"] = name(d.stop);
  out["stop_details"] = d.stop_details;
  out["triangles"] = {{"initial", d.initial_triangles}, {"final", d.final_triangles}};
  out["seconds"] = {{"total", d.total_seconds},
                    {"opening", d.opening_seconds},
                    {"fracture", d.fracture_seconds},
                    {"other", d.other_seconds}};
  out["opening_seconds_per_frame"] = d.opening_seconds_per_frame;
  out["crack_area"] = d.crack_area;
  out["largest_K_over_Kc"] = to_json(d.largest_K_over_Kc);
  out["stress_over_strength"] = to_json(d.stress_over_strength);
  out["fragments"] = Json::array();
  for (const FragmentRecord& f : d.fragments)
    out["fragments"].push_back(to_json(f));
  out["contacts"] = Json::array();
  for (const FragmentContact& c : d.contacts)
    out["contacts"].push_back({{"fragments", {c.first, c.second}}, {"area", c.area}});
  out["hash"] = d.hash;
  out["warnings"] = d.warnings;
  if (extent == RunJson::document) {
    out["body"] = nullptr;
    if (d.body)
      out["body"] = {
          {"low", to_json(d.body->low)}, {"high", to_json(d.body->high)}, {"volume", d.body_volume}};
    out["scene"] = {{"file", d.scene_file}, {"text", d.scene_text}};
    out["settings"] = to_json(d.settings);
    out["versions"] = to_json(d.versions);
    out["timings"] = Json::array();
    for (const FrameRecord& f : d.timings)
      out["timings"].push_back(to_json(f));
  }
  return out.dump(extent == RunJson::document ? 1 : -1, ' ', false, Json::error_handler_t::replace);
}

RunDocument read_run_json(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be opened; check the name and the permissions");
  try {
    const Json json = Json::parse(in);
    if (!json.is_object() || json.value("format", "") != format_name)
      throw InputError(
          path.string() +
          ": this is not the run.json of a conchoid run; give the folder that 'conchoid run --out' wrote");
    if (json.at("version").get<int>() != format_version)
      throw InputError(path.string() + ": written as version " + json.at("version").dump() +
                       " of the format, this program reads version " + std::to_string(format_version) +
                       "; run the scene again with this program");
    return document_from(json, path);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path.string() + ": damaged (" + error.what() + "); run the scene again with --out");
  }
}

}  // namespace conchoid
