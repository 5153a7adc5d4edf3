#pragma once
#include "net/world.pb.h"
#include "robots/world_source.h"

namespace robosim {

/// Conversion between WorldSource and wire::WorldSource (world.proto). loadWorld() validates the content.
void encode(const WorldSource& source, wire::WorldSource& out);
WorldSource decode(wire::WorldSource&& in);  ///< moves the texts
WorldSource decode(const wire::WorldSource& in);

}  // namespace robosim
