#pragma once
#include <optional>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "base/xml_element.h"
#include "base/xml_reader.h"
#include "world/geo_position.h"

namespace robosim {

struct World;

/// Where a world lies on the earth: the ground is the plane that touches the ellipsoid's surface of this altitude at
/// the origin of the geographic frame, whose x axis points east and whose y axis points north.
struct GeoReference {
  GeoPosition origin;
  mrpt::math::TPose2D world_from_geographic;
  bool operator==(const GeoReference&) const = default;

  /// Of a point of the world at a height above the ground. Exact but for rounding (about 1 nm): earth-centred
  /// coordinates, and back by Bowring's formula (Survey Review 181, 1976), whose error is below 1 µm up to 10 km above
  /// the ellipsoid.
  GeoPosition positionOf(const mrpt::math::TPoint2D& world, double height_m) const;
};

/// Reads <georeference>. @param unit_m length unit of the file
GeoReference readGeoReference(XmlReader&, double unit_m);
void writeGeoReference(const GeoReference&, double unit_m, XmlElement&);

/// That of the world file, else that of the first of its maps that has one.
std::optional<GeoReference> georeferenceOf(const World&);

}  // namespace robosim
