// Fuzzes the console's state machine with events of several pages with different tokens (ConsoleScenario). Aborts when
// a command moves a robot that the token of the page in control does not permit, when motion follows a stop, a switch
// or a change of the driver without a new message, or when a page's queue exceeds its limit.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "console/testing/console_scenario.h"
#include "tests/fuzz/fuzz.h"

namespace {

class Input final : public robosim::ConsoleScenario::Source {
 public:
  Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  bool isEmpty() const override { return at_ == end_; }
  std::uint8_t next() override { return at_ == end_ ? std::uint8_t{0} : *at_++; }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    robosim::ConsoleScenario scenario;
    Input input(data, size);
    while (!input.isEmpty()) scenario.act(input);
    scenario.finish();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::abort();
  }
  return 0;
}
