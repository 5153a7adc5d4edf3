#include "sensors/planar_beams.h"

#include <cstdint>

#include "sensors/beam_mounts.h"

namespace robosim {

PlanarBeams::PlanarBeams(const std::vector<Beam>& beams) {
  for (const auto& beam : beams) beams_.push_back({originOf(beam), directionOf(beam)});
  for (const auto& [z_m, indices] : beamsByHeight(beams)) {
    std::vector<Ray> rays;
    for (const auto i : indices) rays.push_back(beams_[i]);
    HeightGroup& group = groups_.emplace_back(HeightGroup{indices, BeamFan(rays), {}});
    group.beam_of_slot.resize(indices.size());
    for (std::size_t k = 0; k < indices.size(); ++k) {
      group.beam_of_slot[group.fan.slotOf(k)] = static_cast<std::uint32_t>(indices[k]);
    }
  }
}

}  // namespace robosim
