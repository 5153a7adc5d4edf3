#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arcos/protocol/packet.h"

namespace robosim::arcos {

/// The laser scan that a program requests from a simulator. Beam k points at start + k·increment from straight ahead,
/// counter-clockwise, so that the first one is on the right.
struct LaserRequest {
  enum class Form : std::uint8_t {
    off,
    ranges,    ///< packet_type::laser
    extended,  ///< packet_type::laser_extended: with reflectance; ARIA requests this one
  };
  Form form = Form::off;
  int start_deg = -90;
  int end_deg = 90;
  int increment_centideg = 100;
  bool operator==(const LaserRequest&) const = default;

  /// Number of beams; 0 for values that describe no scan: an increment that is not positive, an end before the start,
  /// directions beyond ±360°, or more than kBeamsMax beams.
  std::size_t beamCount() const;
  static constexpr std::size_t kBeamsMax = 4096;
};

/// Number of lasers that a program may request; the first is 0, the one that ARIA knows.
constexpr std::size_t kLasersMax = 4;

/// Reflectance that a simulator reports of a reflector; 0 of everything else. MobileSim sends the same.
constexpr std::uint8_t kReflector = 33;

/// A scan, from the first beam to the last.
struct Scan {
  std::span<const std::uint16_t> ranges_mm;
  std::span<const std::uint8_t> reflectance = {};  ///< of each beam; empty: 0
};

/// Reading of a beam without an echo [mm]: more than the 32,000 mm that ARIA accepts from an LMS200.
constexpr std::uint16_t kNoEcho_mm = 32767;

/// The packets of one scan, concatenated. Each has at most 32 readings, as many as fit.
/// @param form not off; only extended packets have the reflectance and the laser
/// @param was_moved whether the robot has been placed elsewhere since the last scan
std::string encodeScan(LaserRequest::Form form, const Scan& scan, bool was_moved, std::size_t laser = 0);

/// Joins the packets of a scan of the first laser; those of others are none.
class ScanAssembler {
 public:
  /// @return whether the packet completes a scan, which scan() then returns
  bool add(const Packet& packet);
  const std::vector<std::uint16_t>& scan() const { return scan_; }  ///< ranges [mm]

 private:
  std::vector<std::uint16_t> parts_;  ///< of the scan that is being received
  std::size_t total_ = 0;
  std::vector<std::uint16_t> scan_;
};

}  // namespace robosim::arcos
