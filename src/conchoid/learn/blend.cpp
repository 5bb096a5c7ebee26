// What the file of a blend holds behind its description (regressor_file.cpp): number of members u32, and each one's own
// file, a text.
#include "conchoid/learn/blend.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_file.hpp"
#include "conchoid/learn/regressor_kinds.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

struct Blended {
  std::string_view kind;
  std::map<std::string, double, std::less<>> options;
};

// Small leaves, as many bodies are to be told apart; few trees, as the others smooth what these leave.
const std::vector<Blended>& blended() {
  static const std::vector<Blended> all{{"forest", {{"trees", 8}, {"depth", 18}, {"leaf", 8}}},
                                        {"boosted", {{"trees", 300}, {"depth", 6}, {"rate", 0.07}}},
                                        {"network", {}}};
  return all;
}

}  // namespace

Blend Blend::train(const SampleSet& samples, FeatureSet features, std::uint64_t seed,
                   const Provenance& provenance, const TrainingProgress& progress) {
  std::vector<std::unique_ptr<Regressor>> members;
  constexpr int kParts = 100;
  for (const Blended& one : blended()) {
    const auto before = static_cast<int>(members.size());
    const auto part = [&](int done, int total) {
      if (progress)
        progress(kParts * before + kParts * done / total, kParts * static_cast<int>(blended().size()));
    };
    members.push_back(
        train_regressor(regressor_kind(one.kind), samples, {features, seed, one.options}, provenance, part));
  }
  TrainingRecord record = members.front()->record();
  record.label_mean = Vec3::Zero();  // what the members answer is brought back already
  record.label_scale = Vec3::Ones();
  Blend blend(std::move(record));
  blend.members_ = std::move(members);
  return blend;
}

void Blend::predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                                 std::span<Prediction> out) const {
  std::vector<Prediction> of_member(end - begin);
  std::vector<Vec3> square(end - begin, Vec3::Zero());
  const auto n = static_cast<double>(members_.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].mean = Vec3::Zero();
  for (const std::unique_ptr<Regressor>& member : members_) {
    member->predict_rows(rows, begin, end, of_member);
    for (std::size_t i = 0; i < of_member.size(); ++i) {
      out[i].mean += of_member[i].mean / n;
      square[i] += (of_member[i].spread.cwiseAbs2() + of_member[i].mean.cwiseAbs2()) / n;
    }
  }
  for (std::size_t i = 0; i < of_member.size(); ++i)
    out[i].spread = (square[i] - out[i].mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
}

std::string Blend::fit_json() const {
  json members = json::array();
  for (const std::unique_ptr<Regressor>& member : members_) {
    json one = json::parse(member->settings_json());
    one.update(json::parse(member->fit_json()));
    one["model"] = member->name();
    members.push_back(std::move(one));
  }
  return json{{"members", std::move(members)}}.dump();
}

std::string Blend::summary() const {
  std::vector<std::string> lines;
  for (const std::unique_ptr<Regressor>& member : members_)
    lines.push_back(member->summary());
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<const TreeEnsemble*> Blend::ensembles(int mode) const {
  std::vector<const TreeEnsemble*> all;
  for (const std::unique_ptr<Regressor>& member : members_) {
    const auto of_member = member->ensembles(mode);
    all.insert(all.end(), of_member.begin(), of_member.end());
  }
  return all;
}

void Blend::write_fit(ByteWriter& out) const {
  out.put(static_cast<std::uint32_t>(members_.size()));
  for (const std::unique_ptr<Regressor>& member : members_)
    out.put_text(member->file_bytes());
}

std::unique_ptr<Regressor> Blend::read(TrainingRecord record, const std::string& /*settings*/,
                                       ByteReader& fit) {
  auto blend = std::make_unique<Blend>(Blend(std::move(record)));
  const auto count = fit.get<std::uint32_t>();
  if (count == 0) throw InputError("it has no members");
  for (std::uint32_t i = 0; i < count; ++i) {
    blend->members_.push_back(regressor_from(fit.get_text(), "a member"));
    if (blend->members_.back()->feature_set() != blend->feature_set())
      throw InputError("its members look at different features");
    if (blend->members_.back()->name() == blend->name()) throw InputError("a member is a blend itself");
  }
  return blend;
}

RegressorKind blend_kind() {
  RegressorKind kind;
  kind.name = "blend";
  kind.title = "blend of regressors";
  kind.magic = "CNCHBLND";
  kind.train = [](const SampleSet& samples, const TrainingSettings& wanted, Provenance provenance,
                  const TrainingProgress& progress) -> std::unique_ptr<Regressor> {
    return std::make_unique<Blend>(Blend::train(samples, wanted.features, wanted.seed, provenance, progress));
  };
  kind.read = &Blend::read;
  return kind;
}

}  // namespace conchoid
