#include "sensors/camera.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace robosim {
namespace {

class Camera : public Sensor {
 public:
  explicit Camera(const CameraOptions& options) : view_(options.view) {
    info_.kind = SensorKind::camera;
    info_.label = options.label;
    info_.beams = {{view_.robot_from_camera}};
    info_.camera = view_.info;
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return view_.errors.isRandom(); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    std::vector<std::string> jpegs(robots.size());
    if (now.images && takesPicture(view_.info.rate_hz, now.time)) {
      const auto poses = shownPoses(now.world_from_robot, now.activity);
      if (view_.hasErrors()) {
        CameraView view = view_;
        view.moment = makeMoment(now, robots, slot);
        now.images->take(view, {poses, now.objects}, robots, jpegs);
      } else {
        now.images->take(view_, {poses, now.objects}, robots, jpegs);
      }
    }
    for (std::size_t i = 0; i < robots.size(); ++i) {
      std::get<Image>(readings[robots[i]].measurements[slot]).jpeg = std::move(jpegs[i]);
    }
  }

 private:
  static CameraMoment makeMoment(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot) {
    CameraMoment moment;
    for (const auto robot : robots) {
      Rng rng = now.noise(robot, slot);
      moment.seeds.push_back(static_cast<std::uint64_t>(rng()) << 32 | rng());
      moment.turn_radps.push_back(now.last_motion[robot].turn_rad / now.time.period_s);
    }
    return moment;
  }

  CameraView view_;
  SensorInfo info_;
};

std::uint32_t readSide(XmlReader& reader, const char* setting, std::uint32_t otherwise) {
  const double px = reader.number(setting, {1, kPictureSideMax_px}, otherwise);
  if (px != std::floor(px)) reader.errorAt(setting, "must be a whole number of pixels");
  return static_cast<std::uint32_t>(px);
}

}  // namespace

CameraOptions CameraOptions::read(XmlReader& reader) {
  CameraOptions o;
  CameraView& view = o.view;
  o.label = reader.word("label", o.label);
  view.info.width_px = readSide(reader, "width_px", view.info.width_px);
  view.info.height_px = readSide(reader, "height_px", view.info.height_px);
  view.info.field_of_view_rad = reader.angle("field_of_view_deg", {1, 170}, view.info.field_of_view_rad);
  view.info.rate_hz = reader.number("rate_hz", Bounds::positive(1000), view.info.rate_hz);
  mrpt::math::TPose3D& pose = view.robot_from_camera;
  pose.x = reader.number("x_m", {-100, 100}, 0);
  pose.y = reader.number("y_m", {-100, 100}, 0);
  pose.z = reader.number("z_m", {-100, 100}, 0);
  pose.yaw = reader.angle("angle_deg", {-360, 360}, 0);
  pose.pitch = -reader.angle("tilt_deg", {-90, 90}, 0);  // MRPT's pitch is positive downwards
  view.errors = CameraErrors::read(reader, view.info);
  view.jpeg_quality = static_cast<int>(std::lround(reader.number("jpeg_quality", {1, 100}, view.jpeg_quality)));
  view.is_antialiased = reader.flag("antialias", view.is_antialiased);
  return o;
}

std::unique_ptr<Sensor> makeCamera(const CameraOptions& options) { return std::make_unique<Camera>(options); }

bool takesPicture(double rate_hz, const SimTime& now) { return MeasurementTimes{.rate_hz = rate_hz}.isDue(now); }

}  // namespace robosim
