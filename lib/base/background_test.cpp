#include "base/background.h"

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(Background, DoesOneWorkAfterAnotherInAThreadOfItsOwn) {
  Background background;
  std::thread::id first, second;
  background.start([&] { first = std::this_thread::get_id(); });
  background.wait();
  background.start([&] { second = std::this_thread::get_id(); });
  background.wait();
  EXPECT_NE(first, std::this_thread::get_id());
  EXPECT_EQ(first, second);
}

TEST(Background, HasNothingToWaitForBeforeItHasWork) {
  Background background;
  background.wait();
  background.wait();
}

TEST(Background, TellsWhatWentWrongAsOftenAsItIsAsked) {
  Background background;
  background.start([] { throw std::runtime_error("the disk is full"); });
  EXPECT_THROW(background.wait(), std::runtime_error);
  EXPECT_THROW(background.wait(), std::runtime_error);
}

TEST(Background, EndsItsWorkBeforeItEnds) {
  bool done = false;
  {
    Background background;
    background.start([&] { done = true; });
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace robosim
