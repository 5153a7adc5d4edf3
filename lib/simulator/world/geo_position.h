#pragma once

namespace robosim {

/// A position on the earth (WGS 84).
struct GeoPosition {
  double latitude_deg = 0;   ///< [-90, 90], north is positive
  double longitude_deg = 0;  ///< [-180, 180], east is positive
  double altitude_m = 0;     ///< above the ellipsoid
  bool operator==(const GeoPosition&) const = default;
};

}  // namespace robosim
