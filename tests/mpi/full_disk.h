#pragma once
#include <string>

#include "tests/scenarios/program.h"

namespace robosim {

/// Runs `robosim ARGUMENTS` on several ranks, whose files cannot grow beyond a size, as on a full disk. The ranks
/// exchange messages by TCP, because shared memory needs larger files.
/// @param blocks of 512 bytes
inline Ended onFullDisk(int ranks, const std::string& arguments, int blocks) {
  return runCommand(ROBOSIM_MPIRUN " --mca btl self,tcp -n " + std::to_string(ranks) +
                    " /bin/sh -c \"trap '' XFSZ; ulimit -f " + std::to_string(blocks) +
                    "; exec '" ROBOSIM_PROGRAM "' " + arguments + "\"");
}

}  // namespace robosim
