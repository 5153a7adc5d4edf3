#pragma once
#include "net/world.pb.h"
#include "robots/world_source.h"

namespace robosim {

/// A world between our value and protobuf's (world.proto). What is wrong inside, loadWorld() tells.
void encode(const WorldSource& source, wire::WorldSource& out);
WorldSource decode(const wire::WorldSource& in);

}  // namespace robosim
