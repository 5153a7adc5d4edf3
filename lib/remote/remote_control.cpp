#include "remote/remote_control.h"

#include <algorithm>
#include <optional>

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// How long after a call has failed the next is made; and after one that was refused, which seldom changes.
constexpr auto kPause = 1s;
constexpr auto kPauseAfterRefusal = 5s;
/// How long the primary waits for secondaries that neither answer nor fail.
constexpr auto kPatience = 3s;

std::size_t primaryOf(const std::vector<RobotAddress>& list) {
  const auto found = std::find_if(list.begin(), list.end(), [](const RobotAddress& robot) { return robot.primary; });
  return static_cast<std::size_t>(found - list.begin()) % list.size();
}

}  // namespace

struct RemoteControl::Seat {
  Seat(const std::string& robot, const DialOptions& dialled, const std::function<void()>& ring)
      : name(robot), address(dialled.address), link(robot, dialled, ring) {}

  std::string name, address;
  RobotLink link;
  std::optional<Clock::time_point> called;  ///< when the last call began
  std::optional<Clock::time_point> failed;  ///< since when there is no call
};

RemoteControl::RemoteControl(const std::vector<RobotAddress>& list, const Options& options)
    : options_(options), rota_(list.size(), primaryOf(list)), begun_(options.now()) {
  for (const auto& robot : list) {
    DialOptions dialled = options.dial;
    dialled.address = robot.hostname + ":" + std::to_string(robot.port);
    seats_.push_back(std::make_unique<Seat>(robot.name, dialled, options.ring));
  }
  seats_[rota_.primary()]->link.setLive(true);
}

RemoteControl::~RemoteControl() = default;

void RemoteControl::tick() {
  const auto now = options_.now();
  for (auto& seat : seats_) {
    const bool fails = seat->called && !seat->failed && !seat->link.isCalling();
    if (fails) seat->failed = now;
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    Seat& seat = *seats_[i];
    const bool is_primary = i == rota_.primary();
    if (is_primary && !has_called_primary_ && !areSecondariesSettled() && now - begun_ < kPatience) continue;
    const auto pause = seat.link.news().was_refused ? kPauseAfterRefusal : kPause;
    if (!seat.called || (seat.failed && now - *seat.failed >= pause)) call(seat, !is_primary);
    if (is_primary) has_called_primary_ = true;
  }
}

void RemoteControl::call(Seat& seat, bool autonomous) {
  if (!seat.called) seat.link.claim(options_.driver, autonomous);
  seat.called = options_.now();
  seat.failed.reset();
  seat.link.connect();
}

bool RemoteControl::areSecondariesSettled() const {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (i == rota_.primary()) continue;
    const Seat& seat = *seats_[i];
    if (!seat.failed && !(seat.called && seat.link.news().is_up)) return false;
  }
  return true;
}

RemoteControl::Robot RemoteControl::robotAt(std::size_t seat) const {
  return {seats_[seat]->name, seats_[seat]->address, seats_[seat]->link.news()};
}

std::vector<RemoteControl::Robot> RemoteControl::robots() const {
  std::vector<Robot> robots;
  for (const auto seat : rota_.row()) robots.push_back(robotAt(seat));
  return robots;
}

RemoteControl::Robot RemoteControl::primary() const { return robotAt(rota_.primary()); }

bool RemoteControl::switchPrimary() {
  const auto next = rota_.next([this](std::size_t seat) { return robotAt(seat).isFit(); });
  if (next) makePrimary(*next);
  return next.has_value();
}

bool RemoteControl::switchTo(const std::string& name) {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (seats_[i]->name != name || !robotAt(i).isFit()) continue;
    makePrimary(i);
    return true;
  }
  return false;
}

void RemoteControl::makePrimary(std::size_t seat) {
  if (seat == rota_.primary()) return;
  seats_[rota_.primary()]->link.setLive(false);
  setAutonomous(true);
  rota_.switchTo(seat);
  claimPrimary();
  seats_[seat]->link.setLive(true);
}

void RemoteControl::setDriver(const std::string& driver) {
  options_.driver = driver;
  claimPrimary();
}

void RemoteControl::claimPrimary() { seats_[rota_.primary()]->link.claim(options_.driver, false); }

void RemoteControl::send(const RemoteOrder& order) { seats_[rota_.primary()]->link.send(order); }

void RemoteControl::setAutonomous(bool autonomous) {
  seats_[rota_.primary()]->link.send({.type = RemoteType::init_ack, .autonomous = autonomous});
}

}  // namespace robosim
