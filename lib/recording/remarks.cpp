#include "recording/remarks.h"

#include <mrpt/obs/CObservationRawDAQ.h>

#include "recording/observations.h"

namespace robosim {

mrpt::obs::CObservation::Ptr Remarks::of(const Readings& readings, const Command& command) {
  // What its controller commands is not for a recording: it would double the recording, and can be had again.
  Told now{command.by_driver ? command : Command{}, 0};
  now.outputs = static_cast<std::uint8_t>((command.by_driver ? 1 : 0) | (readings.is_too_far ? 2 : 0) |
                                          (readings.winner == robot_ ? 4 : 0));
  if (now == told_) return nullptr;
  told_ = now;
  auto driver = mrpt::obs::CObservationRawDAQ::Create();
  driver->sensorLabel = sensorLabel(robot_, kDriver);
  driver->timestamp = timestampOf(readings.time);
  driver->AOUT_double = {now.command.speed_mps, now.command.turn_radps, static_cast<double>(now.command.laser_pan_rad)};
  driver->DOUT = {now.outputs};
  return driver;
}

}  // namespace robosim
