#include "robosim/run_operator.h"

#include <chrono>
#include <iostream>
#include <optional>
#include <string>

namespace robosim {
namespace {

/// How long what another panel has done may go unnoticed.
constexpr std::chrono::milliseconds kPeriod{500};

}  // namespace

RunOperator::RunOperator(const DialOptions& dial_options) : panel_(dial_options) {
  keep(panel_.status());
  thread_ = std::thread([this] { work(); });
}

RunOperator::~RunOperator() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  bell_.notify_one();
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

void RunOperator::send(Deed deed) {
  deeds_.push_back(std::move(deed));
  bell_.notify_one();
}

void RunOperator::keep(const wire::RunStatus& status) {
  is_paused_ = status.phase() == wire::PAUSED;
  speed_ = status.speed();
}

void RunOperator::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    bell_.wait_for(lock, kPeriod, [this] { return ends_ || !deeds_.empty(); });
    if (ends_) return;
    const bool is_asked = !deeds_.empty();
    const Deed deed = is_asked ? deeds_.front() : [](ControlPanel& panel) { return panel.status(); };
    lock.unlock();
    std::optional<wire::RunStatus> status;
    try {
      status = deed(panel_);
    } catch (const ConnectionError& error) {
      // Who looks at the run knows by itself when the connection is gone.
      const bool is_refusal = !error.mayPass() && error.code() != grpc::StatusCode::CANCELLED;
      if (is_asked && is_refusal) std::cerr << "robosim view: " + std::string(error.what()) + '\n';
    }
    lock.lock();
    if (is_asked) deeds_.pop_front();
    if (status && deeds_.empty()) keep(*status);  // or else it is older than what was asked for meanwhile
  }
}

}  // namespace robosim
