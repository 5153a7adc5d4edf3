#include "viewing/run_operator.h"

#include <chrono>
#include <iostream>
#include <optional>
#include <string>

#include "base/log.h"

namespace robosim {
namespace {

/// Polling period of the run's status.
constexpr std::chrono::milliseconds kPeriod{500};

}  // namespace

RunOperator::RunOperator(const ConnectOptions& connect_options) : panel_(connect_options) {
  store(panel_.status());
  thread_ = std::thread([this] { work(); });
}

RunOperator::~RunOperator() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  condition_.notify_one();
  panel_.leave();
  thread_.join();
}

void RunOperator::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  is_paused_ = paused;
  send([paused](ControlPanel& panel) { return paused ? panel.pause() : panel.start(); });
}

void RunOperator::step() {
  const std::lock_guard lock(mutex_);
  is_paused_ = true;
  send([](ControlPanel& panel) { return panel.step(1); });
}

void RunOperator::setSpeed(double speed) {
  const std::lock_guard lock(mutex_);
  speed_ = speed;
  send([speed](ControlPanel& panel) { return panel.setSpeed(speed); });
}

bool RunOperator::isPaused() const {
  const std::lock_guard lock(mutex_);
  return is_paused_;
}

double RunOperator::speed() const {
  const std::lock_guard lock(mutex_);
  return speed_;
}

void RunOperator::send(Operation operation) {
  operations_.push_back(std::move(operation));
  condition_.notify_one();
}

void RunOperator::store(const v1::RunStatus& status) {
  is_paused_ = status.phase() == v1::RUN_PHASE_PAUSED;
  speed_ = status.speed();
}

void RunOperator::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    condition_.wait_for(lock, kPeriod, [this] { return is_stopping_ || !operations_.empty(); });
    if (is_stopping_) return;
    const bool is_requested = !operations_.empty();
    const Operation operation = is_requested ? operations_.front() : [](ControlPanel& panel) { return panel.status(); };
    lock.unlock();
    std::optional<v1::RunStatus> status;
    try {
      status = operation(panel_);
    } catch (const ConnectionError& error) {
      // Viewers detect a lost connection themselves.
      const bool is_refusal = !error.isTransient() && error.code() != grpc::StatusCode::CANCELLED;
      if (is_requested && is_refusal) logError("view", error.what());
    }
    lock.lock();
    if (is_requested) operations_.pop_front();
    if (status && operations_.empty()) store(*status);  // otherwise outdated by a pending request
  }
}

}  // namespace robosim
