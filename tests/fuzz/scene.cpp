// Fuzzes rays and sectors in a scene of random solids, compared with a loop over all solids. Each solid, ray and sector
// consumes some bytes of the input while there are any; coordinates are on a lattice, at most a micrometre off it, or
// anywhere within 128 m.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "geometry/testing/slow_scene.h"
#include "tests/fuzz/fuzz.h"

using namespace robosim;
using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

namespace {

/// The input, number by number; zeros after its end. (libFuzzer's FuzzedDataProvider is not available with g++.)
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool hasMore() const { return at_ < size_; }
  unsigned byte() { return hasMore() ? data_[at_++] : 0; }
  /// In [0, below).
  unsigned choice(unsigned below) { return byte() % below; }
  /// In [-1, 1).
  double share() {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
    return static_cast<double>(static_cast<std::int32_t>(bits)) * 0x1p-31;
  }
  double coordinate() {
    const unsigned kind = choice(4);
    if (kind == 0) return 128 * share();
    const double on_lattice = 0.5 * (static_cast<double>(byte()) - 128);
    return kind == 1 ? on_lattice + std::exp2(-20.0 - choice(24)) * share() : on_lattice;
  }
  double size() {
    const unsigned kind = choice(3);
    if (kind == 0) return std::exp2(10 * share() - 4);  // from a millimetre to a hundred metres
    return 0.25 * (1 + choice(kind == 1 ? 4 : 200));
  }
  TPoint2D unit() {
    const unsigned kind = choice(3);
    if (kind == 0) {
      const double angle = M_PI * share();
      return {std::cos(angle), std::sin(angle)};
    }
    if (kind == 1) {
      const TPoint2D axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      return axes[choice(4)];
    }
    const double x = choice(17) - 8.0, y = choice(17) - 8.0;
    return x == 0 && y == 0 ? TPoint2D(1, 0) : TPoint2D(x, y) * (1 / std::hypot(x, y));
  }
  TPoint3D place() {
    const double x = coordinate(), y = coordinate();
    return {x, y, 0.25 * choice(10)};
  }
  Solid solid() {
    const TPoint2D center{coordinate(), coordinate()};
    const double underside = 0.5 * choice(4), height = 0.5 * (1 + choice(4));
    Solid solid{Circle{center, 0}, {underside, underside + height}};
    if (choice(2)) {
      std::get<Circle>(solid.outline).radius_m = size();
    } else {
      OrientedBox box{center, unit(), 0, 0};
      box.half_length_m = size();
      box.half_width_m = size();
      solid.outline = box;
    }
    return solid;
  }
  Bounds2D area() {
    const double x = coordinate(), y = coordinate();
    return {x, x + size(), y, y + size()};
  }
  double range() {
    const double ranges[] = {std::numeric_limits<double>::infinity(), 0.3, 8, 20, 1e9};
    return ranges[choice(5)];
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

void demand(const char* question, const std::string& difference) {
  if (difference.empty()) return;
  std::cerr << question << ": " << difference << std::endl;
  std::abort();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Bounds2D area = bytes.area();
  std::vector<Solid> stationary(bytes.choice(80));
  for (auto& solid : stationary) solid = bytes.solid();
  Scene scene(stationary, bytes.choice(20), area);
  for (std::size_t i = 0; i < scene.movingCount(); ++i) scene.place(i, bytes.solid());
  scene.freeze();
  for (int questions = 0; questions < 200 && bytes.hasMore(); ++questions) {
    const TPoint3D from = bytes.place();
    const TPoint2D towards = bytes.unit();
    const double range_m = bytes.range();
    const unsigned asker = bytes.byte();
    const BodyId except = asker < bodyCount(scene) ? body(asker) : kNoBody;
    if (bytes.choice(4) == 0) {
      const Sector sector = Sector::towards(from, std::atan2(towards.y, towards.x), 0.01 + 0.5 * (1 + bytes.share()));
      demand("sector", whatDiffers(scene, sector, range_m, except));
      continue;
    }
    const double rise = bytes.choice(4) == 0 ? bytes.share() : 0;
    const double level = std::sqrt(1 - rise * rise);
    const Ray ray{from, {towards.x * level, towards.y * level, rise}};
    demand("castRay", whatDiffers(scene.castRay(ray, range_m, except), castRaySlowly(scene, ray, range_m, except)));
  }
  return 0;
}
