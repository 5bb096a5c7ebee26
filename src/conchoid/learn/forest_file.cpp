// File of a forest, little-endian throughout:
//   magic (8 bytes) · version u32 · byte-order mark u32 · length of the rest without checksum u64
//   description (JSON text: settings, provenance, feature names, ranges, label scales) · per mode: number of
//   trees u32, per tree: number of nodes u32, feature i32[], left i32[], right i32[], threshold f32[], value
//   f32[] xxHash64 of all bytes before it u64
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"

#include <algorithm>
#include "conchoid/core/bytes.hpp"
#include "conchoid/learn/forest.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

constexpr std::string_view magic = "CNCHFRST";
constexpr std::uint32_t version = 1;
constexpr std::uint32_t byte_order_mark = 0x01020304;
constexpr std::size_t header_size = 8 + 4 + 4 + 8;

constexpr const char* train_again = "train it again with `conchoid forest train`";

json to_json(const MaterialRecord& m) {
  return {{"youngs_modulus", m.youngs_modulus},
          {"poisson_ratio", m.poisson_ratio},
          {"density", m.density},
          {"strength", m.strength},
          {"toughness", m.toughness},
          {"compressive_factor", m.compressive_factor}};
}

MaterialRecord material_from(const json& j) {
  return {j.at("youngs_modulus"), j.at("poisson_ratio"), j.at("density"),
          j.at("strength"),       j.at("toughness"),     j.at("compressive_factor")};
}

json to_json(const Provenance& p) {
  return {{"models", p.models},
          {"material", to_json(p.material)},
          {"resolution", p.resolution},
          {"runs", p.runs},
          {"samples", p.samples},
          {"samples_hash", p.samples_hash},
          {"spec", p.spec}};
}

Provenance provenance_from(const json& j) {
  Provenance p;
  p.models = j.at("models").get<std::vector<std::string>>();
  p.material = material_from(j.at("material"));
  p.resolution = j.at("resolution");
  p.runs = j.at("runs");
  p.samples = j.at("samples");
  p.samples_hash = j.at("samples_hash");
  p.spec = j.at("spec");
  return p;
}

json to_json(const std::vector<FeatureRange>& ranges) {
  json list = json::array();
  for (const FeatureRange& r : ranges)
    list.push_back({{"minimum", r.minimum}, {"maximum", r.maximum}, {"quantiles", r.quantiles}});
  return list;
}

json to_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Vec3 vec_from(const json& j) {
  return Vec3(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>());
}

void put_trees(ByteWriter& out, const TreeEnsemble& ensemble) {
  const std::vector<RegressionTree> trees = ensemble.trees();
  out.put(static_cast<std::uint32_t>(trees.size()));
  for (const RegressionTree& tree : trees) {
    out.put(static_cast<std::uint32_t>(tree.size()));
    out.put_all(std::span<const std::int32_t>(tree.feature));
    out.put_all(std::span<const std::int32_t>(tree.left));
    out.put_all(std::span<const std::int32_t>(tree.right));
    out.put_all(std::span<const float>(tree.threshold));
    out.put_all(std::span<const float>(tree.value));
  }
}

TreeEnsemble get_trees(ByteReader& in, int features) {
  const auto count = in.get<std::uint32_t>();
  if (count > in.left()) throw OutOfBytes();
  std::vector<RegressionTree> trees(count);
  for (RegressionTree& tree : trees) {
    const auto nodes = in.get<std::uint32_t>();
    tree.feature = in.get_all<std::int32_t>(nodes);
    tree.left = in.get_all<std::int32_t>(nodes);
    tree.right = in.get_all<std::int32_t>(nodes);
    tree.threshold = in.get_all<float>(nodes);
    tree.value = in.get_all<float>(nodes);
  }
  return TreeEnsemble(trees, features);
}

/// Checks magic, version, byte order, length and checksum; returns what lies between header and checksum.
std::string_view open_envelope(std::string_view bytes, const std::string& file) {
  if (bytes.substr(0, magic.size()) != magic.substr(0, std::min(bytes.size(), magic.size())) || bytes.empty())
    throw InputError(file + ": is not a conchoid forest; name a file written by `conchoid forest train`");
  if (bytes.size() < header_size + 8)
    throw InputError(file + ": is truncated; copy it again or " + train_again);
  ByteReader in(bytes.substr(magic.size()));
  const auto file_version = in.get<std::uint32_t>();
  const auto order = in.get<std::uint32_t>();
  const auto length = in.get<std::uint64_t>();
  if (order != byte_order_mark)
    throw InputError(file + ": its byte order is damaged; copy it again in binary mode or " + train_again);
  if (file_version != version)
    throw InputError(file + ": has version " + std::to_string(file_version) +
                     ", this program reads version " + std::to_string(version) +
                     "; use the program that wrote it or " + train_again);
  if (length > in.left() || in.left() - length < 8)
    throw InputError(file + ": is truncated; copy it again or " + train_again);
  if (in.left() - length > 8)
    throw InputError(file + ": has extra bytes at its end; copy it again or " + train_again);
  const std::string_view content = in.get_raw(length);
  if (in.get<std::uint64_t>() != hash_bytes(bytes.substr(0, bytes.size() - 8)))
    throw InputError(file + ": is corrupt (its checksum is wrong); copy it again or " + train_again);
  return content;
}

}  // namespace

void RegressionForest::save(const std::filesystem::path& file) const {
  const json description = {
      {"format", "conchoid forest"},
      {"features", name(settings_.features)},
      {"feature_names", feature_names(settings_.features)},
      {"trees", settings_.trees},
      {"depth", settings_.depth},
      {"seed", settings_.seed},
      {"bins", settings_.bins},
      {"ranges", to_json(ranges_)},
      {"label_mean", to_json(label_mean_)},
      {"label_scale", to_json(label_scale_)},
      {"provenance", to_json(provenance_)},
  };
  ByteWriter content;
  content.put_text(description.dump(-1, ' ', false, json::error_handler_t::replace));
  for (const TreeEnsemble& ensemble : ensembles_)
    put_trees(content, ensemble);
  ByteWriter out;
  out.put_raw(magic);
  out.put(version);
  out.put(byte_order_mark);
  out.put(static_cast<std::uint64_t>(content.bytes().size()));
  out.put_raw(content.bytes());
  out.put(hash_bytes(out.bytes()));
  write_bytes(file, out.bytes());
}

RegressionForest RegressionForest::load(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  ByteReader in(open_envelope(bytes, file.string()));
  try {
    const json d = json::parse(in.get_text());
    RegressionForest forest;
    forest.settings_ = {d.at("trees"), d.at("depth"),
                        feature_set_from_name(d.at("features").get<std::string>()), d.at("seed"),
                        d.at("bins")};
    if (d.at("feature_names").get<std::vector<std::string>>() != feature_names(forest.settings_.features))
      throw InputError("feature set " + std::string(name(forest.settings_.features)) +
                       " has changed since the forest was trained");
    for (const json& r : d.at("ranges"))
      forest.ranges_.push_back(
          {r.at("minimum"), r.at("maximum"), r.at("quantiles").get<std::array<double, 7>>()});
    if (forest.ranges_.size() != feature_count(forest.settings_.features))
      throw InputError("the number of feature ranges is wrong");
    forest.label_mean_ = vec_from(d.at("label_mean"));
    forest.label_scale_ = vec_from(d.at("label_scale"));
    forest.provenance_ = provenance_from(d.at("provenance"));
    for (TreeEnsemble& ensemble : forest.ensembles_) {
      ensemble = get_trees(in, static_cast<int>(forest.ranges_.size()));
      if (ensemble.tree_count() != static_cast<std::size_t>(forest.settings_.trees))
        throw InputError("the number of trees is wrong");
    }
    return forest;
  } catch (const std::exception& e) {
    throw InputError(file.string() + ": does not hold a valid forest (" + e.what() + "); " + train_again);
  }
}

}  // namespace conchoid
