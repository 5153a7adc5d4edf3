#include "sensors/planar_beams.h"

#include "sensors/beam_mounts.h"

namespace robosim {

PlanarBeams::PlanarBeams(const std::vector<Beam>& beams) {
  for (const auto& beam : beams) beams_.push_back({originOf(beam), directionOf(beam)});
  for (const auto& [z_m, indices] : beamsByHeight(beams)) {
    std::vector<Ray> rays;
    for (const auto i : indices) rays.push_back(beams_[i]);
    groups_.push_back({indices, BeamFan(rays)});
  }
}

}  // namespace robosim
