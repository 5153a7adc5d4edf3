#pragma once
#include <memory>
#include <string>

#include "arcos/client/byte_channel.h"

namespace robosim {

/// Opens the connection with a robot:
///  * "tcp:HOST:PORT" or "tcp:HOST" (port 8101): a simulator, or a robot's serial line behind a TCP server;
///  * "serial:/dev/ttyUSB0" or "serial:/dev/ttyUSB0:BAUD" (9600 baud unless given);
///  * "replay:FILE": the bytes that a robot sent, from a file of logChannel().
/// @throws ConfigError for another form, or a file that is no log @throws RobotLinkError when it cannot be opened
std::unique_ptr<ByteChannel> openChannel(const std::string& address);

/// The same channel, with all bytes logged to a text file: a line per read or write, "SECONDS < fa fb …" received or
/// "SECONDS > …" sent, with the time since the start.
/// @throws ConfigError when the file cannot be written
std::unique_ptr<ByteChannel> logChannel(std::unique_ptr<ByteChannel> channel, const std::string& file);

}  // namespace robosim
