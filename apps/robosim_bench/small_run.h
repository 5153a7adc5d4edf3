#pragma once
#include "robosim_bench/rounds.h"

namespace robosim {

/// Cost of a simulated second of worlds/opho2_1.xml: four robots with the gold finder, from the start until all have
/// halted, one thread.
struct SmallRunFigures {
  Cost plain;
  Cost recorded;  ///< the same including a complete recording to memory
};

/// Measured alternately, in a separate process.
SmallRunFigures benchSmallRun(double min_s);

}  // namespace robosim
