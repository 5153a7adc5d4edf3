#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "maze/controllers.h"
#include "maze/explorer.h"
#include "maze/gold_message.h"

namespace robosim {

struct GoldFinderOptions {
  double heat_threshold = 10;  ///< heat above this means gold
};

/// The 2005 application: searches a maze for gold, a hot thing at an unknown place (see Explorer for how), and follows
/// its protocol. In each step:
///  - heat above the threshold is gold: the robot halts as `found` and tells its neighbour GOLD with itself as source;
///  - told GOLD, it halts and passes it on to its own neighbour, source and all, unless it is the source itself: there
///  the
///    ring ends. What it has already passed on from the same source it does not pass on again, in case the neighbours
///    form no ring;
///  - it sends one message a step; a robot without a neighbour sends none.
class GoldFinder : public Controller {
 public:
  explicit GoldFinder(const ControllerSetup& setup, const GoldFinderOptions& options = {});
  void step(Robot& robot) override;

 private:
  void listen(Robot& robot);
  void speak(Robot& robot);
  void tell(const std::string& source);

  ControllerSetup setup_;
  GoldFinderOptions options_;
  std::vector<std::string> told_of_;  ///< sources that have been told of, or wait in to_send_
  std::deque<GoldMessage> to_send_;
  std::optional<Explorer> explorer_;  ///< from the first step on: it needs to know the robot
};

}  // namespace robosim
