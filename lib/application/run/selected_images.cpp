#include "run/selected_images.h"

#include <map>
#include <utility>

#include "environment/step_phases.h"
#include "sensors/sensor.h"

namespace robosim {
namespace {

/// Of an ImageSource; ray-cast pictures are taken in the step.
bool isOfPictures(const Sensor& sensor) {
  const SensorInfo& info = sensor.info();
  return (info.kind == SensorKind::camera || info.kind == SensorKind::blob_finder) && !info.camera.isRaycast();
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

template <typename Element>
std::vector<Element> elementsAt(const std::vector<std::size_t>& places, const std::vector<Element>& all) {
  std::vector<Element> some;
  if (all.empty()) return some;
  for (const std::size_t place : places) some.push_back(all[place]);
  return some;
}

/// The view for the pictures at these places of a call of take().
CameraView viewOf(const CameraView& camera, const std::vector<std::size_t>& places) {
  CameraView view = camera;
  view.moment = {elementsAt(places, camera.moment.seeds), elementsAt(places, camera.moment.turn_radps)};
  view.aims = elementsAt(places, camera.aims);
  return view;
}

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
  const bool is_same_for_all = camera.moment.seeds.empty() && camera.moment.turn_radps.empty() && camera.aims.empty();
  source_->take(is_same_for_all ? camera : viewOf(camera, places), seen, chosen, taken);
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
