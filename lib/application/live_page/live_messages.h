#pragma once
#include <string>
#include <vector>

#include "live_page/live_encoding.h"
#include "robots/fleet.h"

namespace robosim {

/// Adds the messages that robots have received in a step, each once with its receivers, up to LiveEncoding::kMaxEvents.
/// @param readings of the robots of the fleet; null: unknown
void addMessages(const Fleet& fleet, const std::vector<const Readings*>& readings, std::vector<LiveEvent>& events);

}  // namespace robosim
