#include "base/interrupt.h"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(InterruptTest, RequestsTheEndOnceAndThenEndsTheProcess) {
  EXPECT_EXIT(
      {
        Interrupt interrupt;
        raise(SIGTERM);
        if (!interrupt.isRequested() || Interrupt::signal() != SIGTERM) std::_Exit(1);
        raise(SIGTERM);
        std::_Exit(2);
      },
      testing::KilledBySignal(SIGTERM), "");
}

TEST(InterruptTest, IsIgnoredUntilTheProcessEndsWhenItsOutputsAreComplete) {
  EXPECT_EXIT(
      {
        {
          Interrupt interrupt;
          interrupt.ignoreUntilExit();
          for (const int signal : {SIGINT, SIGTERM, SIGHUP}) raise(signal);
          if (interrupt.isRequested()) std::_Exit(1);
        }
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) raise(signal);
        std::_Exit(3);
      },
      testing::ExitedWithCode(3), "");
}

TEST(InterruptTest, RestoresTheFormerActionsAtItsEnd) {
  EXPECT_EXIT(
      {
        { const Interrupt interrupt; }
        raise(SIGHUP);
        std::_Exit(2);
      },
      testing::KilledBySignal(SIGHUP), "");
}

}  // namespace
}  // namespace robosim
