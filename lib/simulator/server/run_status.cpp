#include "server/run_status.h"

#include <algorithm>
#include <cstdint>

namespace robosim {
namespace {

constexpr std::size_t kNamesMax = 100;

v1::RecordingState toRecordingState(RecordingStatus::State state) {
  switch (state) {
    case RecordingStatus::State::none:
      return v1::RECORDING_STATE_NONE;
    case RecordingStatus::State::on:
      return v1::RECORDING_STATE_ON;
    case RecordingStatus::State::off:
      return v1::RECORDING_STATE_OFF;
  }
  return v1::RECORDING_STATE_UNSPECIFIED;
}

v1::LostRobotPolicy toPolicy(OnLostRobot policy) {
  switch (policy) {
    case OnLostRobot::wait:
      return v1::LOST_ROBOT_POLICY_WAIT;
    case OnLostRobot::continue_:
      return v1::LOST_ROBOT_POLICY_CONTINUE;
    case OnLostRobot::fail:
      return v1::LOST_ROBOT_POLICY_FAIL;
  }
  return v1::LOST_ROBOT_POLICY_UNSPECIFIED;
}

}  // namespace

void describeRun(const ServedRun& run, v1::RunStatus& status) {
  const RunInfo& run_info = *run.runInfo();
  const State& state = run_info.environment.state();
  status.set_world(run_info.environment.world().name);
  status.set_world_version(run_info.world_version);
  status.set_step(state.time.step);
  status.set_time_s(state.time.seconds());
  status.set_robots(static_cast<std::uint32_t>(run_info.robot_names.size()));
  status.set_robots_active(
      static_cast<std::uint32_t>(std::count(state.activity.begin(), state.activity.end(), Activity::active)));
  const RecordingStatus recording = run.recording();
  status.set_recording(toRecordingState(recording.state));
  status.set_recording_file(recording.file);
  status.set_recording_failure(recording.failure);
  if (state.winner()) status.set_winner(run_info.robot_names[*state.winner()]);
}

void describeReport(const RunReport& report, v1::RunStatus& status) {
  status.set_on_lost_robot(toPolicy(report.on_lost_robot));
  for (const LostRobot& robot : report.lost_robots) {
    if (static_cast<std::size_t>(status.lost_robots_size()) == kNamesMax) break;
    auto& lost = *status.add_lost_robots();
    lost.set_name(robot.name);
    lost.set_times(robot.times);
    lost.set_steps_missed(robot.steps_missed);
    lost.set_is_lost(robot.is_lost);
  }
  status.set_messages_lost(report.messages_lost);
  status.set_geometry_workers_rejected(static_cast<std::uint32_t>(report.rejected_workers.size()));
}

void describeAbsent(const std::vector<std::string>& names, v1::RunStatus& status) {
  const auto count = static_cast<std::ptrdiff_t>(std::min(names.size(), kNamesMax));
  status.mutable_robots_absent()->Assign(names.begin(), names.begin() + count);
}

}  // namespace robosim
