#include "replay/run_tables.h"

#include <utility>

#include "base/atomic_file.h"
#include "base/log.h"
#include "run/output_files.h"

namespace robosim {

RunTables::RunTables(std::vector<RecordingOutput> tables, const std::string& world, const Environment& environment,
                     const RunNote& note)
    : tables_(std::move(tables)) {
  if (tables_.empty()) return;
  for (const auto& table : tables_) {
    refuseOverwriting(listInputFiles(world, environment.world()), {table.file});
    checkWritable(table.file);
  }
  std::vector<RobotInfo> robots;
  for (const auto& robot : environment.fleet().robots) robots.push_back(robot.info);
  robots_ = robots.size();
  folder_.emplace();
  recording_ =
      std::make_unique<RawlogWriter>(rawlog(), robots, RawlogFormat::observations, RawlogImages::embedded, note.text());
}

void RunTables::observe(const Environment& environment) {
  if (!recording_) return;
  const State& state = environment.state();
  const auto& robots = environment.fleet().robots;
  for (; robots_ < robots.size(); ++robots_) recording_->addRobot(robots[robots_].info);
  recording_->write(state.readings, state.world_from_robot, state.commands);
}

void RunTables::finish() {
  if (!recording_) return;
  recording_->close();
  exportRecording(rawlog().string(), tables_, nullptr);
}

void RunTables::keep() noexcept {
  try {
    finish();
  } catch (const std::exception& error) {
    logError("run", std::string("the tables of the failed run cannot be written: ") + error.what());
  }
}

}  // namespace robosim
