#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "net/robot_wire.h"
#include "net/stream_session.h"
#include "robosim/v1/robots.grpc.pb.h"
#include "server/robot_attendance.h"
#include "server/robot_inboxes.h"
#include "server/serving_state.h"

namespace robosim {

/// Server side of the Robots service. Each process names its robots, receives their readings of every step, and answers
/// with commands. A process that sends invalid messages or misses the deadline is disconnected, and its robots stand
/// still; it may reconnect under the same names.
///
/// All functions are called between steps.
class RobotSession final : public v1::Robots::WithRawMethod_Drive<v1::Robots::Service> {
 public:
  explicit RobotSession(ServingState& serving);
  ~RobotSession() override;

  /// Starts to accept processes.
  void open(const CompletionQueueServer::ServiceQueues& queues);
  /// Switches to the current ServingState::run_info: disconnects the processes of the previous run.
  void reset();
  /// Continues with the robots that have been added to the run.
  void addRobots();
  /// Admits new processes, and sends them the welcome and the readings of the current step.
  void admit();
  /// Robots that a step must wait for: networked robots that have not joined the run, and with the policy `wait` those
  /// that are lost.
  std::vector<std::string> awaited(OnLostRobot policy) const;
  /// Robots whose process left while they were active.
  std::vector<std::string> lost() const;
  bool isAnyLost() const;
  /// Whether all processes that received this step have answered.
  bool allAnswered() const { return missing_ == 0; }
  /// Disconnects the processes beyond the step deadline.
  void disconnectLate();
  /// Sets the flags of robots whose pictures a process receives: all of a process that does not request pictures, or
  /// that has not answered yet; else those that its last answer requests.
  void addPictured(std::vector<std::uint8_t>& robots) const;
  /// Passes the answers to the environment, including those of processes that have left since; robots without a process
  /// stop.
  /// @return number of robots whose commands were too late for this step, with Pace::realtime
  std::size_t applyAnswers(Environment& environment);
  /// Sends the readings of the new step to all processes.
  void publish();

  std::size_t connected() const { return attendance_.present(); }  ///< robots
  std::size_t processes() const { return streams_.size(); }
  std::vector<std::string> absent() const { return attendance_.absent(); }  ///< networked robots
  std::uint64_t late() const { return late_; }                              ///< sum of applyAnswers() over the run
  /// Adds the robots and messages that the run has lost.
  void describe(RunReport& report) const;

 private:
  class Stream;
  /// The answer of a robot whose process left afterwards: its messages and a final activity apply, a motion command
  /// does not.
  struct LeftAnswer {
    std::size_t robot = 0;
    std::uint64_t step = 0;
    Activity activity = Activity::active;
    std::vector<RobotsAnswer::Message> messages{};
    bool checks_win = false;
    std::uint64_t messages_dropped = 0;  ///< by the whole process, in the answer of its first robot
  };
  static LeftAnswer answerOf(const Stream& stream, std::size_t i);
  /// Whether the process of an earlier call has connected again: same identifier, and same token.
  static bool isSameProcess(const Stream& before, const Stream& now, const v1::RobotsHello& hello);
  void hello(Stream& stream, const v1::DriveRequest& message);
  void answer(Stream& stream, const v1::DriveRequest& message);
  void leave(Stream& stream);
  void expectAnswer(Stream& stream);  ///< called before readings are sent
  void sendWelcome(Stream& stream);
  void sendReadings(Stream& stream);
  void keepInboxes();
  void applyLeftAnswers(Environment& environment);
  static void send(Environment& environment, std::size_t robot, const RobotsAnswer::Message& message);

  ServingState& serving_;
  std::vector<std::shared_ptr<Stream>> streams_;  ///< established
  std::vector<Stream*> driver_of_;                ///< by robot; null for none
  std::vector<std::uint64_t> next_answer_;        ///< by robot: the first step whose answer has not been applied
  RobotAttendance attendance_;
  RobotInboxes inboxes_;
  std::vector<std::size_t> left_;         ///< robots to stop
  std::vector<LeftAnswer> left_answers_;  ///< to apply with the next step
  std::size_t missing_ = 0;               ///< streams that owe an answer
  std::uint64_t late_ = 0;
};

}  // namespace robosim
