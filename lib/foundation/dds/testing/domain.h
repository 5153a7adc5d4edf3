#pragma once
#include <chrono>
#include <thread>

#include <unistd.h>

namespace robosim::dds {

/// A domain for the tests of this process, so that tests in parallel do not meet. Ports of domains above 100 are also
/// used by the system.
inline int testDomain() { return static_cast<int>(getpid() % 100) + 1; }

/// Waits for what other threads do, for up to 20 s. @return whether it is so
template <typename Condition>
bool eventually(const Condition& is_so) {
  for (int i = 0; i < 20'000; ++i) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return is_so();
}

}  // namespace robosim::dds
