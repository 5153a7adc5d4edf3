// Fuzzes rawlogs, compressed or not: reads to the end, assigns times, and parses them as a RoboSim recording.
#include <filesystem>

#include "recording/observation_times.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "robots/world_source.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/rawlog_memory.h"

using namespace robosim;

namespace {

std::vector<RobotInfo> sampleRobots() {
  std::vector<RobotInfo> robots;
  for (auto& robot : loadWorld(readWorldSource(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml"), {}).fleet.robots) {
    robots.push_back(robot.info);
  }
  return robots;
}

void readAll(const std::filesystem::path& file) {
  RawlogReader reader(file);
  ObservationTimes times;
  while (const auto observation = reader.next()) {
    times.of(*observation, reader.entries());
    Label::parse(observation->sensorLabel);
  }
}

void readSteps(const std::filesystem::path& file) {
  static const std::vector<RobotInfo> robots = sampleRobots();
  RawlogReader reader(file);
  RecordedSteps steps(reader, robots, 0.1);
  while (steps.next()) {
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileInMemory input(data, size);
  try {
    readAll(input.path());
    readSteps(input.path());
  } catch (const ConfigError&) {
  } catch (const RecordingError&) {
  }
  return 0;
}
