// A viewer for tests, and for whoever has no screen: a line for each frame, and one for each robot named with what its
// sensors measured.
//
//     robosim_text_viewer HOST:PORT [ROBOT… | all]
#include <algorithm>
#include <exception>
#include <iostream>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "net/listen.h"
#include "server/viewer.h"

namespace robosim {
namespace {

ReadingsWish wishFor(std::span<char*> names, const Fleet& fleet) {
  ReadingsWish wish;
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
  void operator()(const Scalar& scalar) const { std::cout << scalar.value; }
  void operator()(const Contacts& contacts) const {
    for (const auto segment : contacts.pressed) std::cout << static_cast<int>(segment);
  }
  void operator()(const Odometry& odometry) const {
    const auto& at = odometry.odom_from_robot;
    std::cout << at.x << ' ' << at.y << ' ' << at.phi;
  }
  void operator()(const Image& image) const { std::cout << image.jpeg.size() << " bytes"; }
  void operator()(const Blobs& blobs) const {
    for (const auto& blob : blobs.of_color) std::cout << blob.color << ' ' << blob.pixels << ' ';
  }
};

void print(const Sight& sight) {
  std::cout << "step " << sight.step;
  const auto& robots = sight.world.fleet.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto& at = sight.robots[i].world_from_robot;
    std::cout << "; " << robots[i].info.name << ' ' << at.x << ' ' << at.y << ' ' << at.phi;
  }
  std::cout << '\n';
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Readings* readings = sight.readingsOf(i);
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
    print(viewer.sight());
    if (arguments.size() > 1) viewer.want(wishFor(arguments.subspan(1), viewer.sight().world.fleet));
    while (viewer.look()) print(viewer.sight());
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "robosim_text_viewer: " << error.what() << '\n';
    return 1;
  }
}
