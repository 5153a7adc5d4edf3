#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/hardware.h"
#include "net/connect.h"

namespace robosim::v1 {
class StepReadings;
}

namespace robosim {

/// Client of the Robots service: the robots of one process, connected to an environment (2005: the hardware
/// simulators). Usage:
///
///     NetworkHardware robots(connect_options, {"Robo", "Scouty"});
///     do {
///       … each controller reads robots.robot(i) and commands it …
///     } while (robots.nextStep());
class NetworkHardware {
 public:
  /// Connects, and waits for the readings of the current step.
  /// @throws ConnectionError when the server does not answer or refuses these robots.
  NetworkHardware(const ConnectOptions& connect_options, const std::vector<std::string>& names);
  ~NetworkHardware();
  NetworkHardware(const NetworkHardware&) = delete;
  NetworkHardware& operator=(const NetworkHardware&) = delete;

  /// In the order of the names given.
  Hardware& robot(std::size_t i);
  std::size_t place(std::size_t i) const;              ///< index in the world
  const std::string& controller(std::size_t i) const;  ///< named by the world file; empty when it names none
  /// Start in the world frame [m, rad]; nullopt if the environment does not give it.
  std::optional<mrpt::math::TPose2D> worldFromStart(std::size_t i) const;
  std::uint64_t seed() const;        ///< of the run
  const std::string& world() const;  ///< its name

  /// Whether the cameras of a robot take pictures, from the next step on; initially they do. No effect without cameras.
  void setPictures(std::size_t robot, bool has_pictures);
  /// Sends the robots' commands and messages since the last step, and waits for the next step's readings.
  /// @return false when the run is over
  /// @throws ConnectionError when the server closes the connection, or it breaks. rejoin() may restore it.
  bool nextStep();
  /// The message from which the robots' readings of this step were decoded, to be forwarded; valid until nextStep() or
  /// rejoin().
  const v1::StepReadings& received() const;

  /// Reconnects under the same names, and waits for the readings of the current step. The robots stay valid and
  /// continue as if some steps had been missed. nextStep() repeats the answer to the last step unless the environment
  /// has received it: each message is delivered exactly once.
  /// @throws ConnectionError as the constructor, and when the server has another world or run.
  void rejoin();
  /// Whether, after rejoin(), the robots have already answered the current step. If so, call nextStep() before the
  /// controllers: if the environment has waited, the run is then bit-identical to one without the interruption.
  bool hasAnswered() const;
  /// Number of messages to other robots that the environment has not confirmed; they are lost unless rejoin() succeeds.
  std::size_t unconfirmedMessages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
