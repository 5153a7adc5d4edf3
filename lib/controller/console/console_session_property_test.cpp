// Random sequences of events of the console, 100,000 in all. ConsoleHarness states and checks what holds in every
// state.
#include <optional>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "console/testing/console_scenario.h"

namespace robosim {
namespace {

constexpr std::uint64_t kSeeds = 100;
constexpr int kEventsPerSeed = 1000;

/// Random events with the proportions of a busy console: a holder of the control lock who drives, others that try to,
/// pages that read slowly, invalid messages, and robots that are lost.
class RandomEvents {
 public:
  explicit RandomEvents(std::uint64_t seed, const std::optional<Rounds::Options>& rounds = std::nullopt)
      : scenario(rounds), has_rounds_(rounds.has_value()), engine_(seed) {}

  void act() {
    if (harness().pages.empty()) return scenario.open();
    const PageId page = anyPage();
    if (harness().page(page).is_leaving && below(2) == 0) return harness().close(page);
    const std::size_t percent = below(100);
    if (percent < 3) return scenario.open();
    if (percent < 8) return harness().hello(page, ConsoleScenario::kTokens[below(below(10) == 0 ? 5 : 4)]);
    if (percent < 9) return harness().close(page);
    if (percent < 10) return harness().send(page, nonsense());
    if (percent < 25) return harness().tick(std::chrono::milliseconds(below(has_rounds_ ? 1000 : 100)));
    if (percent < 35) return harness().step(below(2) == 0 ? "picture" : "");
    if (percent < 50) return read(page);
    if (percent < 52) return ConsoleScenario::change(harness().row[below(3)].news, below(4));
    if (percent < 53) return burst(page);
    if (percent < 59 && has_rounds_) {
      return harness().send(page, ConsoleScenario::kRoundMessages[below(std::size(ConsoleScenario::kRoundMessages))]);
    }
    if (percent < 59) return harness().send(page, R"({"type":"take"})");
    const PageId holder = harness().session.lockHolder();
    const std::size_t acks = 1;  // the last message, which read() sends
    const char* message = ConsoleScenario::kMessages[below(std::size(ConsoleScenario::kMessages) - acks)];
    harness().send(holder != 0 && below(10) < 6 ? holder : page, message);
  }

  ConsoleScenario scenario;

 private:
  ConsoleHarness& harness() { return scenario.harness; }
  std::size_t below(std::size_t bound) { return (engine_() >> 32) % bound; }
  PageId anyPage() {
    const auto& pages = harness().pages;
    return std::next(pages.begin(), static_cast<std::ptrdiff_t>(below(pages.size())))->first;
  }
  std::string nonsense() {
    std::string text = below(2) == 0 ? "" : R"({"type":"drive")";
    for (std::size_t i = below(40); i > 0; --i) text += static_cast<char>(below(256));
    return text;
  }
  void read(PageId page) {
    harness().read(page, below(ConsoleScenario::kMaxWaiting));
    if (below(5) != 0) harness().acknowledge(page);
  }
  void burst(PageId page) {
    const char* message = ConsoleScenario::kMessages[below(std::size(ConsoleScenario::kMessages))];
    for (int i = 0; i < 256; ++i) harness().send(page, message);
  }

  bool has_rounds_;
  std::mt19937_64 engine_;
};

TEST(ConsoleSessionProperty, OnlyTheHolderDrivesAStopHoldsAndOutboxesAreBoundedInRandomSequences) {
  std::size_t motions = 0, switches = 0, disconnections = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    RandomEvents events(seed);
    for (int i = 0; i < kEventsPerSeed; ++i) ASSERT_NO_THROW(events.act()) << "event " << i;
    ASSERT_NO_THROW(events.scenario.finish());
    motions += events.scenario.harness.motions;
    switches += events.scenario.harness.switches;
    disconnections += events.scenario.harness.disconnections;
  }
  EXPECT_GT(motions, 1000u) << "the sequences do move robots";
  EXPECT_GT(switches, 100u);
  EXPECT_GT(disconnections, 100u);
}

// Rounds of 10 s, in sequences of minutes: the robot explores only between rounds, and moves only for the visitor whose
// round it is.
TEST(ConsoleSessionProperty, OnlyTheVisitorOfTheRoundDrivesInRandomSequences) {
  std::size_t motions = 0, restarts = 0, rounds = 0;
  for (std::uint64_t seed = 0; seed < kSeeds / 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomEvents events(seed, Rounds::Options{.length = std::chrono::seconds(10), .teams = {"Red", "Blue"}});
    ConsoleHarness& harness = events.scenario.harness;
    harness.run.may_replace = seed % 2 == 0;
    PageId former = 0;
    for (int i = 0; i < kEventsPerSeed; ++i) {
      ASSERT_NO_THROW(events.act()) << "event " << i;
      const PageId holder = harness.session.lockHolder();
      if (std::exchange(former, holder) != holder && holder != 0) ++rounds;
    }
    ASSERT_NO_THROW(events.scenario.finish());
    motions += harness.motions;
    restarts += harness.restarts;
  }
  EXPECT_GT(motions, 20u) << "the sequences do move robots";
  EXPECT_GT(rounds, 20u);
  EXPECT_GT(restarts, 20u);
}

}  // namespace
}  // namespace robosim
