#pragma once
#include <chrono>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"

namespace robosim {

/// Asks until a condition holds; fails the test after kLongestWait. For conditions that ask a server, whose answer
/// takes a round trip; a test waits with a condition variable or a file descriptor for everything else.
/// @param what holds then, for the message
template <typename Condition>
void waitUntil(std::string_view what, const Condition& holds) {
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  while (!holds()) {
    if (std::chrono::steady_clock::now() < end) continue;
    ADD_FAILURE() << "waited 5 minutes until " << what;
    return;
  }
}

}  // namespace robosim
