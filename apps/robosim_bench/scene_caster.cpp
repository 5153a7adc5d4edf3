#include <algorithm>
#include <vector>

#include "geometry/scene.h"
#include "robosim_bench/ray_caster.h"

namespace robosim {
namespace {

class SceneCaster : public RayCaster {
 public:
  explicit SceneCaster(const RayScene& rays)
      : scene_(rays.solids, 0, {-RayScene::kHalf_m, RayScene::kHalf_m, -RayScene::kHalf_m, RayScene::kHalf_m}),
        world_from_scanner_(rays.world_from_scanner),
        fan_(beams()),
        singles_(rays.singles),
        distance_m_(rays.singles.size()) {}

  std::string name() const override { return "RoboSim"; }

  void castScans(double range_m) override {
    for (std::size_t scan = 0; scan < world_from_scanner_.size(); ++scan) {
      const auto& at = world_from_scanner_[scan];
      const std::size_t first = scan * RayScene::kBeams;
      batch_.place(fan_, PlanarTransform(at, RayScene::kHeight_m), range_m);
      scene_.cast(batch_);
      for (std::size_t i = 0; i < RayScene::kBeams; ++i) distance_m_[first + i] = batch_.distance(i);
    }
  }

  void castSingles(double range_m) override {
    for (std::size_t i = 0; i < singles_.size(); ++i) {
      distance_m_[i] = std::min(scene_.castRay(singles_[i], range_m).distance_m, range_m);
    }
  }

  double distance(std::size_t i) const override { return distance_m_[i]; }

 private:
  /// In the scanner's frame.
  static std::vector<Ray> beams() {
    std::vector<Ray> beams;
    for (std::size_t i = 0; i < RayScene::kBeams; ++i) beams.push_back(Ray::towards({0, 0, 0}, beamAngle(i)));
    return beams;
  }

  Scene scene_;
  BeamBatch batch_;
  std::vector<mrpt::math::TPose2D> world_from_scanner_;
  BeamFan fan_;
  std::vector<Ray> singles_;
  std::vector<double> distance_m_;
};

}  // namespace

std::unique_ptr<RayCaster> makeSceneCaster(const RayScene& rays) { return std::make_unique<SceneCaster>(rays); }

}  // namespace robosim
