#pragma once
#include <string>
#include <vector>

#include "net/listen.h"
#include "net/open_port.h"
#include "robosim/connection.h"
#include "robosim/foxglove_options.h"
#include "robosim/ros2_arguments.h"
#include "run/outputs/run_outputs.h"

namespace CLI {
class App;
}

namespace robosim {

/// Arguments of `robosim serve`.
struct ServeArguments {
  RunArguments of_run;
  bool wait_for_robots = false;
  std::string listen = kDefaultListen;
  std::string pace;  ///< "lockstep" or "realtime"; empty: lockstep, or realtime with ARCOS
  double check_results = 0.01;
  std::string on_lost_robot;  ///< empty: default according to the pace
  double step_deadline_s = 1;
  bool paused = false;
  bool await_next_run = false;
  StandardServices standard_services;
  ListenerArguments listener;
  std::string arcos;  ///< address for ARCOS programs; empty: none
  bool arcos_unprotected = false;
  bool arcos_all = false;     ///< also robots with a controller
  bool arcos_maps = false;    ///< ARCOS programs may load other maps
  std::string arcos_factory;  ///< "MODEL" or "MODEL:NUMBER"; empty: a port for each robot
  FoxgloveArguments foxglove;
  std::string web;  ///< address of --web; empty: none
  Ros2Arguments ros2;
};

/// Adds --arcos and the options that belong to it.
void addArcosOptions(CLI::App& command, ServeArguments& arguments);

/// Serves a world until its run is over. @throws ConfigError and others, as `robosim serve`
void serveWorld(const ServeArguments& arguments);

}  // namespace robosim
