#pragma once
#include <cstddef>
#include <string>

namespace robosim {

/// Robots in other processes: so many, with so many robots each.
struct CrowdSize {
  std::size_t processes = 0, robots_each = 0;
};

struct CrowdBench {
  CrowdSize crowd;
  int windows = 5;                ///< how many times to measure
  double window_s = 1;            ///< how long each time
  bool one_by_one = false;        ///< every process a program by itself; else `robosim robot --apart`, where it can be
  std::string tls_cert, tls_key;  ///< empty: without TLS
};

/// Medians of the windows.
struct CrowdFigures {
  double steps_per_s = 0;
  /// CPU time, of user and system together, that a step takes for each of the processes: unlike steps_per_s it hardly
  /// depends on what else the machine is busy with.
  double environment_cpu_us = 0;  ///< the environment's; all of it, the robots' sensing too
  double robots_cpu_us = 0;       ///< the process's own
};

/// Serves a world in lockstep to a crowd of `robosim robot`, whose robots wander, as fast as all answer.
CrowdFigures benchCrowd(const CrowdBench& bench);

}  // namespace robosim
