#pragma once
#include "robosim/bench_rounds.h"

namespace robosim {

/// What a simulated second of worlds/opho2_1.xml costs: four robots under the gold finder, from the start until all
/// have halted, one thread.
struct SmallRunFigures {
  Cost plain;
  Cost recorded;  ///< the same with a recording of everything, to memory, from its first byte until its file is whole
};

/// In turns, in a process of its own.
SmallRunFigures benchSmallRun(double least_s);

}  // namespace robosim
