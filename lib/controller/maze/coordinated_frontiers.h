#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/explorer.h"
#include "maze/gold_protocol.h"
#include "maze/map_sharing.h"

namespace robosim {

struct CoordinatedFrontiersOptions {
  double heat_threshold = kGoldHeat_celsius;
  double range_m = 6;      ///< distance from another robot's target at which a place has its full utility
  double discount_m = 12;  ///< path that a place at another robot's target is to be farther than one of full utility
  double share_s = 1;      ///< between two messages with parts of the map
};

/// The targets of the other robots of a team; they reduce the utility of the places around them.
class TeamTargets : public GoalCost {
 public:
  /// @param cell_m side of a map cell
  TeamTargets(const CoordinatedFrontiersOptions& options, double cell_m) : options_(options), cell_m_(cell_m) {}

  /// Sets the target of a robot [m, world frame]; nullopt for none.
  void set(const std::string& robot, const std::optional<mrpt::math::TPoint2D>& target);
  /// Sum over the targets of discount_m · (1 - distance / range_m), where that is positive.
  int computeCost(const Cell& cell) const override;

 private:
  CoordinatedFrontiersOptions options_;
  double cell_m_;
  std::vector<std::pair<std::string, mrpt::math::TPoint2D>> targets_;  ///< sorted by name
};

/// Message between robots: the sender's target. As text: "TARGET <x> <y>" [mm, world frame], and "TARGET" for none.
struct TargetMessage {
  std::optional<mrpt::math::TPoint2D> target_m;

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<TargetMessage> parse(const std::string& text);
};

/// Coordinated frontier-based exploration (Burgard, Moors, Stachniss & Schneider, "Coordinated multi-robot
/// exploration", IEEE Transactions on Robotics 21, 2005). The robots share their maps by messages (MapSharing), and
/// each chooses the frontier of least path cost minus utility, where the targets of others reduce the utility of the
/// places around them. Departures: each robot decides by itself, on the targets received, without a central assignment;
/// and the utility decreases linearly to the distance range_m, whatever is in between. A robot that does not know its
/// start in the world works alone.
class CoordinatedFrontiers : public Controller {
 public:
  explicit CoordinatedFrontiers(const ControllerSetup& setup, const CoordinatedFrontiersOptions& options = {});
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<CoordinatedFrontiers>(*this); }
  bool hasDrawnRandomNumbers() const override { return explorer_ && explorer_->hasDrawnRandomNumbers(); }

 private:
  void listen(const Robot& robot);
  void speak(Robot& robot);

  ControllerSetup setup_;
  CoordinatedFrontiersOptions options_;
  GoldProtocol protocol_;
  MapSharing sharing_;
  std::optional<Explorer> explorer_;  ///< constructed in the first step, since it requires the robot
  std::optional<TeamTargets> targets_;
  std::optional<Cell> sent_target_;
};

}  // namespace robosim
