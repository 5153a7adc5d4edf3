#include "sensors/camera.h"

#include <cmath>
#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace robosim {
namespace {

class Camera : public MountedOnHead {
 public:
  Camera(const CameraOptions& options, std::size_t head_slot)
      : head(options.head), head_slot_(head_slot), view_(options.view) {
    info_.kind = SensorKind::camera;
    info_.label = options.label;
    info_.beams = {{view_.robot_from_camera}};
    info_.camera = view_.info;
    info_.pans = head.has_value();
  }

  const SensorInfo& info() const override { return info_; }
  std::optional<std::size_t> slotRead() const override { return head ? std::optional(head_slot_) : std::nullopt; }
  std::optional<CameraHeadOptions> cameraHead() const override { return head; }
  bool isNoisy() const override { return view_.errors.isRandom(); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    std::vector<std::string> jpegs(robots.size());
    if (now.images && takesPicture(view_.info.rate_hz, now.time)) {
      const auto poses = shownPoses(now.world_from_robot, now.activity);
      if (view_.hasErrors() || head) {
        CameraView view = view_;
        if (view_.hasErrors()) view.moment = makeMoment(now, robots, slot);
        if (head) view.aims = aimsOf(robots, readings);
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
  std::vector<CameraAim> aimsOf(std::span<const std::uint32_t> robots, std::span<const Readings> readings) const {
    std::vector<CameraAim> aims;
    for (const auto robot : robots) {
      aims.push_back(CameraAim::from(std::get<Values>(readings[robot].measurements[head_slot_])));
    }
    return aims;
  }
  static CameraMoment makeMoment(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot) {
    CameraMoment moment;
    for (const auto robot : robots) {
      Rng rng = now.noise(robot, slot);
      moment.seeds.push_back(static_cast<std::uint64_t>(rng()) << 32 | rng());
      moment.turn_radps.push_back(now.last_motion[robot].turn_rad / now.time.period_s);
    }
    return moment;
  }

  const std::optional<CameraHeadOptions> head;
  std::size_t head_slot_;
  CameraView view_;
  SensorInfo info_;
};

enum class CameraModel : std::uint8_t { opengl, raycast };

/// Reads the options of the model `raycast`, and refuses those of the other one.
void readModel(XmlReader& reader, CameraOptions& o) {
  const auto model =
      reader.choice("model", {{"opengl", CameraModel::opengl}, {"raycast", CameraModel::raycast}}, CameraModel::opengl);
  const auto only = [&](std::initializer_list<const char*> settings, const char* of) {
    for (const char* setting : settings) {
      if (reader.has(setting)) {
        reader.errorAt(setting, std::string("is only of model=\"") + of + "\"; drop it, or change the model");
      }
    }
  };
  const std::string layers = reader.attribute("layers", "rgb, depth, identity");
  o.range_max_m = reader.number("range_max_m", Bounds::positive(1000), o.range_max_m);
  if (model == CameraModel::opengl) return only({"layers", "range_max_m"}, "raycast");
  only({"jpeg_quality", "antialias"}, "opengl");
  CameraInfo& info = o.view.info;
  PictureLayers& seen = info.layers;
  std::istringstream words(layers.empty() ? "rgb" : layers);
  for (std::string word; words >> word;) {
    bool* const layer = word == "rgb" ? &seen.rgb : word == "depth" ? &seen.depth : &seen.identity;
    if (*layer || (layer == &seen.identity && word != "identity")) {
      return reader.errorAt("layers",
                            "must be some of the words rgb, depth and identity, each once; drop it for the "
                            "default, rgb");
    }
    *layer = true;
  }
  if (!seen.any()) reader.errorAt("layers", "is empty; name some of rgb, depth and identity");
  if (std::size_t{info.width_px} * info.height_px > kRawPixelsMax) {
    reader.error("has " + std::to_string(std::size_t{info.width_px} * info.height_px) +
                 " pixels; a ray-cast picture may have " + std::to_string(kRawPixelsMax) + ", so make it smaller");
  }
  const CameraErrors& errors = o.view.errors;
  if (errors.rolling_shutter_s > 0) {
    reader.error(
        "has a rolling_shutter_s in its <noise>, which is only of model=\"opengl\"; drop it, or change the model");
  }
  if (!seen.rgb && (errors.noise_std > 0 || errors.exposure != 1 || errors.exposure_std > 0)) {
    reader.error("has errors of colours in its <noise>, but no layer rgb; add it to layers, or drop them");
  }
}

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
  o.head = CameraHeadOptions::read(reader);
  readModel(reader, o);
  return o;
}

std::unique_ptr<Sensor> makeCamera(const CameraOptions& options, std::size_t head_slot) {
  if (options.view.info.isRaycast()) return makeRaycastCamera(options, head_slot);
  return std::make_unique<Camera>(options, head_slot);
}

std::unique_ptr<Sensor> makeHeadOf(const Sensor& sensor) {
  const auto* const camera = dynamic_cast<const MountedOnHead*>(&sensor);
  const auto head = camera ? camera->cameraHead() : std::nullopt;
  return head ? makeCameraHead(*head) : nullptr;
}

bool takesPicture(double rate_hz, const SimTime& now) { return MeasurementTimes{.rate_hz = rate_hz}.isDue(now); }

}  // namespace robosim
