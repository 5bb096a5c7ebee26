#include "conchoid/learn/network_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "conchoid/core/random.hpp"

namespace conchoid {
namespace {

using Matrix = FrontNetwork::Matrix;

constexpr std::size_t kBatch = 256;  // rows at a time, at least
constexpr float kDecay = 1e-4F;      // of the weights, per step and rate
constexpr float kFirst = 0.9F, kSecond = 0.999F, kSmall = 1e-8F;

/// Columns begin … end, neighbours along a front.
using Stretch = std::pair<std::size_t, std::size_t>;

std::vector<Stretch> stretches(const NetworkData& data, const std::function<bool(int)>& wanted) {
  std::vector<Stretch> out;
  for (std::size_t begin = 0, i = 0; i < data.group.size(); ++i) {
    if (data.goes_on[i]) continue;
    if (wanted(data.group[begin])) out.push_back({begin, i + 1});
    begin = i + 1;
  }
  return out;
}

struct Batch {
  Matrix rows, wanted;
  std::vector<char> goes_on;
};

Batch gathered(const NetworkData& data, const std::vector<Stretch>& all, std::size_t begin, std::size_t end) {
  Eigen::Index n = 0;
  for (std::size_t s = begin; s < end; ++s)
    n += static_cast<Eigen::Index>(all[s].second - all[s].first);
  Batch batch{Matrix(data.rows.rows(), n), Matrix(data.wanted.rows(), n), {}};
  Eigen::Index at = 0;
  for (std::size_t s = begin; s < end; ++s) {
    const auto from = static_cast<Eigen::Index>(all[s].first);
    const auto count = static_cast<Eigen::Index>(all[s].second - all[s].first);
    batch.rows.middleCols(at, count) = data.rows.middleCols(from, count);
    batch.wanted.middleCols(at, count) = data.wanted.middleCols(from, count);
    batch.goes_on.insert(batch.goes_on.end(), static_cast<std::size_t>(count - 1), 1);
    batch.goes_on.push_back(0);
    at += count;
  }
  return batch;
}

/// Ends of batches of whole stretches.
std::vector<std::size_t> batch_ends(const std::vector<Stretch>& all) {
  std::vector<std::size_t> ends;
  std::size_t rows = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    rows += all[s].second - all[s].first;
    if (rows < kBatch && s + 1 < all.size()) continue;
    ends.push_back(s + 1);
    rows = 0;
  }
  return ends;
}

void shuffle(std::vector<Stretch>& all, Random& random) {
  for (std::size_t i = all.size(); i > 1; --i)
    std::swap(all[i - 1], all[random.index(i)]);
}

class Adam {
 public:
  explicit Adam(std::size_t parameters) : mean_(parameters, 0), square_(parameters, 0) {}
  void step(std::vector<float>& parameters, const std::vector<float>& gradient, float rate) {
    first_ *= kFirst;
    second_ *= kSecond;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      mean_[i] += (1 - kFirst) * (gradient[i] - mean_[i]);
      square_[i] += (1 - kSecond) * (gradient[i] * gradient[i] - square_[i]);
      const float way = mean_[i] / (1 - first_) / (std::sqrt(square_[i] / (1 - second_)) + kSmall);
      parameters[i] -= rate * (way + kDecay * parameters[i]);
    }
  }

 private:
  std::vector<float> mean_, square_;
  float first_ = 1, second_ = 1;
};

// The loss over stretches, a batch at a time.
double error(const FrontNetwork& network, const NetworkData& data, const std::vector<Stretch>& of) {
  double sum = 0, rows = 0;
  std::size_t begin = 0;
  for (const std::size_t end : batch_ends(of)) {
    const Batch batch = gathered(data, of, std::exchange(begin, end), end);
    const auto n = static_cast<double>(batch.rows.cols());
    sum += n * network.loss(batch.rows, batch.goes_on, batch.wanted);
    rows += n;
  }
  return sum / rows;
}

}  // namespace

FrontNetwork fit_network(const NetworkData& data, int left_out, const NetworkSettings& settings,
                         const std::function<void()>& progress) {
  std::vector<Stretch> learned = stretches(data, [&](int g) { return g != left_out; });
  const std::vector<Stretch> judged = stretches(data, [&](int g) { return g == left_out; });
  Random random(settings.seed, static_cast<std::uint64_t>(left_out + 1));
  FrontNetwork network(static_cast<int>(data.rows.rows()), settings.width, settings.convolutions,
                       static_cast<int>(data.wanted.rows()));
  network.draw(random);
  FrontNetwork best = network;
  double least = std::numeric_limits<double>::infinity();
  Adam adam(network.parameters().size());
  std::vector<float> gradient;
  for (int epoch = 0; epoch < settings.epochs; ++epoch) {
    shuffle(learned, random);
    const std::vector<std::size_t> ends = batch_ends(learned);
    for (std::size_t b = 0; b < ends.size(); ++b) {
      const Batch batch = gathered(data, learned, b > 0 ? ends[b - 1] : 0, ends[b]);
      network.loss_gradient(batch.rows, batch.goes_on, batch.wanted, gradient);
      const double way =
          (epoch + static_cast<double>(b) / static_cast<double>(ends.size())) / settings.epochs;
      adam.step(network.parameters(), gradient,
                static_cast<float>(settings.rate * 0.5 * (1 + std::cos(std::numbers::pi * way))));
    }
    const double now = judged.empty() ? -epoch : error(network, data, judged);
    if (now < least) {
      least = now;
      best = network;
    }
    progress();
  }
  return best;
}

}  // namespace conchoid
