#include "distributed/rank_bytes.h"

#include <stdexcept>
#include <string>

namespace robosim {

void readRankBytes(std::string_view bytes, const char* what, const std::function<void(StateReader&)>& read) {
  if (bytes.empty()) return;
  try {
    StateReader in(bytes);
    read(in);
    requireContents(in.isAtEnd(), "they are too long");
  } catch (const InvalidContents& fault) {
    throw std::runtime_error("another rank has sent invalid " + std::string(what) + ": " + fault.what() +
                             "; use the same version of RoboSim on all machines");
  }
}

}  // namespace robosim
