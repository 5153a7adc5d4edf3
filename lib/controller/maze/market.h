#pragma once
#include <optional>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/explorer.h"
#include "maze/gold_protocol.h"
#include "maze/map_sharing.h"
#include "maze/region_market.h"

namespace robosim {

struct MarketOptions {
  double heat_threshold = kGoldHeat_celsius;
  double region_m = 4;  ///< side of the square regions that are sold
  double lease_s = 60;  ///< time for which a region is owned
  double share_s = 1;   ///< between two messages with parts of the map
};

/// Exploration controlled by a market economy (Zlot, Stentz, Dias & Thayer, "Multi-robot exploration controlled by a
/// market economy", ICRA 2002). A robot whose next frontier lies in a free region auctions that region among all robots
/// by messages; the bid of the lowest cost, the distance from the end of the bidder's present task, wins. A robot
/// explores its own regions first, then free ones, and those of others last. Maps are shared as by
/// CoordinatedFrontiers. Departures: bids have no revenue, only costs, which are straight distances; tasks are square
/// regions instead of single points, and a sale ends after lease_s, so that a region of a failed robot becomes free. A
/// robot that does not know its start works alone.
class Market : public Controller {
 public:
  explicit Market(const ControllerSetup& setup, const MarketOptions& options = {});
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Market>(*this); }
  bool hasDrawnRandomNumbers() const override { return explorer_ && explorer_->hasDrawnRandomNumbers(); }

 private:
  void listen(Robot& robot);
  void trade(Robot& robot);
  /// Cost [cm] of driving to a place, from the robot or, if it has a task, from the end of that.
  std::int64_t computePrice(const mrpt::math::TPoint2D& place, bool after_task) const;

  ControllerSetup setup_;
  MarketOptions options_;
  GoldProtocol protocol_;
  MapSharing sharing_;
  std::optional<Explorer> explorer_;  ///< constructed in the first step, since it requires the robot
  std::optional<RegionMarket> regions_;
};

}  // namespace robosim
