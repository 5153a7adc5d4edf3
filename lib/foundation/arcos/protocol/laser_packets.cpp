#include "arcos/protocol/laser_packets.h"

#include <algorithm>
#include <cstdlib>

#include "arcos/protocol/bytes.h"
#include "arcos/protocol/command.h"

namespace robosim::arcos {

std::size_t LaserRequest::beamCount() const {
  constexpr int kTurn_deg = 360;
  if (increment_centideg <= 0 || end_deg < start_deg) return 0;
  if (std::abs(start_deg) > kTurn_deg || std::abs(end_deg) > kTurn_deg) return 0;
  const auto count = static_cast<std::size_t>((end_deg - start_deg) * 100 / increment_centideg) + 1;
  return count <= kBeamsMax ? count : 0;
}

std::string encodeScan(LaserRequest::Form form, const Scan& scan, bool was_moved, std::size_t laser) {
  const auto& [ranges_mm, reflectance] = scan;
  constexpr std::size_t kReadingsMax = 32;
  const bool is_extended = form == LaserRequest::Form::extended;
  std::string packets;
  for (std::size_t first = 0; first < ranges_mm.size(); first += kReadingsMax) {
    const std::size_t count = std::min(kReadingsMax, ranges_mm.size() - first);
    ByteWriter bytes;
    if (!is_extended) bytes.add(std::int16_t{0}).add(std::int16_t{0}).add(std::int16_t{0});  // pose, which ARIA ignores
    bytes.add(static_cast<std::uint16_t>(ranges_mm.size())).add(static_cast<std::uint16_t>(first));
    bytes.add(static_cast<std::uint8_t>(count));
    for (std::size_t i = first; i < first + count; ++i) {
      bytes.add(ranges_mm[i]);
      if (!is_extended) continue;
      bytes.add(i < reflectance.size() ? reflectance[i] : std::uint8_t{0});
      bytes.add(std::uint8_t{0}).add(std::uint8_t{0});  // unused
    }
    if (is_extended) bytes.add(static_cast<std::uint8_t>(laser)).add(static_cast<std::uint8_t>(was_moved));
    packets += encode(is_extended ? packet_type::laser_extended : packet_type::laser, bytes.bytes());
  }
  return packets;
}

bool ScanAssembler::add(const Packet& packet) {
  const bool is_extended = packet.id == packet_type::laser_extended;
  if (!is_extended && packet.id != packet_type::laser) return false;
  ByteReader bytes(packet.payload);
  if (!is_extended) {
    for (int i = 0; i < 3; ++i) bytes.take<std::int16_t>();
  }
  const std::size_t total = bytes.take<std::uint16_t>();
  const std::size_t first = bytes.take<std::uint16_t>();
  const std::size_t count = bytes.take<std::uint8_t>();
  std::vector<std::uint16_t> ranges;
  for (std::size_t i = 0; i < count; ++i) {
    ranges.push_back(bytes.take<std::uint16_t>());
    if (!is_extended) continue;
    bytes.take<std::uint8_t>();
    bytes.take<std::uint16_t>();
  }
  if (is_extended && bytes.take<std::uint8_t>() != 0) return false;  // of another laser
  if (first == 0) {
    parts_.clear();
    total_ = total;
  }
  // A part is missing, or the packet is not what its header says: waits for the next scan.
  if (bytes.endedEarly() || count == 0 || total != total_ || first != parts_.size() || first + count > total) {
    parts_.clear();
    total_ = 0;
    return false;
  }
  parts_.insert(parts_.end(), ranges.begin(), ranges.end());
  if (parts_.size() < total_) return false;
  scan_.swap(parts_);
  parts_.clear();
  total_ = 0;
  return true;
}

}  // namespace robosim::arcos
