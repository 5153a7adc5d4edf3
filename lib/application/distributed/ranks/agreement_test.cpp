#include "distributed/ranks/agreement.h"

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "distributed/ranks/testing/thread_ranks.h"

namespace robosim {
namespace {

/// An exception that only its own rank can throw.
struct OwnError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

TEST(Agreement, ReturnsWhenNoRankFails) {
  runThreadRanks(3, [](RankGroup& group) {
    int calls = 0;
    agree(group, [&] { ++calls; });
    if (calls != 1) throw std::logic_error("not called once");
  });
  EXPECT_TRUE(hasAgreed());
}

TEST(Agreement, ThrowsOnAllRanksTheErrorOfTheFirstThatFails) {
  runThreadRanks(4, [](RankGroup& group) {
    std::string what;
    try {
      agree(group, [&] {
        if (group.rank() == 1) throw OwnError("the disk is full");
        if (group.rank() == 2) throw ConfigError("later rank");
      });
    } catch (const OwnError& error) {
      if (group.rank() != 1) throw;
      what = error.what() + std::string(" (on rank 1)");
    } catch (const std::runtime_error& error) {
      what = error.what();
    }
    if (what != "the disk is full (on rank 1)") throw std::logic_error("was: " + what);
  });
  EXPECT_TRUE(isFailureShared());
}

TEST(Agreement, KeepsWhatDeterminesTheExitCode) {
  const auto thrown = [](const std::function<void()>& function) {
    std::string kind;
    runThreadRanks(2, [&](RankGroup& group) {
      try {
        agree(group, [&] {
          if (group.rank() == 0) function();
        });
      } catch (const ConfigError&) {
        if (group.rank() == 1) kind = "bad input";
      } catch (const Interrupted&) {
        if (group.rank() == 1) kind = "interrupted";
      } catch (...) {
        if (group.rank() == 1) kind = "failed";
      }
    });
    return kind;
  };
  EXPECT_EQ(thrown([] { throw ConfigError("x"); }), "bad input");
  EXPECT_EQ(thrown([] { throw std::invalid_argument("x"); }), "bad input");
  EXPECT_EQ(thrown([] { throw Interrupted("x"); }), "interrupted");
  EXPECT_EQ(thrown([] { throw std::bad_alloc(); }), "failed");
  EXPECT_EQ(thrown([] { throw 3; }), "failed");
}

}  // namespace
}  // namespace robosim
