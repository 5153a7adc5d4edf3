#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "maze/explorer.h"
#include "maze/grid.h"

namespace robosim {

/// Message of a market: "AUCTION <x> <y> <price>" offers a region, "BID <x> <y> <price>" answers it, and
/// "SOLD <x> <y> <price> <robot>" ends it. Prices are lengths of paths [cm].
struct MarketMessage {
  enum class Act { auction, bid, sold };

  Act act = Act::auction;
  Cell region;
  std::int64_t price_cm = 0;
  int robot = -1;  ///< sold: index of the buyer among Robot::robots()

  std::string text() const;
  /// nullopt for any other text.
  static std::optional<MarketMessage> parse(const std::string& text);
};

/// The regions of the world in a market: who owns each until when, and the auction that this robot holds. The owner of
/// a region is the buyer at the lowest price; of equal prices the robot of lower index.
class RegionMarket : public GoalCost {
 public:
  struct Options {
    double region_m = 4;        ///< side of a region
    double cell_m = 0.1;        ///< side of a map cell
    int robot = 0;              ///< index of this robot
    std::uint64_t lease = 600;  ///< steps for which a region is owned
  };
  /// Steps from an auction to its end: the offer and the bids take one each.
  static constexpr std::uint64_t kAuctionSteps = 3;

  explicit RegionMarket(const Options& options) : options_(options), lots_(options.region_m) {}

  Cell regionAt(const mrpt::math::TPoint2D& place) const { return lots_.cellAt(place); }
  mrpt::math::TPoint2D center(const Cell& region) const { return lots_.center(region); }
  void setStep(std::uint64_t step) { step_ = step; }

  /// Index of the owner in the present step; -1 for none.
  int ownerOf(const Cell& region) const;
  /// A free region costs 2 m of path, one of another robot 30 m, and an own one nothing.
  int computeCost(const Cell& map_cell) const override;

  bool isAuctioning() const { return auction_.has_value(); }
  /// Begins an auction in which this robot bids `price_cm`. @return the offer, for all other robots
  MarketMessage auction(const Cell& region, std::int64_t price_cm);
  /// Notes a bid for the region under auction; without effect for another region.
  void bid(const Cell& region, std::int64_t price_cm, int robot);
  /// Ends the auction when its time has come. @return the sale, for all other robots
  std::optional<MarketMessage> sale();
  /// Notes a sale by this or another robot.
  void sold(const Cell& region, std::int64_t price_cm, int robot);

 private:
  struct Lot {
    std::int64_t price_cm = 0;
    int owner = -1;
    std::uint64_t until = 0;  ///< step
  };
  struct Auction {
    Cell region;
    std::int64_t price_cm;
    int robot;  ///< of the best bid
    std::uint64_t ends;
  };

  Options options_;
  Grid<Lot> lots_;
  std::optional<Auction> auction_;
  std::uint64_t step_ = 0;
};

}  // namespace robosim
