#include "maze/gold_message.h"

namespace robosim {
namespace {

const std::string kPrefix = "GOLD ";

}  // namespace

std::string GoldMessage::text() const { return kPrefix + source; }

std::optional<GoldMessage> GoldMessage::parse(const std::string& text) {
  if (!text.starts_with(kPrefix) || text.size() == kPrefix.size()) return std::nullopt;
  return GoldMessage{text.substr(kPrefix.size())};
}

}  // namespace robosim
