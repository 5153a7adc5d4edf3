#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "environment/environment.h"

namespace robosim {

/// @file
/// What ranks exchange in a step, as bytes in the machines' byte order. Only what differs from the state or the default
/// that all ranks have is sent. The readers check the bytes' structure: they throw std::runtime_error for bytes that
/// the writers, of the same version of RoboSim, cannot have written.

/// What the controllers of some robots request in a step.
class OrdersWriter {
 public:
  /// Remembers what all ranks know, before the controllers run.
  void begin(const StepOrders& orders, RobotRange robots);
  /// Appends what has changed since begin().
  void write(const StepOrders& orders, RobotRange robots, std::string& out);

 private:
  struct Sent {
    std::size_t messages;
    std::uint64_t surplus;
  };
  std::vector<Command> commands_;
  std::vector<Sent> sent_;
  std::vector<std::uint8_t> win_requests_;
};
/// @param from robots whose orders the bytes may contain
void readOrders(std::string_view bytes, RobotRange from, const StepOrders& orders);

/// Clipped paths: PhaseResults::paths.
void writePaths(const PhaseResults& results, RobotRange robots, std::string& out);
void readPaths(std::string_view bytes, RobotRange from, const PhaseResults& results);

/// Robots that stay where they started: PhaseResults::stays.
void writeStays(const PhaseResults& results, RobotRange robots, std::string& out);
void readStays(std::string_view bytes, RobotRange from, const PhaseResults& results);

/// Measurements of all robots of a range, which both ranks keep.
void writeReadings(const PhaseResults& results, RobotRange robots, std::string& out);
void readReadings(std::string_view bytes, RobotRange robots, const PhaseResults& results);

}  // namespace robosim
