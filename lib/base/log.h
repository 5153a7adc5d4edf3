#pragma once
#include <string>

namespace robosim {

/// Writes "robosim SUBCOMMAND: line" to standard error as a single line: printableText(), so that a text from a file or
/// a peer can neither forge a second line nor control the terminal.
void logLine(const std::string& subcommand, const std::string& line);

}  // namespace robosim
