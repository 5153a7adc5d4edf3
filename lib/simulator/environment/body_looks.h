#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "environment/known_robots.h"
#include "environment/model.h"
#include "environment/state.h"
#include "geometry/scene.h"
#include "sensors/raycast/picture.h"

namespace robosim {

/// What ray-cast cameras see of the bodies of a Scene besides their shapes. Colours are those of all other pictures:
/// of objects and maps as in the world file, of robots by setRobotColors(). Hot objects and those with a light glow, as
/// a robot does in the colour of its LEDs while they are on.
class BodyLooks {
 public:
  /// Whether any robot has a ray-cast camera; without one nothing is kept.
  static bool areSeen(const Model& model);

  BodyLooks() = default;
  /// @param body_of_object by object @param floor_pictures of the world; must outlive this
  BodyLooks(const Model& model, const std::vector<WorldObject>& objects, const Scene& scene,
            const std::vector<BodyId>& body_of_object, std::span<const FloorPicture> floor_pictures);

  bool isEmpty() const { return looks_.empty(); }
  /// Sets the LEDs of the known robots.
  void setLeds(const State& state, const KnownRobots& known, const ParallelExecutor& workers);

  std::span<const SurfaceLook> looks() const { return looks_; }              ///< by body
  std::span<const std::uint32_t> identities() const { return identities_; }  ///< by body: RawPicture::identity
  const FloorLook& floor() const { return floor_; }

 private:
  std::vector<SurfaceLook> looks_, robots_;  ///< by body; of robots without LEDs
  std::vector<std::uint32_t> identities_;
  FloorLook floor_;
  std::size_t first_robot_ = 0;  ///< its body
};

}  // namespace robosim
