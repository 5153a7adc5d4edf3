#include "robosim/remote_joystick.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <unistd.h>

#include "base/angle_units.h"
#include "base/printable_text.h"
#include "base/text_table.h"
#include "console/team_events.h"
#include "remote/joystick_control.h"
#include "robosim/device_library.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;
using Clock = RemoteControl::Clock;

constexpr auto kPause = 50ms;

struct NearestEcho {
  double operator()(const Echoes& echoes) const {
    double nearest_m = INFINITY;
    for (const Echo& echo : echoes) nearest_m = std::min<double>(nearest_m, echo.range_m);
    return nearest_m;
  }
  double operator()(const auto&) const { return INFINITY; }
};

std::string driveState(const RobotNews& news) {
  const v1::RobotState& state = news.state;
  if (!state.winner().empty() && (news.is_up || news.is_over)) return state.winner() + " has won";
  if (news.is_over) return news.problem;
  if (!news.is_up) return news.problem.empty() ? "connecting" : "down: " + news.problem;
  if (!state.is_yours()) return state.driver().empty() ? "no driver" : state.driver() + " drives";
  if (state.autonomous()) return "autonomous";
  if (state.is_stopping()) return state.why_stopped().empty() ? "stopping" : "stopping: " + state.why_stopped();
  return state.why_stopped().empty() ? "you drive" : "stopped: " + state.why_stopped();
}

/// "Pioneer1: 12.3 s, 0.40 m/s, 12 °/s, heat 3.1, nearest 0.84 m; you drive"
std::string statusText(const RemoteControl::Robot& robot) {
  const RobotNews& news = robot.news;
  std::string line = robot.name + ": ";
  if (news.update && news.is_up) {
    const Readings& readings = news.update->readings;
    line += fixed(readings.time.seconds(), 1) + " s, " + fixed(news.update->state.speed_mps(), 2) + " m/s, " +
            fixed(toDegrees(news.update->state.turn_radps()), 0) + " °/s";
    double nearest_m = INFINITY;
    for (std::size_t i = 0; i < readings.measurements.size(); ++i) {
      const auto& measured = readings.measurements[i];
      const auto* scalar = std::get_if<Scalar>(&measured);
      if (scalar && (*news.info->sensors)[i].kind == SensorKind::heat) line += ", heat " + fixed(scalar->value, 1);
      nearest_m = std::min(nearest_m, std::visit(NearestEcho{}, measured));
    }
    if (std::isfinite(nearest_m)) line += ", nearest " + fixed(nearest_m, 2) + " m";
    line += readings.stalled ? ", stalled; " : "; ";
  }
  return line + driveState(news);
}

/// The status line.
class StatusLine {
 public:
  ~StatusLine() { clear(); }

  void show(const std::string& text, Clock::time_point now) {
    if (now < next_) return;
    next_ = now + (on_terminal_ ? 200ms : 1000ms);
    clear();
    std::printf(on_terminal_ ? "%s" : "%s\n", printableText(text).c_str());
    std::fflush(stdout);
    is_shown_ = true;
  }
  /// Clears the line, so that other output can follow.
  void clear() {
    if (on_terminal_ && is_shown_) std::printf("\r\033[K");
    std::fflush(stdout);
    is_shown_ = false;
  }

 private:
  bool on_terminal_ = isatty(STDOUT_FILENO) == 1;
  bool is_shown_ = false;
  Clock::time_point next_;
};

}  // namespace

void driveByJoystick(RemoteControl& control, int number, double top_speed, const std::function<bool()>& interrupted,
                     const std::function<void(const std::string&)>& log) {
  const auto joystick = loadJoystick(number);
  JoystickControl driver(top_speed);
  TeamEvents events;
  StatusLine line;
  const std::string device = "joystick " + std::to_string(number);
  const auto report = [&](const std::string& text) {
    line.clear();
    log(text);
  };
  bool has_stick = false;
  bool has_reported = false;
  while (!interrupted()) {
    const auto now = Clock::now();
    control.tick();
    const auto robots = control.robots();
    for (const auto& event : events.news(robots)) report(event.line());
    const auto stick = joystick->read();
    if (!has_reported || has_stick != stick.has_value()) {
      has_stick = stick.has_value();
      // Afterwards nothing is sent, so that the robot's dead man's switch also stops it.
      if (!has_stick) control.send(stopOrder("the joystick is disconnected"));
      report(has_stick ? device + " drives " + robots.front().name
                       : "no " + device + " (/dev/input/js" + std::to_string(number) +
                             "): connect a joystick and check its read permission; the robot stands still");
    }
    has_reported = true;
    if (stick) {
      const auto output = driver.next(robots.front().news, *stick, now);
      for (const auto& order : output.orders) control.send(order);
      if (output.switches) {
        const bool done = control.switchPrimary();
        if (done) driver.switchRobot(now);
        report(done ? device + " drives " + control.primary().name : "no other robot can be driven now");
      }
    } else {
      driver.loseStick();
    }
    line.show(statusText(robots.front()), now);
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace robosim
