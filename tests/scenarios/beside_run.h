#pragma once
#include <future>
#include <type_traits>
#include <utility>

#include "tests/scenarios/served_world.h"

namespace robosim {

/// What a client does beside a test, on a thread of its own, until the run ends at the latest. A test that ends before
/// get(), by an exception or a failed assertion, ends the run: it fails, and does not wait for steps that never come.
template <typename Result>
class BesideRun {
 public:
  template <typename Task>
  BesideRun(ServedWorld& world, Task task) : world_(world), result_(std::async(std::launch::async, std::move(task))) {}
  ~BesideRun() {
    if (result_.valid()) world_.end();
  }
  BesideRun(const BesideRun&) = delete;
  BesideRun& operator=(const BesideRun&) = delete;

  Result get() { return result_.get(); }

 private:
  ServedWorld& world_;
  std::future<Result> result_;  ///< its destructor waits for the task
};
template <typename Task>
BesideRun(ServedWorld&, Task) -> BesideRun<std::invoke_result_t<Task>>;

}  // namespace robosim
