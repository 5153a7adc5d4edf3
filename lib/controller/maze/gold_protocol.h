#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "control/robot.h"

namespace robosim {

/// Default heat above which a robot has found gold [°C].
constexpr double kGoldHeat_celsius = 10;

/// Message between gold finders (2005): the gold has been found, and by which robot. As text: "GOLD <source>".
struct GoldMessage {
  std::string source;  ///< the finder's name

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<GoldMessage> parse(const std::string& text);
  bool operator==(const GoldMessage&) const = default;
};

/// The protocol by which a team of 2005 ends its search. In each step:
///  - if the heat exceeds the threshold, the robot halts as `found` and sends GOLD, with itself as source, to its
///    neighbour;
///  - on receiving GOLD, it halts and forwards the message unchanged to its neighbour, unless it is the source, where
///    the ring ends. Each source is forwarded once, in case the neighbours form no ring;
///  - it sends at most one such message; a robot without a neighbour sends none.
class GoldProtocol {
 public:
  explicit GoldProtocol(double heat_threshold = kGoldHeat_celsius) : heat_threshold_(heat_threshold) {}

  /// To be called once per step, first; the robot must then be driven only while it is active.
  void step(Robot& robot);

  /// Heat that is well above the noise of a sensor and below the threshold: gold is near.
  double warm() const { return 0.2 * heat_threshold_; }

 private:
  void listen(Robot& robot);
  void speak(Robot& robot);
  void sendGold(const std::string& source);

  double heat_threshold_;
  std::vector<std::string> forwarded_sources_;  ///< sources already forwarded, or queued in to_send_
  std::deque<GoldMessage> to_send_;
};

}  // namespace robosim
