#pragma once
#include <memory>
#include <string>

#include "arcos/client/byte_channel.h"

namespace robosim {

/// The bytes that a robot sent, from a file of logChannel(). Writing has no effect.
/// @throws ConfigError for a file that is no log
std::unique_ptr<ByteChannel> replayChannel(const std::string& file);

}  // namespace robosim
