#pragma once
#include "net/remote_wire.h"

namespace robosim {

/// The DRIVE order with the effect of `older` followed by `newer`: what `newer` omits, `older` specifies. Where the
/// newest of several orders counts, an older DRIVE that sets the speed to 0 must not get lost to one that only turns.
/// @pre both are DRIVE orders
inline RemoteOrder mergeDrive(const RemoteOrder& older, RemoteOrder newer) {
  if (!newer.speed_mps) newer.speed_mps = older.speed_mps;
  if (!newer.turn_radps) newer.turn_radps = older.turn_radps;
  if (!newer.laser_pan_rad) newer.laser_pan_rad = older.laser_pan_rad;
  return newer;
}

}  // namespace robosim
