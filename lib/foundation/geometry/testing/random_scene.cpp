#include "geometry/testing/random_scene.h"

#include <algorithm>
#include <cmath>

namespace robosim {

using mrpt::math::TPoint2D;

namespace {

double randomSize(Rng& rng, const SolidSpread& spread) {
  const double size = std::exp(rng.uniform(std::log(spread.size_min_m), std::log(spread.size_max_m)));
  if (spread.lattice_m <= 0) return size;
  return std::max(1.0, std::round(size / spread.lattice_m)) * spread.lattice_m;
}

/// A centre for which the centre minus half of `size` lies on the lattice.
double centerOnLattice(double center, double size, double lattice_m) {
  return std::round((center - size / 2) / lattice_m) * lattice_m + size / 2;
}

HeightSpan randomHeights(Rng& rng, const SolidSpread& spread) {
  double a = rng.uniform(spread.z_min_m, spread.z_max_m), b = rng.uniform(spread.z_min_m, spread.z_max_m);
  if (spread.lattice_m > 0) {
    a = std::round(a / spread.lattice_m) * spread.lattice_m;
    b = std::round(b / spread.lattice_m) * spread.lattice_m;
    if (a == b) b += spread.lattice_m;
  }
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Outline rectangle(const Bounds2D& b) {
  return OrientedBox{
      {(b.x_min + b.x_max) / 2, (b.y_min + b.y_max) / 2}, {1, 0}, (b.x_max - b.x_min) / 2, (b.y_max - b.y_min) / 2};
}

TPoint2D randomPoint(Rng& rng, const Bounds2D& area) {
  const double x = rng.uniform(area.x_min, area.x_max);
  return {x, rng.uniform(area.y_min, area.y_max)};
}

Circle randomCircle(Rng& rng, const SolidSpread& spread) {
  const double diameter = randomSize(rng, spread);
  TPoint2D center = randomPoint(rng, spread.area);
  if (spread.lattice_m > 0) {
    center = {centerOnLattice(center.x, diameter, spread.lattice_m),
              centerOnLattice(center.y, diameter, spread.lattice_m)};
  }
  return {center, diameter / 2};
}

OrientedBox randomBox(Rng& rng, const SolidSpread& spread) {
  const double length = randomSize(rng, spread), width = randomSize(rng, spread);
  TPoint2D center = randomPoint(rng, spread.area);
  if (spread.lattice_m <= 0) {
    return OrientedBox::from({center.x, center.y, rng.uniform(-M_PI, M_PI)}, length, width);
  }
  const std::uint32_t quarter_turns = rng.below(4);
  const bool along_x = quarter_turns % 2 == 0;
  const double forwards = quarter_turns < 2 ? 1 : -1;
  center = {centerOnLattice(center.x, along_x ? length : width, spread.lattice_m),
            centerOnLattice(center.y, along_x ? width : length, spread.lattice_m)};
  return {center, along_x ? TPoint2D(forwards, 0) : TPoint2D(0, forwards), length / 2, width / 2};
}

Outline randomOutline(Rng& rng, const SolidSpread& spread) {
  if (rng.uniform() < spread.circle_share) return randomCircle(rng, spread);
  return randomBox(rng, spread);
}

Solid randomSolid(Rng& rng, const SolidSpread& spread) {
  const Outline outline = randomOutline(rng, spread);
  return {outline, randomHeights(rng, spread)};
}

std::vector<Solid> randomSolids(Rng& rng, std::size_t count, const SolidSpread& spread) {
  std::vector<Solid> solids;
  solids.reserve(count);
  for (std::size_t i = 0; i < count; ++i) solids.push_back(randomSolid(rng, spread));
  return solids;
}

Ray randomPlanarRay(Rng& rng, const Bounds2D& area, double z_min_m, double z_max_m) {
  const TPoint2D from = randomPoint(rng, area);
  const double z = rng.uniform(z_min_m, z_max_m);
  return Ray::towards({from.x, from.y, z}, rng.uniform(-M_PI, M_PI));
}

Ray randomRay(Rng& rng, const Bounds2D& area, double z_min_m, double z_max_m) {
  const TPoint2D from = randomPoint(rng, area);
  const double z = rng.uniform(z_min_m, z_max_m), azimuth = rng.uniform(-M_PI, M_PI);
  return Ray::towards({from.x, from.y, z}, azimuth, std::asin(rng.uniform(-1, 1)));
}

}  // namespace robosim
