#include "world/georeference.h"

#include <cmath>

#include "base/angle_units.h"
#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "world/body_xml.h"
#include "world/world.h"

namespace robosim {
namespace {

/// The ellipsoid of WGS 84 (NGA.STND.0036, 2014).
constexpr double kEquator_m = 6378137;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kPole_m = kEquator_m * (1 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1 - kEccentricity2);

/// Radius of curvature perpendicular to the meridian [m].
double normalRadius(double sin_latitude) {
  return kEquator_m / std::sqrt(1 - kEccentricity2 * sin_latitude * sin_latitude);
}

}  // namespace

GeoPosition GeoReference::positionOf(const mrpt::math::TPoint2D& world, double height_m) const {
  const auto local = portable::relative(world_from_geographic, mrpt::math::TPose2D(world.x, world.y, 0));
  const double east_m = local.x, north_m = local.y;
  const auto latitude = portable::sincos(toRadians(origin.latitude_deg));
  const auto longitude = portable::sincos(toRadians(origin.longitude_deg));
  // In the meridian plane of the origin: away from the axis, to the east, along the axis.
  const double normal_m = normalRadius(latitude.sin), up_m = origin.altitude_m + height_m;
  const double out_m = (normal_m + up_m) * latitude.cos - north_m * latitude.sin;
  const double along_m = (normal_m * (1 - kEccentricity2) + up_m) * latitude.sin + north_m * latitude.cos;

  const double axis_distance_m = portable::hypot(out_m, east_m);
  const auto reduced = portable::sincos(portable::atan2(along_m * kEquator_m, axis_distance_m * kPole_m));
  const double latitude_rad =
      portable::atan2(along_m + kSecondEccentricity2 * kPole_m * reduced.sin * reduced.sin * reduced.sin,
                      axis_distance_m - kEccentricity2 * kEquator_m * reduced.cos * reduced.cos * reduced.cos);
  const auto found = portable::sincos(latitude_rad);
  const double longitude_rad =
      portable::atan2(longitude.sin * out_m + longitude.cos * east_m, longitude.cos * out_m - longitude.sin * east_m);
  return {toDegrees(latitude_rad), toDegrees(longitude_rad),
          axis_distance_m * found.cos + along_m * found.sin - kEquator_m * kEquator_m / normalRadius(found.sin)};
}

GeoReference readGeoReference(XmlReader& reader, double unit_m) {
  GeoReference r;
  r.origin.latitude_deg = reader.number("latitude_deg", {-90, 90});
  r.origin.longitude_deg = reader.number("longitude_deg", {-180, 180});
  r.origin.altitude_m = reader.number("altitude_m", {-1000, 10000}, 0);
  r.world_from_geographic.x = reader.length("x", {}, unit_m, 0);
  r.world_from_geographic.y = reader.length("y", {}, unit_m, 0);
  r.world_from_geographic.phi = reader.number("direction", {}, 0);
  reader.finish();
  return r;
}

void writeGeoReference(const GeoReference& reference, double unit_m, XmlElement& element) {
  const auto& [origin, pose] = reference;
  const auto add = [&](const char* name, const std::string& value) { element.attributes.emplace_back(name, value); };
  add("latitude_deg", toText(origin.latitude_deg));
  add("longitude_deg", toText(origin.longitude_deg));
  add("altitude_m", toText(origin.altitude_m));
  add("x", toText(pose.x, unit_m));
  add("y", toText(pose.y, unit_m));
  add("direction", toText(pose.phi));
}

std::optional<GeoReference> georeferenceOf(const World& world) {
  if (world.georeference) return world.georeference;
  for (const WorldMap& map : world.maps) {
    if (map.plan.origin) return GeoReference{*map.plan.origin, map.world_from_map};
  }
  return std::nullopt;
}

}  // namespace robosim
