#include "sensors/swept_rays.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "base/vector_width.h"
#include "sensors/swept_pose.h"

namespace robosim {
namespace {

constexpr std::size_t kLanes = 4;

/// @param first poses of the first ray in each revolution
/// @param beams SweptRays::fields_
template <bool kIsAside, std::size_t kRevolutions>
[[gnu::always_inline]] inline void sweep(const std::array<SweptPoseOf<kIsAside>, kRevolutions>* first,
                                         std::size_t count, const double* beams, const PlanarTransform* pan, double z_m,
                                         Ray* to) {
  auto poses = *first;
  for (std::size_t i = 0; i < count; i += kLanes, beams += 4 * kLanes) {
    using Pose = SweptPoseOf<kIsAside>;
    const auto age_of = [&](std::size_t lane) {
      const typename Pose::template Age<double> age = poses[lane % kRevolutions].age();
      for (auto& pose : poses) pose.next();
      return age;
    };
    const auto a = age_of(0), b = age_of(1), c = age_of(2), d = age_of(3);
    const typename Pose::template Age<DoubleQuad> ages{
        DoubleQuad{a.share, b.share, c.share, d.share},
        DoubleQuad{a.half_cos, b.half_cos, c.half_cos, d.half_cos},
        DoubleQuad{a.half_sin, b.half_sin, c.half_sin, d.half_sin},
    };
    RayQuad rays;
    loadFour(beams, rays.x);
    loadFour(beams + kLanes, rays.y);
    DoubleQuad ahead, aside;
    loadFour(beams + 2 * kLanes, ahead);
    loadFour(beams + 3 * kLanes, aside);
    rays.direction_x = pan->cos() * ahead - pan->sin() * aside;
    rays.direction_y = pan->sin() * ahead + pan->cos() * aside;
    poses[0].toWorld(ages, rays);
#pragma GCC unroll 4
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      to[i + lane] = {{rays.x[lane], rays.y[lane], z_m}, {rays.direction_x[lane], rays.direction_y[lane], 0}};
    }
  }
}

}  // namespace

SweptRays::SweptRays(std::span<const Ray> beams) : count_(beams.size()) {
  for (std::size_t i = 0; i < count_; i += kLanes) {
    for (const auto& field : {&Ray::origin, &Ray::direction}) {
      for (const auto coordinate : {&mrpt::math::TPoint3D::x, &mrpt::math::TPoint3D::y}) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          fields_.push_back(beams[std::min(i + lane, count_ - 1)].*field.*coordinate);
        }
      }
    }
  }
  if (count_ > 0) z_m_ = beams[0].origin.z;
}

void SweptRays::place(const PlanarTransform& now, const Motion& last_motion, double pan_rad,
                      std::span<const double> first_shares, double step_share, std::vector<Ray>& to) const {
  assert(first_shares.size() == 1 || first_shares.size() == 2);
  const std::size_t padded = (count_ + kLanes - 1) / kLanes * kLanes;
  if (to.size() < padded) to.resize(padded);
  const PlanarTransform pan(PlanarTransform(), pan_rad);
  const auto sweep_from = [&]<bool kIsAside>(const auto&... shares) {
    const std::array first{SweptPoseOf<kIsAside>(now, last_motion, shares, step_share)...};
    withVectors<sweep<kIsAside, sizeof...(shares)>>(&first, padded, fields_.data(), &pan, now.z() + z_m_, to.data());
  };
  const auto place_by = [&]<bool kIsAside>() {
    if (first_shares.size() == 1) {
      sweep_from.template operator()<kIsAside>(first_shares[0]);
    } else {
      sweep_from.template operator()<kIsAside>(first_shares[0], first_shares[1]);
    }
  };
  if (last_motion.lateral_m == 0) {
    place_by.template operator()<false>();
  } else {
    place_by.template operator()<true>();
  }
}

}  // namespace robosim
