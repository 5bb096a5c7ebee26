// What the file of networks holds behind its description (regressor_file.cpp): means and 1/deviations of features f64
// (term_basis.cpp) · number of members u32 · parameters of each f32 (front_network.hpp)
#include "conchoid/learn/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "conchoid/core/blas_threads.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/members.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/run_groups.hpp"
#include "conchoid/learn/training.hpp"

namespace conchoid {
namespace {

using nlohmann::json;
using Matrix = FrontNetwork::Matrix;

constexpr int kMost = 64, kWidest = 1024, kDeepest = 16;

}  // namespace

Matrix Network::standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end) const {
  Matrix out(rows.columns, end - begin);
  std::vector<double> z(rows.columns);
  for (std::size_t i = begin; i < end; ++i) {
    features_.evaluate(rows.row(i), z);
    for (std::size_t c = 0; c < rows.columns; ++c)
      out(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(i - begin)) =
          std::clamp(static_cast<float>(z[c]), -kFarthest, kFarthest);
  }
  return out;
}

Network Network::train(const SampleSet& samples, FeatureSet features, const NetworkSettings& settings,
                       Provenance provenance, const TrainingProgress& progress) {
  const TrainingData data = prepare_training(samples, features, std::move(provenance));
  Network result(data.record, settings);
  result.features_ = TermBasis(data.rows, 1);
  const std::size_t n = data.rows.rows();
  RunGroups groups = run_groups(data.run, settings.members);
  NetworkData fitted{result.standardised(data.rows, 0, n), Matrix(3, n), {}, std::move(groups.of_row)};
  for (std::size_t i = 0; i < n; ++i) {
    fitted.goes_on.push_back(data.rows.goes_on(i));
    for (std::size_t mode = 0; mode < 3; ++mode)
      fitted.wanted(static_cast<Eigen::Index>(mode), static_cast<Eigen::Index>(i)) =
          static_cast<float>(data.labels[mode][i]);
  }
  result.members_.assign(static_cast<std::size_t>(groups.count), FrontNetwork(1, 1, 1, 1));
  std::mutex mutex;
  int done = 0;
  const auto step = [&] {
    const std::lock_guard lock(mutex);
    if (progress) progress(++done, groups.count * settings.epochs);
  };
  const OneBlasThread one_blas_thread;
  parallel_for(result.members_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t member = begin; member < end; ++member)
      result.members_[member] =
          fit_network(fitted, groups.count > 1 ? static_cast<int>(member) : -1, settings, step);
  });
  return result;
}

void Network::predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                                   std::span<Prediction> out) const {
  std::size_t first = begin, last = end;  // whole stretches
  while (first > 0 && rows.goes_on(first - 1))
    --first;
  while (last < rows.rows() && rows.goes_on(last - 1))
    ++last;
  const Matrix columns = standardised(rows, first, last);
  std::vector<char> goes_on;
  for (std::size_t i = first; i < last; ++i)
    goes_on.push_back(i + 1 < last && rows.goes_on(i));
  std::vector<std::array<MemberAnswers, 3>> answers(end - begin);
  for (const FrontNetwork& member : members_) {
    const Matrix of_member = member.answer(columns, goes_on);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t mode = 0; mode < 3; ++mode)
        answers[i - begin][mode].add(static_cast<double>(
            of_member(static_cast<Eigen::Index>(mode), static_cast<Eigen::Index>(i - first))));
  }
  for (std::size_t i = 0; i < answers.size(); ++i)
    for (std::size_t mode = 0; mode < 3; ++mode) {
      out[i].mean[static_cast<Eigen::Index>(mode)] = answers[i][mode].mean();
      out[i].spread[static_cast<Eigen::Index>(mode)] = answers[i][mode].spread();
    }
}

std::string Network::settings_json() const {
  return json{
      {"members", settings_.members}, {"width", settings_.width}, {"convolutions", settings_.convolutions},
      {"epochs", settings_.epochs},   {"rate", settings_.rate},   {"seed", settings_.seed}}
      .dump();
}

std::string Network::fit_json() const {
  return json{{"members", members_.size()}, {"parameters", members_.front().parameters().size()}}.dump();
}

std::string Network::summary() const {
  return fmt::format("networks    {} of width {}, {} convolutions along the front, {} parameters each",
                     members_.size(), settings_.width, settings_.convolutions,
                     members_.front().parameters().size());
}

void Network::write_fit(ByteWriter& out) const {
  features_.write(out);
  out.put(static_cast<std::uint32_t>(members_.size()));
  for (const FrontNetwork& member : members_)
    out.put_all(std::span<const float>(member.parameters()));
}

std::unique_ptr<Regressor> Network::read(TrainingRecord record, const std::string& settings,
                                         ByteReader& fit) {
  const json d = json::parse(settings);
  if (!d.contains("convolutions"))
    throw InputError(
        "its networks do not look along the whole front, as earlier versions wrote them; train it again with "
        "`conchoid forest train --model network`");
  const NetworkSettings s{d.at("members"), d.at("width"), d.at("convolutions"),
                          d.at("epochs"),  d.at("rate"),  d.at("seed")};
  if (s.width < 1 || s.width > kWidest) throw InputError("its width is wrong");
  if (s.convolutions < 1 || s.convolutions > kDeepest)
    throw InputError("its number of convolutions is wrong");
  auto result = std::make_unique<Network>(Network(std::move(record), s));
  const std::size_t features = result->ranges().size();
  result->features_ = TermBasis::read(fit, features, 1);
  const auto count = fit.get<std::uint32_t>();
  if (count != 1 && static_cast<int>(count) != s.members) throw InputError("the number of members is wrong");
  const auto finite = [](auto x) { return std::isfinite(x); };
  for (std::uint32_t i = 0; i < count; ++i) {
    FrontNetwork member(static_cast<int>(features), s.width, s.convolutions, 3);
    member.parameters() = fit.get_all<float>(member.parameters().size());
    if (!std::all_of(member.parameters().begin(), member.parameters().end(), finite))
      throw InputError("a parameter is not finite");
    result->members_.push_back(std::move(member));
  }
  return result;
}

RegressorKind network_kind() {
  const NetworkSettings standard;
  RegressorKind kind;
  kind.name = "network";
  kind.title = "set of networks";
  kind.magic = "CNCHNETW";
  kind.options = {{"members", "networks, each fitted without one of as many groups of runs", standard.members,
                   1, kMost, true},
                  {"width", "numbers per front point in the hidden layers", standard.width, 1, kWidest, true},
                  {"convolutions", "along the front: so many neighbours on either side count",
                   standard.convolutions, 1, kDeepest, true},
                  {"epochs", "times that all samples are looked at", standard.epochs, 1, 10000, true},
                  {"rate", "of learning, at the beginning", standard.rate, 1e-6, 1, false}};
  kind.train = [](const SampleSet& samples, const TrainingSettings& wanted, Provenance provenance,
                  const TrainingProgress& progress) -> std::unique_ptr<Regressor> {
    const RegressorKind& own = regressor_kind("network");
    NetworkSettings settings;
    settings.members = whole_option_value(own, wanted, "members");
    settings.width = whole_option_value(own, wanted, "width");
    settings.convolutions = whole_option_value(own, wanted, "convolutions");
    settings.epochs = whole_option_value(own, wanted, "epochs");
    settings.rate = option_value(own, wanted, "rate").value();
    settings.seed = wanted.seed;
    return std::make_unique<Network>(
        Network::train(samples, wanted.features, settings, std::move(provenance), progress));
  };
  kind.read = &Network::read;
  return kind;
}

}  // namespace conchoid
