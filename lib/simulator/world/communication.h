#pragma once
#include <optional>

#include "base/xml_reader.h"

namespace robosim {

/// Maximum of Communication::delay_s.
constexpr double kDelayMax_s = 60;

/// Limits and errors of the robots' communication (environment/radio_channel.h).
struct Communication {
  std::optional<double> range_m = std::nullopt;  ///< between robots' centres; nullopt: unlimited
  double loss_probability = 0;                   ///< of each message, [0, 1]
  double wall_range_m = 0;                       ///< range that each wall between the robots takes, [0, 1e9]
  double wall_loss = 0;                          ///< probability that a message is lost at each wall, [0, 1]
  double burst_gap_s = 0;                        ///< mean time between bursts of losses, [0, 3600]; 0: there are none
  double burst_s = 1;                            ///< mean duration of a burst, (0, 3600]
  double burst_loss = 1;                         ///< probability that a message is lost in a burst, [0, 1]
  double delay_s = 0;                            ///< beyond the next step, rounded up to whole steps, [0, kDelayMax_s]
  double rate_hz = 0;                            ///< messages that a robot may send per second, [0, 1e6]; 0: unlimited
  bool operator==(const Communication&) const = default;

  bool hasWalls() const { return wall_range_m > 0 || wall_loss > 0; }
  bool hasBursts() const { return burst_gap_s > 0 && burst_loss > 0; }
  /// Whether it depends on the run's seed.
  bool isRandom() const { return loss_probability > 0 || wall_loss > 0 || hasBursts(); }
};

/// Reads the settings of a <communication> (doc/world_file.md). @param unit_m one length unit of the file [m]
Communication readCommunication(XmlReader& reader, double unit_m);
/// Adds those settings to an element that differ from the defaults.
void writeCommunication(const Communication& communication, double unit_m, XmlElement& element);

}  // namespace robosim
