#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/testing/call_site.h"
#include "control/testing/fake_hardware.h"
#include "remote/remote_port.h"

/// @file
/// Robots without a world, with real remote ports.
namespace robosim {

/// Counts what happens on other threads: log lines of the robots, and news of links whose callback is notify(). A test
/// waits for the next one instead of polling.
class TestEvents {
 public:
  using Clock = std::chrono::steady_clock;

  void notify() {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
  }
  long count() const {
    const std::lock_guard lock(mutex_);
    return count_;
  }
  void waitForMoreThan(long count, Clock::time_point until) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [&] { return count_ > count; });
  }

  /// A minute, which only calls that never return need.
  struct Deadline {
    const Clock::time_point time = Clock::now() + std::chrono::minutes(1);
    void check(const CallSite& place) const {
      if (Clock::now() < time) return;
      throw std::runtime_error(place.text() + ": the condition did not hold within a minute");
    }
  };

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  long count_ = 0;
};

/// Of this process.
inline TestEvents& testEvents() {
  static TestEvents events;
  return events;
}

/// Turns on the spot, which distinguishes its commands from a driver's.
class Spinner : public Controller {
 public:
  void step(Robot& robot) override { robot.drive(0, 1); }
};

/// One robot and its port, stepped by the test, with a clock of its own: 0.1 s per step.
class TestRobot {
 public:
  explicit TestRobot(const std::string& name, Access access = {}, const std::string& listen = "127.0.0.1:0")
      : hardware(named(name)),
        robot(*hardware, std::make_unique<Spinner>(), robotOptions()),
        access_(std::move(access)) {
    open(listen);
  }

  void step() {
    robot.step();
    if (port_) port_->publish();
    hardware->advance();
    now += std::chrono::milliseconds(100);
  }

  int port() const { return number_; }
  bool isWatched() const { return port_->isWatched(0); }
  std::string address() const { return "127.0.0.1:" + std::to_string(number_); }
  void close() { port_.reset(); }
  void reopen() { open(address()); }
  void endRun() { port_->endRun(); }

  std::string log() const {
    const std::lock_guard lock(mutex_);
    return log_;
  }

  std::unique_ptr<FakeHardware> hardware;
  RemoteControlRobot::Clock::time_point now{std::chrono::hours(1)};
  RemoteControlRobot robot;

 private:
  static std::unique_ptr<FakeHardware> named(const std::string& name) {
    auto hardware = std::make_unique<FakeHardware>();
    hardware->mutableInfo().name = name;
    return hardware;
  }
  void write(const std::string& line) {
    const std::lock_guard lock(mutex_);
    log_ += line + "\n";
    testEvents().notify();
  }
  RemoteControlRobot::Options robotOptions() {
    return {.now = [this] { return now; }, .log = [this](const std::string& line) { write(line); }};
  }
  void open(const std::string& listen) {
    RemotePort::Options options;
    options.listen = listen;
    options.access = access_;
    options.log = [this](const std::string& line) { write(line); };
    port_ = std::make_unique<RemotePort>(options, RemotePort::Run{"maze", 7, 0.1}, std::vector{&robot});
    number_ = port_->port();
  }

  Access access_;
  mutable std::mutex mutex_;
  std::string log_;
  std::unique_ptr<RemotePort> port_;
  int number_ = 0;
};

/// Calls `meanwhile`, a step of the robots, until `is_done` returns true: after each event (TestEvents), and otherwise
/// once per millisecond, the real time of a step.
/// @throws std::runtime_error after a minute, with the place of the call
inline void waitUntil(const std::function<bool()>& is_done, const std::function<void()>& meanwhile,
                      const CallSite& place = CallSite::here()) {
  constexpr std::chrono::milliseconds kStepTime(1);
  const TestEvents::Deadline deadline;
  for (;;) {
    const long seen = testEvents().count();
    if (is_done()) return;
    deadline.check(place);
    meanwhile();
    testEvents().waitForMoreThan(seen, TestEvents::Clock::now() + kStepTime);
  }
}

/// Waits for a condition that changes only with an event.
/// @throws std::runtime_error after a minute, with the place of the call
inline void waitUntil(const std::function<bool()>& is_done, const CallSite& place = CallSite::here()) {
  const TestEvents::Deadline deadline;
  for (;;) {
    const long seen = testEvents().count();
    if (is_done()) return;
    deadline.check(place);
    testEvents().waitForMoreThan(seen, deadline.time);
  }
}

}  // namespace robosim
