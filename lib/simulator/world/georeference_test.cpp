#include "world/georeference.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "world/world_file.h"

namespace robosim {
namespace {

constexpr double kEquator_m = 6378137, kEccentricity2 = 0.00669437999014;

TEST(GeoReference, IsExactAtItsOrigin) {
  for (const GeoPosition& origin : {GeoPosition{0, 0, 0}, GeoPosition{48.5, 11.25, 520}, GeoPosition{-77, 166.5, 24}}) {
    const GeoPosition position = GeoReference{origin, {3, 4, 0.5}}.positionOf({3, 4}, 0);
    EXPECT_NEAR(position.latitude_deg, origin.latitude_deg, 1e-12);
    EXPECT_NEAR(position.longitude_deg, origin.longitude_deg, 1e-12);
    EXPECT_NEAR(position.altitude_m, origin.altitude_m, 2e-9);
  }
}

TEST(GeoReference, MeasuresMetresByTheRadiiOfCurvatureOfTheEllipsoid) {
  const GeoReference equator;  // at 0° N, 0° E, x to the east
  const double meridian_m = kEquator_m * (1 - kEccentricity2);
  EXPECT_NEAR(toRadians(equator.positionOf({0, 1}, 0).latitude_deg), 1 / meridian_m, 1e-15);
  EXPECT_NEAR(toRadians(equator.positionOf({1, 0}, 0).longitude_deg), 1 / kEquator_m, 1e-15);
  // A point to the east of another one at 60° N is farther along in longitude, by 1 / cos of the latitude.
  const GeoReference north{{60, 20, 0}, {}};
  const double normal_m = kEquator_m / std::sqrt(1 - kEccentricity2 * 0.75);
  EXPECT_NEAR(toRadians(north.positionOf({1, 0}, 0).longitude_deg - 20), 1 / (normal_m * 0.5), 1e-15);
}

TEST(GeoReference, LeavesTheEarthAlongItsTangentPlane) {
  // 10 km along the tangent at the equator: √(a² + d²) − a above the ellipsoid, whose section there is a circle.
  EXPECT_NEAR(GeoReference{}.positionOf({10'000, 0}, 0).altitude_m, std::hypot(kEquator_m, 10'000) - kEquator_m, 1e-6);
  EXPECT_NEAR(GeoReference{}.positionOf({0, 0}, 12.5).altitude_m, 12.5, 2e-9);
}

TEST(GeoReference, TurnsWithTheMap) {
  // The geographic frame is turned by 90°, so that the world's y axis points east.
  const GeoReference turned{{0, 0, 0}, {0, 0, M_PI / 2}};
  EXPECT_NEAR(toRadians(turned.positionOf({0, 1}, 0).longitude_deg), 1 / kEquator_m, 1e-15);
}

World worldOfText(const std::string& text) {
  ErrorList errors;
  World world = parseWorld(text, "w.xml", errors);
  errors.throwIfAny();
  return world;
}

World referencedWorld(const std::string& georeference) {
  return worldOfText(
      "<world unit_m='10'>" + georeference +
      "<surface><size><xmin>0</xmin><xmax>1</xmax><ymin>0</ymin><ymax>1</ymax></size></surface></world>");
}

TEST(GeoReference, IsReadAndWrittenInTheUnitOfTheFile) {
  const World world =
      referencedWorld("<georeference latitude_deg='48.5' longitude_deg='-11' altitude_m='520' x='2' direction='0.5'/>");
  EXPECT_EQ(world.georeference, (GeoReference{{48.5, -11, 520}, {20, 0, 0.5}}));
  EXPECT_EQ(worldOfText(toXml(world)), world);
  EXPECT_EQ(referencedWorld("").georeference, std::nullopt);
}

TEST(GeoReference, IsThatOfAMapUnlessTheWorldHasOne) {
  World world = referencedWorld("");
  EXPECT_EQ(georeferenceOf(world), std::nullopt);
  world.maps.resize(2);
  world.maps[1].plan.origin = GeoPosition{1, 2, 3};
  world.maps[1].world_from_map = {4, 5, 0};
  EXPECT_EQ(georeferenceOf(world), (GeoReference{{1, 2, 3}, {4, 5, 0}}));
  world.georeference = GeoReference{{6, 7, 8}, {}};
  EXPECT_EQ(georeferenceOf(world), world.georeference);
}

TEST(GeoReference, RefusesImpossibleCoordinates) {
  try {
    referencedWorld("<georeference latitude_deg='91' longitude_deg='0'/>");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("latitude_deg=\"91\">: must lie in [-90, 90]"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace robosim
