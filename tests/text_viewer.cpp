// A text viewer for tests: a line for each frame, and a line with the measurements of each selected robot.
//
//     robosim_text_viewer HOST:PORT [ROBOT… | all]
#include <algorithm>
#include <exception>
#include <iostream>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "client/viewer.h"
#include "hardware/measurement_fields.h"
#include "net/host_port.h"
#include "net/listen.h"

namespace robosim {
namespace {

ReadingsSelection wishFor(std::span<char*> names, const Fleet& fleet) {
  ReadingsSelection wish;
  for (const std::string name : names) {
    const auto found = std::find_if(fleet.robots.begin(), fleet.robots.end(),
                                    [&](const FleetRobot& robot) { return robot.info.name == name; });
    if (name == "all") {
      wish.of_all = true;
    } else if (found == fleet.robots.end()) {
      throw std::runtime_error("there is no robot " + name);
    } else {
      wish.of.push_back(static_cast<std::uint32_t>(found - fleet.robots.begin()));
    }
  }
  return wish;
}

struct Printer {
  void operator()(const Echoes& echoes) const {
    const auto nearest = std::min_element(echoes.begin(), echoes.end(),
                                          [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
    std::cout << "nearest of " << echoes.size() << ' ' << (echoes.empty() ? 0 : nearest->range_m);
  }
  void operator()(const Image& image) const { std::cout << image.jpeg.size() << " bytes"; }
  void operator()(const auto& measurement) const {
    const char* separator = "";
    forNumbers(measurement, [&](const auto&, auto number, std::size_t) {
      std::cout << std::exchange(separator, " ") << static_cast<double>(number);
    });
  }
};

void print(const ViewedRun& viewed_run) {
  std::cout << "step " << viewed_run.snapshot.step;
  const auto& robots = viewed_run.world.fleet.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto& at = viewed_run.snapshot.robots[i].world_from_robot;
    std::cout << "; " << robots[i].info.name << ' ' << at.x << ' ' << at.y << ' ' << at.phi;
  }
  std::cout << '\n';
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Readings* readings = viewed_run.readingsOf(i);
    if (!readings) continue;
    std::cout << "  " << robots[i].info.name;
    for (std::size_t k = 0; k < readings->measurements.size(); ++k) {
      std::cout << "; " << (*robots[i].info.sensors)[k].label << ' ';
      std::visit(Printer{}, readings->measurements[k]);
    }
    std::cout << '\n';
  }
  std::cout << std::flush;
}

}  // namespace
}  // namespace robosim

int main(int argc, char** argv) {
  using namespace robosim;
  try {
    const std::span<char*> arguments(argv + 1, argv + argc);
    Viewer viewer({.address = hostAndPort(arguments.empty() ? kDefaultListen : arguments[0])});
    print(viewer.run());
    if (arguments.size() > 1) viewer.select(wishFor(arguments.subspan(1), viewer.run().world.fleet));
    while (viewer.waitForFrame()) print(viewer.run());
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "robosim_text_viewer: " << error.what() << '\n';
    return 1;
  }
}
