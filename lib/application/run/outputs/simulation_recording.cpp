#include "run/outputs/simulation_recording.h"

#include <optional>
#include <string>
#include <utility>

#include "recording/rawlog_writer.h"
#include "run/output_files.h"
#include "run/outputs/intervention_note.h"
#include "run/outputs/run_note.h"
#include "run/outputs/world_topics.h"

namespace robosim {
namespace {

std::vector<RobotInfo> robotsOf(const Environment& environment) {
  std::vector<RobotInfo> robots;
  for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
  return robots;
}

class Recording final : public SimulationRecording {
 public:
  Recording(const std::filesystem::path& file, const Environment& environment, RunNote note)
      : note_(std::move(note)),
        robots_(environment.robotCount()),
        writer_(file, robotsOf(environment), RawlogFormat::observations, RawlogImages::embedded, note_.text()) {
    auto* const mcap = writer_.mcap();
    if (!mcap) return;
    const State& state = environment.state();
    topics_.emplace(environment.model()).begin(*mcap, note_, state.objects, nanosecondsOf(state.time.seconds()));
  }

  void observe(const Environment& environment) override {
    const State& state = environment.state();
    const auto& robots = environment.fleet().robots;
    const auto notes = notesBefore(state, state.time.step, is_new_);
    std::vector<TopicMessage> messages;
    if (topics_) {
      const auto winner = state.winner();
      messages = topics_->of(state.objects, notes, winner ? robots[*winner].info.name : "",
                             nanosecondsOf(state.time.seconds()));
    }
    for (; robots_ < robots.size(); ++robots_) writer_.addRobot(robots[robots_].info);
    writer_.write(state.readings, state.world_from_robot, state.commands, notes, messages,
                  topics_ ? trueVelocities(state) : std::vector<RobotVelocity>());
    is_new_ = false;
  }

  void finish(const Environment& environment, const RunSummary& outcome) override {
    note_.outcome = outcome.json();
    // Equal runs give equal files.
    for (const char* of_the_clock : {"wall_s", "real_time_factor"}) note_.outcome.erase(of_the_clock);
    const State& state = environment.state();
    if (auto* const mcap = writer_.mcap()) WorldTopics::end(*mcap, note_);
    writer_.close(note_.text(), notesBefore(state, state.time.step + 1, false));
  }

 private:
  RunNote note_;
  std::size_t robots_;  ///< number of those that the file has
  RawlogWriter writer_;
  std::optional<WorldTopics> topics_;  ///< of a file that is MCAP
  bool is_new_ = true;                 ///< no step has been written
};

}  // namespace

std::unique_ptr<SimulationRecording> recordSimulation(const std::filesystem::path& file, const WorldSource& source,
                                                      const LocalRun& run, const RunOptions& options,
                                                      const std::vector<std::uint8_t>& elsewhere) {
  const Environment& environment = run.environment();
  refuseOverwriting(listInputFiles(source.file, environment.world()), {file});
  auto recording = std::make_unique<Recording>(file, environment, makeNote(source, run, options, elsewhere));
  recording->observe(environment);
  return recording;
}

}  // namespace robosim
