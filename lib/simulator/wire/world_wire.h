#pragma once
#include "robosim/v1/world.pb.h"
#include "robots/world_source.h"

namespace robosim {

/// Conversion between WorldSource and v1::WorldSource (world.proto). loadWorld() validates the content.
void encode(const WorldSource& source, v1::WorldSource& out);
WorldSource decode(v1::WorldSource&& in);  ///< moves the texts
WorldSource decode(const v1::WorldSource& in);

}  // namespace robosim
