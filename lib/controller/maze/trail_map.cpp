#include "maze/trail_map.h"

#include "base/portable_math.h"
#include "maze/message_numbers.h"

namespace robosim {
namespace {

const std::string kTrail = "TRAIL";

}  // namespace

double TrailMap::decayed(const Trail& trail, std::uint64_t step) const {
  if (trail.amount == 0) return 0;
  return trail.amount * portable::exp(-static_cast<double>(step - trail.step) / evaporation_steps_);
}

void TrailMap::visit(const Cell& cell, std::uint64_t step) {
  trails_.cover(cell, cell);
  if (!trails_.contains(cell)) return;
  Trail& trail = trails_[cell];
  trail = {decayed(trail, step) + 1, step};
}

double TrailMap::amount(const Cell& cell, std::uint64_t step) const {
  return trails_.contains(cell) ? decayed(trails_[cell], step) : 0;
}

std::string TrailMessage::text() const { return messageText(kTrail, {cell.x, cell.y}); }

std::optional<TrailMessage> TrailMessage::parse(const std::string& text) {
  const auto numbers = numbersOf(text, kTrail, 2);
  if (!numbers) return std::nullopt;
  return TrailMessage{{static_cast<int>((*numbers)[0]), static_cast<int>((*numbers)[1])}};
}

}  // namespace robosim
