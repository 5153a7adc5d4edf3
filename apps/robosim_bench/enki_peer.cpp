// Enki (libenki-dev) as a peer for simulating robots with infrared sensors: a separate program, because Enki is under
// the GPL. `robosim_bench speed` starts it and controls it over standard input and output, one line per command:
//
//   world WIDTH HEIGHT           a rectangle from (0, 0), with walls [m]
//   circle X Y RADIUS            a stationary object
//   box X Y HEADING LENGTH WIDTH
//   robot X Y HEADING            with the radius and speed set by `robots`
//   robots RADIUS SPEED_MAX      [m], [m/s]
//   step N                       takes N steps of 0.1 s; answers with the CPU and wall time of this process so far [s]
//   speed                        answers with the mean speed of all robots [m/s]
//
// A robot has eight of Enki's infrared sensors of 10 cm range. Each casts three rays 15° apart: 24 rays per robot.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <enki/PhysicalEngine.h>
#include <enki/interactions/IRSensor.h>
#include <enki/robots/DifferentialWheeled.h>

namespace {

constexpr double kCentimetres = 100;  // Enki's unit of length, per metre
constexpr double kPeriod_s = 0.1;
constexpr int kSensors = 8;
constexpr double kRange_cm = 10;
constexpr double kHeight_cm = 5;

/// Drives ahead, and turns away from obstacles that its infrared sensors detect in front of it.
class Avoider : public Enki::DifferentialWheeled {
 public:
  Avoider(double radius_cm, double speed_max_cmps)
      : Enki::DifferentialWheeled(2 * radius_cm, speed_max_cmps, 0), speed_max_cmps_(speed_max_cmps) {
    setCylindric(radius_cm, 2 * kHeight_cm, 100);
    for (int i = 0; i < kSensors; ++i) {
      const double bearing_rad = 2 * M_PI * i / kSensors;
      const Enki::Vector mount(radius_cm * std::cos(bearing_rad), radius_cm * std::sin(bearing_rad));
      sensors_.push_back(
          std::make_unique<Enki::IRSensor>(this, mount, kHeight_cm, bearing_rad, kRange_cm, 3731, 0.3, 0.7, 0));
      addLocalInteraction(sensors_.back().get());
    }
  }

  void controlStep(double dt) override {
    // Sensor 0 points ahead, 1 and 2 to the left, 7 and 6 to the right.
    const double left_cm = std::min(rangeOf(0, 2), rangeOf(1, 3));
    const double right_cm = std::min(rangeOf(0, 2), rangeOf(7, 3));
    const double room_cm = std::min(left_cm, right_cm);
    double left = speed_max_cmps_;
    double right = speed_max_cmps_;
    if (room_cm < kRange_cm) (left_cm < right_cm ? right : left) *= room_cm / kRange_cm - 0.5;
    leftSpeed = left;
    rightSpeed = right;
    Enki::DifferentialWheeled::controlStep(dt);
  }

 private:
  double rangeOf(int sensor, unsigned rays) const {
    double range_cm = kRange_cm;
    for (unsigned ray = 0; ray < rays; ++ray) {
      range_cm = std::min(range_cm, std::max(0.0, sensors_[static_cast<std::size_t>(sensor)]->getRayDist(ray)));
    }
    return range_cm;
  }

  double speed_max_cmps_;
  std::vector<std::unique_ptr<Enki::IRSensor>> sensors_;
};

class Peer {
 public:
  void execute(std::istringstream& line) {
    std::string command;
    line >> command;
    if (command == "world") {
      const double width = length(line);
      world_.emplace(width, length(line));
    } else if (command == "circle") {
      auto* object = new Enki::PhysicalObject;  // owned by the world after addObject()
      place(*object, line, false);
      object->setCylindric(length(line), 2 * kHeight_cm, -1);
      world_->addObject(object);
    } else if (command == "box") {
      auto* object = new Enki::PhysicalObject;
      place(*object, line, true);
      const double along = length(line);
      object->setRectangular(along, length(line), 2 * kHeight_cm, -1);
      world_->addObject(object);
    } else if (command == "robots") {
      radius_cm_ = length(line);
      speed_max_cmps_ = length(line);
    } else if (command == "robot") {
      auto* robot = new Avoider(radius_cm_, speed_max_cmps_);
      place(*robot, line, true);
      world_->addObject(robot);
      robots_.push_back(robot);
    } else if (command == "step") {
      unsigned long steps = 0;
      line >> steps;
      for (; steps > 0; --steps) world_->step(kPeriod_s);
      answerClocks();
    } else if (command == "speed") {
      double sum_cmps = 0;
      for (const auto* robot : robots_) sum_cmps += robot->speed.norm();
      std::cout << sum_cmps / kCentimetres / static_cast<double>(robots_.size()) << std::endl;
    }
  }

 private:
  static double length(std::istringstream& line) {
    double metres = 0;
    line >> metres;
    return metres * kCentimetres;
  }
  static void place(Enki::PhysicalObject& object, std::istringstream& line, bool has_heading) {
    object.pos.x = length(line);
    object.pos.y = length(line);
    if (has_heading) line >> object.angle;
  }
  static void answerClocks() {
    timespec cpu{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    std::cout.precision(17);
    std::cout << static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec) << ' '
              << std::chrono::duration<double>(wall).count() << std::endl;
  }

  std::optional<Enki::World> world_;
  std::vector<const Avoider*> robots_;
  double radius_cm_ = 0;
  double speed_max_cmps_ = 0;
};

}  // namespace

int main() {
  Peer peer;
  for (std::string text; std::getline(std::cin, text);) {
    std::istringstream line(text);
    peer.execute(line);
  }
}
