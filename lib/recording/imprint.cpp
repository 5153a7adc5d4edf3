#include "recording/imprint.h"

#include <algorithm>
#include <cstring>

namespace robosim {
namespace {

std::vector<std::uint8_t> serialised(const mrpt::obs::CObservation& observation) {
  ByteArchive archive;
  archive << observation;
  return std::move(archive.bytes);
}

/// nullopt when the number stands nowhere, or at more than one place.
std::optional<std::size_t> placeOf(Imprint::Number number, const std::vector<std::uint8_t>& bytes) {
  const auto same = [](std::uint8_t a, std::byte b) { return a == std::to_integer<std::uint8_t>(b); };
  const auto at = std::search(bytes.begin(), bytes.end(), number.begin(), number.end(), same);
  if (at == bytes.end() || std::search(at + 1, bytes.end(), number.begin(), number.end(), same) != bytes.end()) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(at - bytes.begin());
}

}  // namespace

std::optional<Imprint> Imprint::of(const mrpt::obs::CObservation& observation, std::vector<Number> changing,
                                   const std::function<void(int)>& probe) {
  Imprint imprint;
  probe(0);
  imprint.bytes_ = serialised(observation);
  for (const Number number : changing) {
    const auto place = placeOf(number, imprint.bytes_);
    if (!place) return std::nullopt;
    imprint.places_.push_back(*place);
  }
  imprint.numbers_ = std::move(changing);
  probe(1);
  ByteArchive archive;
  imprint.append(archive);
  if (archive.bytes != serialised(observation)) return std::nullopt;
  return imprint;
}

void Imprint::append(ByteArchive& archive) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    std::memcpy(&bytes_[places_[i]], numbers_[i].data(), numbers_[i].size());
  }
  archive.bytes.insert(archive.bytes.end(), bytes_.begin(), bytes_.end());
}

}  // namespace robosim
