#include "geometry/ray_stream.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "geometry/vector_clones.h"

namespace robosim {

void RayStream::cast(std::span<const Ray> rays, const GridIndex& index, double range_m, std::uint32_t except) {
  assert(rays.size() <= kMost);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    walks_.x[i] = rays[i].origin.x;
    walks_.y[i] = rays[i].origin.y;
    walks_.dx[i] = rays[i].direction.x;
    walks_.dy[i] = rays[i].direction.y;
    z_m_[i] = rays[i].origin.z;
  }
  walks_.going_count = rays.size();
  std::fill_n(walks_.reach_m.of, kMost, range_m);
  body_.fill(kNothing);
  if (index.items().empty()) return;
  rough_.set(walks_, index.middle());
  for (index.start(walks_); walks_.going_count > 0; index.goOn(walks_)) {
    rough_.findPassed(walks_, index.packs().data(), passed_);
    meetPassed(index, except);
  }
}

ROBOSIM_VECTOR_CLONES
void RayStream::listPassed() {
  // How many solids a ray passes is anybody's guess; that eight rays pass more than four together is seldom.
  constexpr std::uint32_t kOften = 4;
  const auto count = static_cast<std::uint32_t>(walks_.going_count);
  listed_count_ = 0;
  for (std::uint32_t first = 0; first < count; first += RayWalks::kTogether) {
    std::uint64_t marks = passed_[first / RayWalks::kTogether];
    const auto mark_count = static_cast<std::uint32_t>(std::popcount(marks));
    for (std::uint32_t listed = 0; listed < mark_count; listed += kOften) {
      for (std::uint32_t k = 0; k < kOften; ++k) {
        listed_[listed_count_ + listed + k] = 8 * first + static_cast<std::uint32_t>(std::countr_zero(marks));
        marks &= marks - 1;
      }
    }
    listed_count_ += mark_count;
  }
}

void RayStream::meetPassed(const GridIndex& index, std::uint32_t except) {
  listPassed();
  const GridItem* items = index.items().data();
  const GridIndex::Pack* packs = index.packs().data();
  for (std::size_t k = 0; k < listed_count_; ++k) {
    const std::uint32_t i = walks_.going[listed_[k] / 8];
    const GridItem& item = items[packs[walks_.pack[i]].index[listed_[k] % 8]];
    if (!item.heights.contains(z_m_[i]) || item.number == except) continue;
    pairs_.add(item, item.number, i, item.x - walks_.x[i], item.y - walks_.y[i], walks_.dx[i], walks_.dy[i]);
    if (pairs_.isFull()) settle();
  }
  settle();
}

void RayStream::settle() {
  pairs_.settle([&](std::uint32_t i, double distance_m, std::int64_t body) {
    const double before_m = walks_.reach_m[i];
    const std::int64_t body_before = body_[i];
    // Anybody's guess, too, so without a branch.
    const bool keeps = (distance_m < before_m) | ((distance_m == before_m) & (body < body_before));
    walks_.reach_m[i] = keeps ? distance_m : before_m;
    body_[i] = keeps ? body : body_before;
  });
}

}  // namespace robosim
