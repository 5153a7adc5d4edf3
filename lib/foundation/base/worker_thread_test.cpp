#include "base/worker_thread.h"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(WorkerThread, RunsTasksSequentiallyInItsThread) {
  WorkerThread background;
  std::thread::id first, second;
  background.start([&] { first = std::this_thread::get_id(); });
  background.wait();
  background.start([&] { second = std::this_thread::get_id(); });
  background.wait();
  EXPECT_NE(first, std::this_thread::get_id());
  EXPECT_EQ(first, second);
}

TEST(WorkerThread, WaitReturnsAtOnceWithoutATask) {
  WorkerThread background;
  background.wait();
  background.wait();
}

TEST(WorkerThread, RethrowsAnExceptionInEveryWait) {
  WorkerThread background;
  background.start([] { throw std::runtime_error("the disk is full"); });
  EXPECT_THROW(background.wait(), std::runtime_error);
  EXPECT_THROW(background.wait(), std::runtime_error);
}

TEST(WorkerThread, CompletesItsTaskBeforeDestruction) {
  bool done = false;
  {
    WorkerThread background;
    background.start([&] { done = true; });
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace robosim
