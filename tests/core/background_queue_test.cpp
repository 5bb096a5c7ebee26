#include "conchoid/core/background_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "conchoid/core/context.hpp"

namespace conchoid {
namespace {

TEST(BackgroundQueue, CarriesOutEverythingInItsOrder) {
  std::vector<int> done;
  {
    BackgroundQueue queue(2);
    for (int i = 0; i < 100; ++i)
      queue.add([&done, i] { done.push_back(i); });
    queue.finish();
    EXPECT_EQ(done.size(), 100u);
    queue.add([&done] { done.push_back(100); });  // left to the destructor
  }
  std::vector<int> expected(101);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(done, expected);
}

TEST(BackgroundQueue, WorksBesideTheCallerWhoWaitsForRoomOnly) {
  std::promise<void> go_on;
  std::shared_future<void> may = go_on.get_future().share();
  std::atomic<int> done = 0;
  BackgroundQueue queue(2);
  for (int i = 0; i < 2; ++i)
    queue.add([&, may] {
      may.wait();
      ++done;
    });
  EXPECT_EQ(done, 0);  // the caller is here, and neither is done
  std::thread later([&] { go_on.set_value(); });
  queue.add([&] { ++done; });  // no room before the first one is through
  EXPECT_GE(done, 1);
  queue.finish();
  EXPECT_EQ(done, 3);
  later.join();
}

TEST(BackgroundQueue, AFailureIsThrownWhereTheNextJobComesAndEndsIt) {
  std::atomic<int> done = 0;
  BackgroundQueue queue;
  queue.add([] { throw std::runtime_error("the disk is full"); });
  EXPECT_THROW(queue.finish(), std::runtime_error);
  EXPECT_THROW(queue.add([&] { ++done; }), std::runtime_error);
  EXPECT_THROW(queue.finish(), std::runtime_error);
  EXPECT_EQ(done, 0);
}

TEST(BackgroundQueue, WithOneThreadNothingRunsBesideTheCaller) {
  BackgroundQueue queue;
  std::thread::id where;
  ExecutionContext(1).run([&] {
    queue.add([&] { where = std::this_thread::get_id(); });
    EXPECT_EQ(where, std::this_thread::get_id());
  });
}

}  // namespace
}  // namespace conchoid
