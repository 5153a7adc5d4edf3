#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "net/robots.grpc.pb.h"
#include "net/stream_call.h"
#include "server/lobby.h"
#include "server/newcomers.h"

namespace robosim {

/// The conversation with the processes that carry robots: each says which are its own, is sent their readings of every
/// step, and answers with commands. One that makes no sense, or is later than the deadline, loses its connection, and
/// its robots stand still; they may come back under their names.
///
/// Everything is called between steps.
class RobotConversation final : public wire::Robots::WithRawMethod_Drive<wire::Robots::Service> {
 public:
  explicit RobotConversation(Lobby& lobby);
  ~RobotConversation() override;

  /// Lets processes come in.
  void open(const Switchboard::Line& line);
  /// Another world is shown from now on: whoever drives robots of the last is told so, and hung up on.
  void show();
  /// Welcomes the processes that have come, and sends them the readings of the step that stands.
  void admit();
  /// The networked robots that have not been here since show().
  std::vector<std::string> notYetHere() const;
  /// Whether all that were told of this step have answered.
  bool allAnswered() const { return missing_ == 0; }
  /// Hangs up on whoever has let the deadline pass.
  void evictLate();
  /// Hands the answers to the environment; robots whose process has left stop.
  /// @return how many robots' commands have come too late for this step, at the pace of real time
  std::size_t handOver(Environment& environment);
  /// Sends everyone the readings of the new step.
  void tell();
  /// The run is over.
  void sayGoodbye();

  std::size_t connected() const;  ///< robots
  std::size_t processes() const { return streams_.size(); }
  std::vector<std::string> absent() const;      ///< networked robots that are not connected
  std::uint64_t late() const { return late_; }  ///< what handOver() returned, summed over the run

 private:
  class Stream;
  void awaitProcess();
  void called(Stream& stream);
  void hello(Stream& stream, const wire::FromRobots& message);
  void answer(Stream& stream, const wire::FromRobots& message);
  void leave(Stream& stream, const std::string& why);
  void expel(Stream& stream, const grpc::Status& status);
  void ask(Stream& stream);  ///< it is about to be sent readings
  void sendWelcome(Stream& stream);
  void sendReadings(Stream& stream);
  void holdLetters(Stream& stream);

  Lobby& lobby_;
  Switchboard::Line line_{};
  Newcomers<Stream> newcomers_;
  std::vector<std::shared_ptr<Stream>> streams_;  ///< those whose hello was good
  std::vector<Stream*> driver_of_;                ///< by robot; null for nobody
  std::vector<std::uint8_t> has_been_here_;       ///< by robot
  std::vector<std::size_t> left_;                 ///< robots that are to stop
  std::size_t missing_ = 0;                       ///< streams that owe an answer
  std::uint64_t late_ = 0;
};

}  // namespace robosim
