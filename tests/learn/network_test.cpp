#include "conchoid/learn/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/bytes.hpp"
#include "conchoid/core/context.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "synthetic.hpp"

namespace conchoid {
namespace {

using Matrix = FrontNetwork::Matrix;
using test::synthetic_runs;

Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, Random& random) {
  Matrix m(rows, columns);
  for (Eigen::Index i = 0; i < m.size(); ++i)
    m.data()[i] = static_cast<float>(random.normal());
  return m;
}

/// Two stretches of 5 and 3, and one row alone.
const std::vector<char> kGoesOn{1, 1, 1, 1, 0, 1, 1, 0, 0};

FrontNetwork drawn(Random& random, int width = 6) {
  FrontNetwork network(4, width, 2, 3);
  network.draw(random);
  for (float& p : network.parameters())
    if (p == 0) p = static_cast<float>(0.3 * random.normal());
  return network;
}

TEST(FrontNetwork, TheGradientIsThatOfTheLoss) {
  Random random(1);
  FrontNetwork network = drawn(random);
  const Matrix rows = random_matrix(4, 9, random), wanted = random_matrix(3, 9, random);
  std::vector<float> gradient;
  network.loss_gradient(rows, kGoesOn, wanted, gradient);
  double largest = 0;
  for (const float g : gradient)
    largest = std::max(largest, static_cast<double>(std::abs(g)));
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    const float at = network.parameters()[i], step = 1e-2F;
    network.parameters()[i] = at + step;
    const double more = network.loss(rows, kGoesOn, wanted);
    network.parameters()[i] = at - step;
    const double less = network.loss(rows, kGoesOn, wanted);
    network.parameters()[i] = at;
    EXPECT_NEAR((more - less) / (2 * 1e-2), static_cast<double>(gradient[i]), 2e-3 * largest) << i;
  }
}

// Widths of which answers take eight rows at a time, sixteen, and what is left.
TEST(FrontNetwork, TheLossIsThatOfTheAnswers) {
  for (const int width : {6, 8, 13, 16, 43}) {
    Random random(2);
    const FrontNetwork network = drawn(random, width);
    const Matrix rows = random_matrix(4, 9, random), wanted = random_matrix(3, 9, random);
    const Matrix answer = network.answer(rows, kGoesOn);
    double of_answers = 0;
    for (Eigen::Index i = 0; i < answer.size(); ++i) {
      const double e = std::abs(static_cast<double>(answer.data()[i] - wanted.data()[i]));
      of_answers += (e <= 0.5 ? e * e : e - 0.25) / 9;
    }
    EXPECT_NEAR(network.loss(rows, kGoesOn, wanted), of_answers, 1e-5 * of_answers) << "width " << width;
  }
}

// The sense in which a front is walked along does not matter, a row of another stretch does not, and every one of its own does.
TEST(FrontNetwork, LooksAlongItsStretchAndNoFarther) {
  Random random(3);
  const FrontNetwork network = drawn(random);
  const Matrix rows = random_matrix(4, 9, random);
  const Matrix answer = network.answer(rows, kGoesOn);
  Matrix changed = rows;
  changed.col(0) += random_matrix(4, 1, random);
  const Matrix other = network.answer(changed, kGoesOn);
  for (Eigen::Index i = 0; i < 9; ++i)
    EXPECT_EQ(other.col(i) == answer.col(i), i > 4) << i;
  const std::vector<char> one_front{1, 1, 1, 1, 0};
  const Matrix there = network.answer(rows.leftCols(5), one_front);
  const Matrix back = network.answer(rows.leftCols(5).rowwise().reverse(), one_front);
  EXPECT_LT((there - back.rowwise().reverse()).norm(), 1e-6F * there.norm());
  EXPECT_TRUE(there == answer.leftCols(5)) << "the same bits whatever else is asked";
}

// What is the same along a front has the same answer, however many elements the front is made of.
TEST(FrontNetwork, TheNumberOfRowsDoesNotCount) {
  Random random(4);
  const FrontNetwork network = drawn(random);
  const Matrix row = random_matrix(4, 1, random);
  const Matrix alone = network.answer(row, {0});
  for (const Eigen::Index n : {2, 3, 7}) {
    std::vector<char> goes_on(static_cast<std::size_t>(n), 1);
    goes_on.back() = 0;
    const Matrix answer = network.answer(row.replicate(1, n), goes_on);
    EXPECT_LT((answer.colwise() - alone.col(0)).norm(), 1e-5F * answer.norm()) << n;
  }
}

TEST(Network, ChunksOfRowsHaveTheSameBits) {
  const SampleSet samples = synthetic_runs(30, 1.2, 0.5);  // more than one chunk of 256
  const auto network = Network::train(samples, FeatureSet::dimensionless, {.width = 6, .epochs = 2});
  const auto all = network.predict_labels(samples);
  std::vector<std::size_t> front;  // frame 5 of run 3, ten nodes
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples.run()[i] == 3 && samples.frame()[i] == 5) front.push_back(i);
  ASSERT_EQ(front.size(), 10U);
  const auto some = network.predict_labels(samples.subset(front));
  for (std::size_t k = 0; k < front.size(); ++k) {
    EXPECT_EQ(some[k].mean, all[front[k]].mean) << k;
    EXPECT_EQ(some[k].spread, all[front[k]].spread) << k;
  }
}

TEST(Network, HasTheSameBitsForEveryNumberOfThreads) {
  const SampleSet samples = synthetic_runs(12, 1.1, 0.5);
  const auto hash_of = [&](int threads) {
    std::uint64_t hash = 0;
    ExecutionContext(threads).run([&] {
      hash = Network::train(samples, FeatureSet::paper_3, {.width = 6, .epochs = 2}).content_hash();
    });
    return hash;
  };
  EXPECT_EQ(hash_of(1), hash_of(2));
}

// What a front does as a whole shows in the neighbours of a row whose own features are mostly noise.
TEST(Network, LearnsFromNeighboursWhatARowDoesNotTell) {
  Random random(5);
  SampleSet samples;
  for (int run = 0; run < 120; ++run) {
    const double turn = random.uniform(-1, 1);
    for (int node = 0; node < 12; ++node) {
      Sample s;
      s.run = run;
      s.frame = 2;
      s.node = node;
      s.K = 1e6 * Vec3(1, turn + random.normal(), 0);
      s.opening = Vec3(1, turn, 0) * s.resolution;
      samples.add(s);
    }
  }
  const Split split = split_by_run(samples, 0.25, 1);
  const auto network = Network::train(split.training, FeatureSet::paper_3, {.width = 16, .epochs = 40});
  const double r2 = evaluate(network, split.held_out).model.accuracy.r2[1];
  // Variance of the turn 1/3, of the noise 1: a row alone explains a quarter at best, seven rows 0.7, all twelve 0.8.
  EXPECT_GT(r2, 0.7);
}

TEST(Network, OneThatLooksAtNeighboursAloneIsToBeTrainedAgain) {
  const std::string written_before = R"({"width": 32, "epochs": 30, "rate": 0.003, "seed": 1})";
  ByteReader nothing("");
  try {
    Network::read(TrainingRecord{}, written_before, nothing);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("train it again"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace conchoid
