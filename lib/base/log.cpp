#include "base/log.h"

#include <iostream>

#include "base/printable_text.h"

namespace robosim {

void logLine(const std::string& subcommand, const std::string& line) {
  std::cerr << "robosim " + subcommand + ": " + printableText(line) + "\n";
}

}  // namespace robosim
