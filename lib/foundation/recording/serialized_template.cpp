#include "recording/serialized_template.h"

#include <algorithm>
#include <cstring>

namespace robosim {
namespace {

std::vector<std::uint8_t> serialised(const mrpt::obs::CObservation& observation) {
  ByteArchive archive;
  archive << observation;
  return std::move(archive.bytes);
}

/// Position of a number in the bytes; nullopt when it does not occur exactly once.
std::optional<std::size_t> findPosition(SerializedTemplate::Number number, const std::vector<std::uint8_t>& bytes) {
  const auto same = [](std::uint8_t a, std::byte b) { return a == std::to_integer<std::uint8_t>(b); };
  const auto at = std::search(bytes.begin(), bytes.end(), number.begin(), number.end(), same);
  if (at == bytes.end() || std::search(at + 1, bytes.end(), number.begin(), number.end(), same) != bytes.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(at - bytes.begin());
}

}  // namespace

std::optional<SerializedTemplate> SerializedTemplate::of(const mrpt::obs::CObservation& observation,
                                                         std::vector<Number> changing,
                                                         const std::function<void(int)>& probe) {
  SerializedTemplate result;
  probe(0);
  result.bytes_ = serialised(observation);
  for (const Number number : changing) {
    const auto position = findPosition(number, result.bytes_);
    if (!position) return std::nullopt;
    result.positions_.push_back(*position);
  }
  result.numbers_ = std::move(changing);
  probe(1);
  ByteArchive archive;
  result.append(archive);
  if (archive.bytes != serialised(observation)) return std::nullopt;
  return result;
}

void SerializedTemplate::append(ByteArchive& archive) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    std::memcpy(&bytes_[positions_[i]], numbers_[i].data(), numbers_[i].size());
  }
  archive.bytes.insert(archive.bytes.end(), bytes_.begin(), bytes_.end());
}

}  // namespace robosim
