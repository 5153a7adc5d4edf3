#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "environment/environment.h"
#include "environment/state_stream.h"
#include "environment/step_phases.h"

namespace robosim {

/// @file
/// What ranks exchange in a step, as bytes in the machines' byte order. Only what differs from the state or the default
/// that the ranks have is sent: no bytes if nothing does. The readers throw as readRankBytes() does.

/// What the controllers of some robots request in a step.
class OrdersWriter {
 public:
  /// Remembers what other ranks know, before the controllers run.
  void begin(const StepOrders& orders, RobotRange robots);
  /// Finds what has changed since begin(), after they have run.
  /// @param known_to_all robots of begin() whose commands all other ranks need
  void end(const StepOrders& orders, std::span<const std::uint32_t> known_to_all);
  /// Bytes of the changes that all other ranks need: messages, CheckWin requests and activity of all robots of begin(),
  /// and commands of some. Empty for none.
  std::string_view forAll() const { return for_all_; }
  /// Appends changed commands. @param known robots of begin() whose commands the receiver needs besides
  void writeCommands(const StepOrders& orders, std::span<const std::uint32_t> known, std::string& out) const;

 private:
  struct Sent {
    std::size_t messages;
    std::uint64_t surplus;
  };
  bool hasChanged(const StepOrders& orders, std::size_t robot) const;
  bool addCommands(StateWriter& writer, const StepOrders& orders, std::span<const std::uint32_t> known) const;

  RobotRange robots_;
  std::vector<Command> commands_;
  std::vector<Sent> sent_;
  std::vector<std::uint8_t> win_requests_;
  std::string for_all_;
};
/// Reads OrdersWriter::writeCommands(). @param from robots whose orders the bytes may contain
void readCommands(std::string_view bytes, RobotRange from, const StepOrders& orders);
/// Reads OrdersWriter::forAll().
void readOrders(std::string_view bytes, RobotRange from, const StepOrders& orders);

/// Clipped paths: PhaseResults::paths.
void writePaths(const PhaseResults& results, std::span<const std::uint32_t> robots, std::string& out);
void readPaths(std::string_view bytes, RobotRange from, const PhaseResults& results);

/// Robots that stay where they started: PhaseResults::stays.
void writeStays(const PhaseResults& results, std::span<const std::uint32_t> robots, std::string& out);
void readStays(std::string_view bytes, RobotRange from, const PhaseResults& results);

/// Measurements of all robots of a range, which both ranks keep.
void writeReadings(const PhaseResults& results, RobotRange robots, std::string& out);
void readReadings(std::string_view bytes, RobotRange robots, const PhaseResults& results);

/// Motion and commands of robots, in ascending order.
void writeMotion(const MotionState& motion, const StepOrders& orders, std::span<const std::uint32_t> robots,
                 std::string& out);
/// @param read the robots in the bytes are appended
void readMotion(std::string_view bytes, RobotRange from, const MotionState& motion, const StepOrders& orders,
                std::vector<std::uint32_t>& read);

}  // namespace robosim
