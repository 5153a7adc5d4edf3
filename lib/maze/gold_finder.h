#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/explorer.h"
#include "maze/gold_message.h"

namespace robosim {

struct GoldFinderOptions {
  double heat_threshold = 10;  ///< heat above this means gold
};

/// The 2005 application: searches a maze for gold, a heat source at an unknown position (see Explorer), and follows its
/// protocol. In each step:
///  - if the heat exceeds the threshold, the robot halts as `found` and sends GOLD, with itself as source, to its
///    neighbour;
///  - on receiving GOLD, it halts and forwards the message unchanged to its neighbour, unless it is the source, where
///    the ring ends. Each source is forwarded once, in case the neighbours form no ring;
///  - it sends at most one message; a robot without a neighbour sends none.
class GoldFinder : public Controller {
 public:
  explicit GoldFinder(const ControllerSetup& setup, const GoldFinderOptions& options = {});
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<GoldFinder>(*this); }
  bool hasDrawnRandomNumbers() const override { return explorer_ && explorer_->hasDrawnRandomNumbers(); }

 private:
  void listen(Robot& robot);
  void speak(Robot& robot);
  void sendGold(const std::string& source);

  ControllerSetup setup_;
  GoldFinderOptions options_;
  std::vector<std::string> forwarded_sources_;  ///< sources already forwarded, or queued in to_send_
  std::deque<GoldMessage> to_send_;
  std::optional<Explorer> explorer_;  ///< constructed in the first step, since it requires the robot
};

}  // namespace robosim
