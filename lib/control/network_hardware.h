#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hardware/hardware.h"
#include "net/dial.h"

namespace robosim {

/// The robots of one process at the far end of a connection to an environment (2005: the hardware simulators). Step by
/// step:
///
///     NetworkHardware robots(dial_options, {"Robo", "Scouty"});
///     do {
///       … each controller looks at robots.robot(i) and commands it …
///     } while (robots.nextStep());
class NetworkHardware {
 public:
  /// Connects, and waits for the readings of the step that stands.
  /// @throws ConnectionError when nobody answers, or the environment will not have these robots.
  NetworkHardware(const DialOptions& dial_options, const std::vector<std::string>& names);
  ~NetworkHardware();
  NetworkHardware(const NetworkHardware&) = delete;
  NetworkHardware& operator=(const NetworkHardware&) = delete;

  /// In the order of the names given.
  Hardware& robot(std::size_t i);
  std::size_t place(std::size_t i) const;              ///< in the world's list
  const std::string& controller(std::size_t i) const;  ///< what the world would have it run; empty when it does not say
  std::uint64_t seed() const;                          ///< of the run
  const std::string& world() const;                    ///< its name

  /// Sends what the robots were told since the last step, and waits for the next step's readings.
  /// @return false when the run is over
  /// @throws ConnectionError when the environment hangs up, or is gone. Then rejoin(), or give up.
  bool nextStep();

  /// Connects anew under the same names, and waits for the readings of the step that stands: the robots and whoever
  /// holds them go on as if a few steps had been missed. What robots had said since the last step is said again.
  /// @throws ConnectionError as the constructor, and when another world or another run is there now.
  void rejoin();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
