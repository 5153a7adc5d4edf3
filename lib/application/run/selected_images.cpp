#include "run/selected_images.h"

#include <map>
#include <utility>

#include "environment/step_phases.h"
#include "sensors/sensor.h"

namespace robosim {
namespace {

bool isOfPictures(const Sensor& sensor) {
  return sensor.info().kind == SensorKind::camera || sensor.info().kind == SensorKind::blob_finder;
}

/// The cameras and blob finders of a robot model as one sensor, which measures in their slots.
class Cameras final : public Sensor {
 public:
  explicit Cameras(const RobotModel& model) : model_(model) {}

  const SensorInfo& info() const override { return info_; }
  bool usesNeighbours() const override { return false; }
  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t,
             std::span<Readings> readings) const override {
    for (std::size_t slot = 0; slot < model_.sensors.size(); ++slot) {
      if (isOfPictures(*model_.sensors[slot])) model_.sensors[slot]->sense(now, robots, slot, readings);
    }
  }

 private:
  const RobotModel& model_;
  SensorInfo info_{.kind = SensorKind::values, .label = "cameras", .beams = {}};
};

}  // namespace

void SelectedImages::take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
                          std::span<std::string> jpegs) {
  std::vector<std::uint32_t> chosen;
  std::vector<std::size_t> places;  // in `robots`
  for (std::size_t i = 0; i < robots.size(); ++i) {
    jpegs[i].clear();
    if (robots[i] >= selected.size() || !selected[robots[i]]) continue;
    chosen.push_back(robots[i]);
    places.push_back(i);
  }
  if (chosen.empty()) return;
  std::vector<std::string> taken(chosen.size());
  if (camera.moment.seeds.empty() && camera.moment.turn_radps.empty()) {
    source_->take(camera, seen, chosen, taken);
  } else {
    CameraView view = camera;
    view.moment = {};
    for (const std::size_t place : places) {
      view.moment.seeds.push_back(camera.moment.seeds[place]);
      view.moment.turn_radps.push_back(camera.moment.turn_radps[place]);
    }
    source_->take(view, seen, chosen, taken);
  }
  for (std::size_t i = 0; i < places.size(); ++i) jpegs[places[i]] = std::move(taken[i]);
}

void measureWithCameras(Environment& environment, const std::vector<std::uint32_t>& robots) {
  std::map<const RobotModel*, std::vector<std::uint32_t>> of_model;
  for (const std::uint32_t robot : robots) {
    if (!environment.state().isAbsent(robot)) of_model[environment.fleet().robots[robot].model.get()].push_back(robot);
  }
  for (const auto& [model, some] : of_model) {
    // Pictures and what is found in them are no part of the digest (doc/decisions/pictures.md).
    environment.measure(Cameras(*model), some, environment.phases().results().readings);
  }
}

}  // namespace robosim
