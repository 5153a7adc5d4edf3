#pragma once
#include <cstddef>
#include <string>

namespace robosim {

/// Number of robot processes, and of robots in each.
struct ProcessLayout {
  std::size_t processes = 0, robots_each = 0;
};

struct NetworkBench {
  ProcessLayout layout;
  int windows = 5;      ///< number of measurements
  double window_s = 1;  ///< duration of each
  bool separate_programs =
      false;  ///< separately started processes; else `robosim robot --separate-processes`, where possible
  std::string tls_cert, tls_key;  ///< empty: without TLS
};

/// Medians over the windows.
struct NetworkFigures {
  double steps_per_s = 0;
  /// CPU time per step, user and system; unlike steps_per_s, nearly independent of other load on the machine.
  double environment_cpu_us = 0;  ///< of the environment's process, including sensor simulation
  double robots_cpu_us = 0;       ///< of one robot process
};

/// Serves a world in lockstep, at maximum speed, to processes of `robosim robot` whose robots run the controller
/// "wander".
NetworkFigures measureNetwork(const NetworkBench& bench);

}  // namespace robosim
