#include "run/run_observers.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "run/local_run.h"
#include "run/run_summary.h"

namespace robosim {
namespace {

/// Counts its calls, ends after a number of steps, and throws at a step.
class Counting : public Observer {
 public:
  Counting(double end_step, double throw_step) : end_step_(end_step), throw_step_(throw_step) {}
  void observe(const Environment& environment) override {
    ++calls_;
    step_ = static_cast<double>(environment.time().step);
    if (step_ == throw_step_) throw std::runtime_error("cannot count");
  }
  std::string endReason() const override { return step_ >= end_step_ ? "counted enough" : ""; }
  std::vector<Metric> metrics() const override { return {{"calls", calls_}}; }

 private:
  double end_step_, throw_step_;
  double calls_ = 0, step_ = 0;
};

/// Moves the gold in step 2, tries what is impossible, and ends the run in step 4.
class Moving : public Observer {
 public:
  void observe(const Environment&) override {}
  void supervise(Supervisor& supervisor) override {
    const auto step = supervisor.environment().time().step;
    const auto& gold = supervisor.environment().objects().back();
    const auto& pose = gold.body.world_from_body;
    if (step == 2) fault_ = supervisor.apply(PlaceBody{gold.name, pose.x + 0.01, pose.y});
    if (step == 3) fault_ = supervisor.apply(RemoveBody{"nothing like it"});
    if (step == 4) fault_ += supervisor.apply(EndRun{"moved", "it is there"});
  }
  std::vector<Metric> metrics() const override { return {{"faults", fault_.empty() ? 0.0 : 1.0}}; }

 private:
  std::string fault_;
};

/// Adds the observers of this file to this program, once.
void addCounting() {
  const auto names = observers().names();
  if (std::find(names.begin(), names.end(), "counting") != names.end()) return;
  observers().add(
      {"counting",
       "Counts.",
       {{"end_step", 1e6, 0, 1e6, "", "last step"}, {"throw_step", -1, -1, 1e6, "", "step of an exception"}},
       [](const ObserverSetup&, const ParameterValues& p) -> std::unique_ptr<Observer> {
         return std::make_unique<Counting>(p["end_step"], p["throw_step"]);
       }});
  ObserverType moving{"moving", "Moves the gold.", {}, [](const ObserverSetup&, const ParameterValues&) {
                        return std::unique_ptr<Observer>(std::make_unique<Moving>());
                      }};
  moving.supervises = true;
  observers().add(moving);
}

/// A run of the small maze in which no robot moves.
LocalRun runWith(const std::vector<std::string>& chosen) {
  addCounting();
  RunOptions options;
  options.controller = "still";
  options.observers = chosen;
  return LocalRun(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still"), options);
}

TEST(RunObservers, SeeTheStartAndEachStep) {
  addCounting();
  LocalRun run = runWith({"counting"});
  for (int i = 0; i < 3; ++i) run.step();
  const auto metrics = run.observers().metrics();
  ASSERT_EQ(metrics.size(), 1U);
  EXPECT_EQ(metrics[0].name, "counting.calls");
  EXPECT_EQ(metrics[0].value, 4);
}

TEST(RunObservers, EndARunWithAReasonInItsSummary) {
  LocalRun run = runWith({"counting end_step=2"});
  while (!run.isOver()) run.step();
  EXPECT_EQ(run.environment().time().step, 2U);
  EXPECT_EQ(endedByItself(run), EndedBy::observer);
  RunSummary summary = RunSummary::of(run);
  summary.ended_by = endedByItself(run);
  EXPECT_NE(summary.text().find("ended by counting: counted enough"), std::string::npos) << summary.text();
  EXPECT_NE(summary.text().find("counting.calls"), std::string::npos);
  EXPECT_EQ(summary.json()["ended_by"], "observer");
  EXPECT_EQ(summary.json()["ended_by_observer"], "counting");
  EXPECT_EQ(summary.json()["end_reason"], "counted enough");
  summary.ended_by = EndedBy::interrupt;
  EXPECT_TRUE(summary.json()["ended_by_observer"].is_null()) << "what it would end is over already";
}

TEST(RunObservers, ThatSuperviseChangeTheRunInTheirNameAndEndItWithAnOutcome) {
  LocalRun run = runWith({"moving"});
  const auto before = run.environment().objects().back().body.world_from_body;
  std::vector<AppliedIntervention> interventions;
  while (!run.isOver()) {
    run.step();
    if (run.environment().time().step == 2) interventions = run.environment().state().interventions;
  }
  EXPECT_EQ(run.environment().objects().back().body.world_from_body.x, before.x + 0.01);
  ASSERT_EQ(interventions.size(), 1u);
  EXPECT_EQ(interventions[0].step, 3u);
  EXPECT_EQ(interventions[0].intervention.author, "observer moving");
  EXPECT_EQ(run.observers().metrics()[0].value, 1) << "what is impossible was answered";
  EXPECT_EQ(endedByItself(run), EndedBy::intervention);
  RunSummary summary = RunSummary::of(run);
  summary.ended_by = endedByItself(run);
  EXPECT_NE(summary.text().find("ended with the outcome moved: it is there"), std::string::npos) << summary.text();
  EXPECT_EQ(summary.json()["end_outcome"], "moved");
}

TEST(RunObservers, DoNotSuperviseARunWhoseRecordedChangesAreRepeated) {
  addCounting();
  RunOptions options;
  options.controller = "still";
  options.observers = {"moving"};
  options.observers_supervise = false;
  LocalRun run(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "still"), options);
  for (int i = 0; i < 6; ++i) run.step();
  EXPECT_EQ(run.environment().state().interventions_applied, 0u);
  EXPECT_FALSE(run.isOver());
}

TEST(RunObservers, ContinueInAForkFromTheSameState) {
  RunOptions options;
  options.controller = "wander";
  options.observers = {"coverage cell_m=0.1 end_percent=90"};
  LocalRun run(loadWorldToRun(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", "wander"), options);
  for (int i = 0; i < 50; ++i) run.step();
  const auto fork = run.fork();
  const double until_fork = run.observers().metrics()[0].value;
  for (int i = 0; i < 50; ++i) fork->step();
  EXPECT_EQ(run.observers().metrics()[0].value, until_fork);
  EXPECT_GT(fork->observers().metrics()[0].value, until_fork);
  for (int i = 0; i < 50; ++i) run.step();
  EXPECT_EQ(fork->observers().metrics()[0].value, run.observers().metrics()[0].value);
}

TEST(RunObservers, AreNamedWhenTheyCannotBeForked) {
  const LocalRun run = runWith({"counting end_step=9"});
  try {
    run.fork();
    FAIL() << "no exception";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "observer 'counting end_step=9': has no clone(), so that its run cannot be forked; add "
                 "Observer::clone() to it, or run without it");
  }
}

TEST(RunObservers, DoNotChangeARun) {
  LocalRun watched = runWith({"counting", "coverage"}), alone = runWith({});
  for (int i = 0; i < 5; ++i) {
    watched.step();
    alone.step();
  }
  EXPECT_EQ(watched.environment().digest(), alone.environment().digest());
}

TEST(RunObservers, AreNamedInTheirExceptions) {
  LocalRun run = runWith({"counting throw_step=1"});
  try {
    run.step();
    FAIL() << "no exception";
  } catch (const ObserverError& error) {
    EXPECT_STREQ(error.what(), "observer 'counting throw_step=1' threw an exception: cannot count");
  }
}

TEST(RunObservers, AreRejectedWhenUnknownOrGivenTwice) {
  addCounting();
  EXPECT_THROW(checkObservers({"nothing"}), ConfigError);
  EXPECT_THROW(checkObservers({"coverage cell_m=0"}), ConfigError);
  EXPECT_THROW(checkObservers({"counting", "counting end_step=1"}), ConfigError);
  EXPECT_NO_THROW(checkObservers({"counting", "coverage"}));
  try {
    checkObservers({"coverage 3"});
    FAIL() << "no exception";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "observer 'coverage': '3' is no parameter; write PARAMETER=VALUE");
  }
}

}  // namespace
}  // namespace robosim
