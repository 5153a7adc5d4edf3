#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "base/portable_math.h"
#include "sensors/camera.h"
#include "sensors/raycast/aimed_cameras.h"
#include "sensors/raycast/camera.h"
#include "sensors/raycast/pixel_rays.h"

namespace robosim {
namespace {

/// Of a robot outside an environment with looks of its bodies.
const FloorLook kPlainFloor{.bounds = {-1e6, 1e6, -1e6, 1e6}, .areas = {}, .pictures = {}};

class RaycastSensor : public MountedOnHead {
 public:
  RaycastSensor(const CameraOptions& options, std::size_t head_slot)
      : head_(options.head),
        head_slot_(head_slot),
        errors_(options.view.errors),
        casting_{.has_rgb = options.view.info.layers.rgb,
                 .has_depth = options.view.info.layers.depth,
                 .has_body = options.view.info.layers.identity,
                 .range_max_m = options.range_max_m},
        camera_(options.view.info, options.view.robot_from_camera, casting_),
        aimed_cameras_(std::size_t{options.view.info.width_px} * options.view.info.height_px) {
    info_.kind = SensorKind::camera;
    info_.label = options.label;
    info_.beams = {{options.view.robot_from_camera}};
    info_.range_max_m = options.range_max_m;
    info_.camera = options.view.info;
    info_.pans = head_.has_value();
  }

  const SensorInfo& info() const override { return info_; }
  std::optional<std::size_t> slotRead() const override { return head_ ? std::optional(head_slot_) : std::nullopt; }
  std::optional<CameraHeadOptions> cameraHead() const override { return head_; }
  bool isNoisy() const override { return errors_.isRandom(); }
  bool usesNeighbours() const override { return false; }
  double robotReach(double) const override {
    // A depth is along the optical axis: the corner of a picture is farther away.
    const PixelRays rays(info_.camera);
    double farthest = 0;
    for (std::uint32_t row = 0; row < info_.camera.height_px; ++row) {
      const bool is_edge = row == 0 || row + 1 == info_.camera.height_px;
      const std::uint32_t step = is_edge ? 1 : std::max(1U, info_.camera.width_px - 1);
      for (std::uint32_t column = 0; column < info_.camera.width_px; column += step) {
        const auto [left, up] = rays.of(column, row);
        farthest = std::max(farthest, 1 + left * left + up * up);
      }
    }
    const auto at = originOf(info_.beams.front());
    return info_.range_max_m * std::sqrt(farthest) + portable::hypot(at.x, at.y);
  }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    const bool is_due = takesPicture(info_.camera.rate_hz, now.time);
    for (const auto robot : robots) {
      auto& measurements = readings[robot].measurements;
      auto& image = std::get<Image>(measurements[slot]);
      if (!is_due) {
        image = {};
        continue;
      }
      std::shared_ptr<RawPicture> raw = reusable(std::move(image.raw));
      if (head_) {
        const auto aim = CameraAim::from(std::get<Values>(measurements[head_slot_]));
        const auto make = [&] {
          const SensorInfo aimed_info = aimed(info_, aim);
          return RaycastCamera(aimed_info.camera, aimed_info.beams.front().robot_from_beam, casting_);
        };
        take(*aimed_cameras_.at(aim, make), now, robot, *raw);
      } else {
        take(camera_, now, robot, *raw);
      }
      if (!raw->rgb.empty()) addErrors(now, robot, slot, raw->rgb);
      image.raw = std::move(raw);
    }
  }

 private:
  /// The picture of the step before if nothing else has it, otherwise another one.
  static std::shared_ptr<RawPicture> reusable(std::shared_ptr<const RawPicture> before) {
    if (before.use_count() == 1) {
      std::atomic_thread_fence(std::memory_order_acquire);  // after all reads of the thread that had it last
      return std::const_pointer_cast<RawPicture>(std::move(before));
    }
    return std::make_shared<RawPicture>();
  }

  void take(const RaycastCamera& camera, const Snapshot& now, std::uint32_t robot, RawPicture& raw) const {
    RaycastPicture picture;
    picture.rgb.swap(raw.rgb);
    picture.depth_m.swap(raw.depth_m);
    picture.body.swap(raw.identity);
    const SeenScene seen{now.scene, now.looks, now.floor ? *now.floor : kPlainFloor};
    camera.take(seen, now.frames[robot], now.bodyOf(robot), picture);
    for (std::uint32_t& body : picture.body) {
      if (body < now.identities.size()) body = now.identities[body];
    }
    raw.width_px = picture.width_px;
    raw.height_px = picture.height_px;
    raw.range_max_m = static_cast<float>(info_.range_max_m);
    raw.rgb.swap(picture.rgb);
    raw.depth_m.swap(picture.depth_m);
    raw.identity.swap(picture.body);
  }

  /// Exposure, then noise, as of pictures of the other model.
  void addErrors(const Snapshot& now, std::uint32_t robot, std::size_t slot, std::vector<std::uint8_t>& rgb) const {
    if (errors_.noise_std == 0 && errors_.exposure == 1 && errors_.exposure_std == 0) return;
    Rng rng = now.noise(robot, slot);
    const double spread = errors_.exposure_std > 0 ? errors_.exposure_std * rng.gaussian() : 0;
    const double exposure = errors_.exposure * std::max(0.0, 1 + spread);
    for (std::uint8_t& level : rgb) {
      const double noise = errors_.noise_std > 0 ? errors_.noise_std * rng.gaussian() : 0;
      const double exposed = std::min(255.0, level * exposure) + noise;
      level = static_cast<std::uint8_t>(std::clamp(exposed, 0.0, 255.0) + 0.5);
    }
  }

  std::optional<CameraHeadOptions> head_;
  std::size_t head_slot_;
  CameraErrors errors_;
  RaycastOptions casting_;
  RaycastCamera camera_;  ///< without a head
  mutable AimedCameras aimed_cameras_;
  SensorInfo info_;
};

}  // namespace

std::unique_ptr<Sensor> makeRaycastCamera(const CameraOptions& options, std::size_t head_slot) {
  return std::make_unique<RaycastSensor>(options, head_slot);
}

}  // namespace robosim
