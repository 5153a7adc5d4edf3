#include "maze/market.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr double kPriceMax_cm = 1e8;

int indexOf(const std::string& robot, const std::vector<std::string>& robots) {
  const auto found = std::find(robots.begin(), robots.end(), robot);
  return found == robots.end() ? -1 : static_cast<int>(found - robots.begin());
}

}  // namespace

Market::Market(const ControllerSetup& setup, const MarketOptions& options)
    : setup_(setup), options_(options), protocol_(options.heat_threshold) {}

void Market::step(Robot& robot) {
  protocol_.step(robot);
  if (robot.activity() != Activity::active) return;
  if (!explorer_) {
    explorer_.emplace(robot, setup_, protocol_.warm(), setup_.world_from_start.value_or(mrpt::math::TPose2D()));
    regions_.emplace(RegionMarket::Options{options_.region_m, explorer_->map().cellSize(),
                                           indexOf(robot.name(), robot.robots()), robot.stepsIn(options_.lease_s)});
  }
  regions_->setStep(robot.stepNumber());
  if (!setup_.world_from_start) return explorer_->step(robot);
  listen(robot);
  explorer_->step(robot, &*regions_);
  trade(robot);
  const std::uint64_t share_steps = robot.stepsIn(options_.share_s);
  if (robot.stepNumber() % share_steps != setup_.robot % share_steps) return;
  if (const auto part = sharing_.next(explorer_->map())) robot.broadcast(part->text());
}

std::int64_t Market::computePrice(const mrpt::math::TPoint2D& place, bool after_task) const {
  const auto goal = after_task ? explorer_->searchGoal() : std::nullopt;
  const auto& pose = explorer_->pose();
  const mrpt::math::TPoint2D here(pose.x, pose.y);
  const mrpt::math::TPoint2D end = goal ? explorer_->map().center(*goal) : here;
  const double path_m = (end - here).norm() + (place - end).norm();
  return std::llround(std::min(kPriceMax_cm, 100 * path_m));
}

void Market::listen(Robot& robot) {
  for (const RobotMessage& message : robot.inbox()) {
    if (const auto map = MapMessage::parse(message.text)) {
      sharing_.receive(*map, explorer_->search());
      continue;
    }
    const auto deal = MarketMessage::parse(message.text);
    if (!deal) continue;
    switch (deal->act) {
      case MarketMessage::Act::auction: {
        const std::int64_t price_cm = computePrice(regions_->center(deal->region), true);
        if (price_cm < deal->price_cm) {
          robot.send(message.from, MarketMessage{MarketMessage::Act::bid, deal->region, price_cm}.text());
        }
        break;
      }
      case MarketMessage::Act::bid:
        regions_->bid(deal->region, deal->price_cm, indexOf(message.from, robot.robots()));
        break;
      case MarketMessage::Act::sold:
        regions_->sold(deal->region, deal->price_cm, deal->robot);
        break;
    }
  }
}

void Market::trade(Robot& robot) {
  if (const auto sale = regions_->sale()) {
    robot.broadcast(sale->text());
    if (regions_->ownerOf(sale->region) != static_cast<int>(setup_.robot)) explorer_->dropGoal();
  }
  const auto goal = explorer_->searchGoal();
  if (!goal || regions_->isAuctioning()) return;
  const Cell region = regions_->regionAt(explorer_->map().center(*goal));
  if (regions_->ownerOf(region) >= 0) return;
  robot.broadcast(regions_->auction(region, computePrice(regions_->center(region), false)).text());
}

}  // namespace robosim
