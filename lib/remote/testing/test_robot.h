#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "control/testing/fake_hardware.h"
#include "remote/remote_port.h"

/// @file
/// Robots without a world, with real remote ports.
namespace robosim {

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

/// Calls `meanwhile` until `is_done` returns true.
/// @throws std::runtime_error after a minute, which is for calls that never return
inline void waitUntil(const std::function<bool()>& is_done, const std::function<void()>& meanwhile) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!is_done()) {
    if (std::chrono::steady_clock::now() > deadline)
      throw std::runtime_error("the condition did not hold within a minute");
    meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace robosim
