// A viewer for tests, and for whoever has no screen: a line for each frame.
//
//     robosim_text_viewer HOST:PORT [SECONDS_BETWEEN_FRAMES [FRAMES]]
#include <chrono>
#include <exception>
#include <iostream>
#include <string>
#include <thread>

#include "net/listen.h"
#include "server/viewer.h"

namespace {

void print(const robosim::Sight& sight) {
  std::cout << "step " << sight.step;
  for (std::size_t i = 0; i < sight.robots.size(); ++i) {
    const auto& at = sight.robots[i].world_from_robot;
    std::cout << "; " << sight.world.fleet.robots[i].info.name << ' ' << at.x << ' ' << at.y << ' ' << at.phi;
  }
  std::cout << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::chrono::duration<double> pause(argc > 2 ? std::stod(argv[2]) : 0);
    const long frames = argc > 3 ? std::stol(argv[3]) : -1;
    robosim::Viewer viewer({.address = robosim::hostAndPort(argc > 1 ? argv[1] : robosim::kDefaultListen)});
    print(viewer.sight());
    for (long seen = 1; seen != frames; ++seen) {
      std::this_thread::sleep_for(pause);
      if (!viewer.look()) break;
      print(viewer.sight());
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "robosim_text_viewer: " << error.what() << '\n';
    return 1;
  }
}
