#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "environment/environment.h"

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
  void end(const StepOrders& orders);
  /// Appends what has changed: of all robots of begin() messages, CheckWin requests and activity, of some the commands.
  /// @param known robots of begin() whose commands the receiver needs
  void write(const StepOrders& orders, std::span<const std::uint32_t> known, std::string& out) const;

 private:
  struct Sent {
    std::size_t messages;
    std::uint64_t surplus;
  };
  bool hasChanged(const StepOrders& orders, std::size_t robot) const;

  RobotRange robots_;
  std::vector<Command> commands_;
  std::vector<Sent> sent_;
  std::vector<std::uint8_t> win_requests_;
  std::string of_all_;  ///< bytes of the changes that all ranks need
  bool has_changes_of_all_ = false;
};
/// @param from robots whose orders the bytes may contain
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
