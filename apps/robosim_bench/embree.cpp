// Embree 3 as a peer for ray casting: the module robosim_embree.so, the only part that links Embree. Uses the fastest
// configuration recommended by Embree's manual: single precision, scans in packets of 16 under a coherent context,
// boxes and circles in plan as user geometry with one vectorised callback per shape, denormal numbers flushed to zero.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <embree3/rtcore.h>

#include "base/vector_width.h"
#include "robosim_bench/ray_caster.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace robosim {
namespace {

constexpr float kMiss = std::numeric_limits<float>::infinity();

struct FloatCircle {
  float x, y, radius;

  float reachX() const { return radius; }
  float reachY() const { return radius; }
  /// Distance at which a ray from (ox, oy) along (dx, dy) enters, negative behind the origin; kMiss for none.
  [[gnu::always_inline]] float enter(float ox, float oy, float dx, float dy) const {
    const float along = dx * (x - ox) + dy * (y - oy);
    const float across = dx * (y - oy) - dy * (x - ox);
    const float left = radius * radius - across * across;
    return left >= 0 ? along - std::sqrt(left) : kMiss;
  }
};

struct FloatBox {
  float x, y, ux, uy, half_length, half_width;

  float reachX() const { return std::abs(half_length * ux) + std::abs(half_width * uy); }
  float reachY() const { return std::abs(half_length * uy) + std::abs(half_width * ux); }
  [[gnu::always_inline]] float enter(float ox, float oy, float dx, float dy) const {
    const float a = (ox - x) * ux + (oy - y) * uy;
    const float b = (oy - y) * ux - (ox - x) * uy;
    const float per_a = 1 / (dx * ux + dy * uy);
    const float per_b = 1 / (dy * ux - dx * uy);
    const float middle_a = -a * per_a;
    const float middle_b = -b * per_b;
    const float half_a = half_length * std::abs(per_a);
    const float half_b = half_width * std::abs(per_b);
    const float from_a = middle_a - half_a;
    const float from_b = middle_b - half_b;
    const float to_a = middle_a + half_a;
    const float to_b = middle_b + half_b;
    const float from = from_a > from_b ? from_a : from_b;
    const float to = to_a < to_b ? to_a : to_b;
    return from <= to ? from : kMiss;
  }
};

/// Without branches, so that the compiler vectorises the loop.
template <typename Shape, typename Packet>
[[gnu::always_inline]] inline void meetLanes(const Shape* shape, const RTCIntersectFunctionNArguments* arguments) {
  const RTCIntersectFunctionNArguments& a = *arguments;
  auto& packet = *reinterpret_cast<Packet*>(a.rayhit);
  constexpr std::size_t kLanes = sizeof(packet.ray.tfar) / sizeof(float);
  const Shape s = *shape;
  const unsigned geometry = a.geomID;
  const unsigned primitive = a.primID;
  std::array<int, kLanes> valid;
  std::copy_n(a.valid, kLanes, valid.begin());
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float t = s.enter(packet.ray.org_x[i], packet.ray.org_y[i], packet.ray.dir_x[i], packet.ray.dir_y[i]);
    const bool met = (valid[i] != 0) & (t > packet.ray.tnear[i]) & (t < packet.ray.tfar[i]);
    packet.ray.tfar[i] = met ? t : packet.ray.tfar[i];
    packet.hit.geomID[i] = met ? geometry : packet.hit.geomID[i];
    packet.hit.primID[i] = met ? primitive : packet.hit.primID[i];
  }
}

template <typename Shape>
void meetOne(const Shape& shape, const RTCIntersectFunctionNArguments& a) {
  auto& one = *reinterpret_cast<RTCRayHit*>(a.rayhit);
  const float t = shape.enter(one.ray.org_x, one.ray.org_y, one.ray.dir_x, one.ray.dir_y);
  if (!(t > one.ray.tnear && t < one.ray.tfar)) return;
  one.ray.tfar = t;
  one.hit.geomID = a.geomID;
  one.hit.primID = a.primID;
}

using EmbreeArguments = RTCIntersectFunctionNArguments;
template <typename Shape>
void meet16(const Shape& s, const EmbreeArguments& a) {
  withVectors<meetLanes<Shape, RTCRayHit16>>(&s, &a);
}
template <typename Shape>
void meet8(const Shape& s, const EmbreeArguments& a) {
  withVectors<meetLanes<Shape, RTCRayHit8>>(&s, &a);
}
template <typename Shape>
void meet4(const Shape& s, const EmbreeArguments& a) {
  meetLanes<Shape, RTCRayHit4>(&s, &a);
}

template <typename Shape>
void intersect(const RTCIntersectFunctionNArguments* a) {
  const Shape& shape = static_cast<const Shape*>(a->geometryUserPtr)[a->primID];
  switch (a->N) {
    case 1:
      if (a->valid[0]) meetOne(shape, *a);
      return;
    case 4:
      return meet4(shape, *a);
    case 8:
      return meet8(shape, *a);
    default:
      return meet16(shape, *a);
  }
}

template <typename Shape>
void bound(const RTCBoundsFunctionArguments* a) {
  const Shape& shape = static_cast<const Shape*>(a->geometryUserPtr)[a->primID];
  *a->bounds_o = {shape.x - shape.reachX(), shape.y - shape.reachY(), 0, 0,
                  shape.x + shape.reachX(), shape.y + shape.reachY(), 1, 0};
}

/// Flushes denormal numbers to zero during its lifetime, as Embree's manual advises.
class FlushDenormals {
 public:
#ifdef __SSE2__
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#endif
};

class EmbreeCaster : public RayCaster {
 public:
  explicit EmbreeCaster(const RayScene& rays) : device_(rtcNewDevice("threads=1")) {
    if (!device_) throw std::runtime_error("Embree could not be initialised");
    for (const auto& solid : rays.solids) addShape(solid.outline);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    addGeometry(circles_);
    addGeometry(boxes_);
    rtcCommitScene(scene_);
    takeRays(rays);
  }
  ~EmbreeCaster() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeCaster(const EmbreeCaster&) = delete;
  EmbreeCaster& operator=(const EmbreeCaster&) = delete;

  std::string name() const override { return "Embree " RTC_VERSION_STRING; }

  void castScans(double range_m) override {
    const FlushDenormals flush;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit16 packet{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      packet.ray.org_z[i] = static_cast<float>(RayScene::kHeight_m);
      packet.ray.mask[i] = ~0u;
    }
    for (std::size_t scan = 0; scan < scan_x_.size(); ++scan) {
      std::fill_n(packet.ray.org_x, kLanes, scan_x_[scan]);
      std::fill_n(packet.ray.org_y, kLanes, scan_y_[scan]);
      for (std::size_t beam = 0; beam < RayScene::kBeams; beam += kLanes) {
        const std::size_t lanes = std::min(kLanes, RayScene::kBeams - beam);
        const std::size_t first = scan * kPaddedBeams + beam;
        std::copy_n(&beam_dx_[first], kLanes, packet.ray.dir_x);
        std::copy_n(&beam_dy_[first], kLanes, packet.ray.dir_y);
        std::fill_n(packet.ray.tfar, kLanes, static_cast<float>(range_m));
        std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(lanes == kLanes ? all_.data() : last_.data(), scene_, &context, &packet);
        std::copy_n(packet.ray.tfar, lanes, &distance_m_[scan * RayScene::kBeams + beam]);
      }
    }
  }

  /// The fastest variant: passed as an array (rtcIntersect1M), single rays take nearly twice as long.
  void castSingles(double range_m) override {
    const FlushDenormals flush;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit one{};
    one.ray.org_z = static_cast<float>(RayScene::kHeight_m);
    one.ray.mask = ~0u;
    for (std::size_t i = 0; i < singles_.size(); ++i) {
      one.ray.org_x = singles_[i].x;
      one.ray.org_y = singles_[i].y;
      one.ray.dir_x = singles_[i].dx;
      one.ray.dir_y = singles_[i].dy;
      one.ray.tfar = static_cast<float>(range_m);
      one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &one);
      distance_m_[i] = one.ray.tfar;
    }
  }

  double distance(std::size_t i) const override { return static_cast<double>(distance_m_[i]); }

 private:
  static constexpr std::size_t kLanes = 16;
  static constexpr std::size_t kPaddedBeams = (RayScene::kBeams + kLanes - 1) / kLanes * kLanes;
  struct Single {
    float x, y, dx, dy;
  };

  void addShape(const Outline& outline) {
    const auto f = [](double value) { return static_cast<float>(value); };
    if (const auto* circle = std::get_if<Circle>(&outline)) {
      circles_.push_back({f(circle->center.x), f(circle->center.y), f(circle->radius_m)});
    } else {
      const auto& box = std::get<OrientedBox>(outline);
      boxes_.push_back(
          {f(box.center.x), f(box.center.y), f(box.axis.x), f(box.axis.y), f(box.half_length_m), f(box.half_width_m)});
    }
  }

  template <typename Shape>
  void addGeometry(std::vector<Shape>& shapes) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(shapes.size()));
    rtcSetGeometryUserData(geometry, shapes.data());
    rtcSetGeometryBoundsFunction(geometry, bound<Shape>, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect<Shape>);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  void takeRays(const RayScene& rays) {
    for (const auto& scanner : rays.world_from_scanner) {
      scan_x_.push_back(static_cast<float>(scanner.x));
      scan_y_.push_back(static_cast<float>(scanner.y));
    }
    for (std::size_t scan = 0; scan < scan_x_.size(); ++scan) {
      for (std::size_t i = 0; i < kPaddedBeams; ++i) {
        const auto& direction = rays.beams[scan * RayScene::kBeams + std::min(i, RayScene::kBeams - 1)].direction;
        beam_dx_.push_back(static_cast<float>(direction.x));
        beam_dy_.push_back(static_cast<float>(direction.y));
      }
    }
    for (const auto& ray : rays.singles) {
      singles_.push_back({static_cast<float>(ray.origin.x), static_cast<float>(ray.origin.y),
                          static_cast<float>(ray.direction.x), static_cast<float>(ray.direction.y)});
    }
    all_.fill(-1);
    last_.fill(0);
    std::fill_n(last_.begin(), RayScene::kBeams % kLanes, -1);
    distance_m_.resize(rays.singles.size());
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
  std::vector<FloatCircle> circles_;
  std::vector<FloatBox> boxes_;
  std::vector<float> scan_x_, scan_y_;
  std::vector<float> beam_dx_, beam_dy_;  ///< padded with the scan's last beam to a multiple of the packet size
  std::vector<Single> singles_;
  alignas(64) std::array<int, kLanes> all_{}, last_{};  ///< active rays of a packet: -1
  std::vector<float> distance_m_;
};

}  // namespace
}  // namespace robosim

extern "C" __attribute__((visibility("default"))) robosim::RayCaster* makeRobosimEmbreeCaster(
    const robosim::RayScene& rays) {
  return new robosim::EmbreeCaster(rays);
}
