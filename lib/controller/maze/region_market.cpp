#include "maze/region_market.h"

#include <array>
#include <tuple>

#include "maze/message_numbers.h"

namespace robosim {
namespace {

const std::array<std::string, 3> kActs{"AUCTION", "BID", "SOLD"};
constexpr double kFree_m = 2;     // a robot prefers the regions that it owns
constexpr double kOthers_m = 30;  // and leaves those of others to them while there are any in this distance

}  // namespace

std::string MarketMessage::text() const {
  const std::string& word = kActs[static_cast<std::size_t>(act)];
  if (act == Act::sold) return messageText(word, {region.x, region.y, price_cm, robot});
  return messageText(word, {region.x, region.y, price_cm});
}

std::optional<MarketMessage> MarketMessage::parse(const std::string& text) {
  for (std::size_t i = 0; i < kActs.size(); ++i) {
    const auto act = static_cast<Act>(i);
    const auto numbers = numbersOf(text, kActs[i], act == Act::sold ? 4 : 3);
    if (!numbers) continue;
    MarketMessage message{act, {static_cast<int>((*numbers)[0]), static_cast<int>((*numbers)[1])}, (*numbers)[2]};
    if (act == Act::sold) message.robot = static_cast<int>((*numbers)[3]);
    return message;
  }
  return std::nullopt;
}

int RegionMarket::ownerOf(const Cell& region) const {
  if (!lots_.contains(region)) return -1;
  const Lot& lot = lots_[region];
  return step_ < lot.until ? lot.owner : -1;
}

int RegionMarket::computeCost(const Cell& map_cell) const {
  const int owner = ownerOf(regionAt({(map_cell.x + 0.5) * options_.cell_m, (map_cell.y + 0.5) * options_.cell_m}));
  if (owner == options_.robot) return 0;
  return static_cast<int>(Wavefront::kStraight * (owner < 0 ? kFree_m : kOthers_m) / options_.cell_m);
}

MarketMessage RegionMarket::auction(const Cell& region, std::int64_t price_cm) {
  auction_ = {region, price_cm, options_.robot, step_ + kAuctionSteps};
  return {MarketMessage::Act::auction, region, price_cm};
}

void RegionMarket::bid(const Cell& region, std::int64_t price_cm, int robot) {
  if (!auction_ || auction_->region != region) return;
  if (std::tie(price_cm, robot) >= std::tie(auction_->price_cm, auction_->robot)) return;
  auction_->price_cm = price_cm;
  auction_->robot = robot;
}

std::optional<MarketMessage> RegionMarket::sale() {
  if (!auction_ || step_ < auction_->ends) return std::nullopt;
  const MarketMessage sale{MarketMessage::Act::sold, auction_->region, auction_->price_cm, auction_->robot};
  auction_.reset();
  sold(sale.region, sale.price_cm, sale.robot);
  return sale;
}

void RegionMarket::sold(const Cell& region, std::int64_t price_cm, int robot) {
  lots_.cover(region, region);
  if (!lots_.contains(region)) return;
  Lot& lot = lots_[region];
  const bool is_free = step_ >= lot.until;
  if (!is_free && std::tie(lot.price_cm, lot.owner) <= std::tie(price_cm, robot)) return;
  lot = {price_cm, robot, step_ + options_.lease};
}

}  // namespace robosim
