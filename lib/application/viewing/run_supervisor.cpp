#include "viewing/run_supervisor.h"

#include <utility>

namespace robosim {

RunSupervisor::~RunSupervisor() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  condition_.notify_one();
  panel_.leave();
  if (thread_.joinable()) thread_.join();
}

void RunSupervisor::request(const Change& change) {
  const std::lock_guard lock(mutex_);
  changes_.push_back(change);
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  condition_.notify_one();
}

std::vector<std::string> RunSupervisor::takeAnswers() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answers_, {});
}

std::string RunSupervisor::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

void RunSupervisor::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    condition_.wait(lock, [this] { return is_stopping_ || !changes_.empty(); });
    if (is_stopping_) return;
    const Change change = std::move(changes_.front());
    changes_.pop_front();
    lock.unlock();
    std::string fault = send(change);
    lock.lock();
    answers_.push_back(std::move(fault));
  }
}

std::string RunSupervisor::send(const Change& change) {
  try {
    panel_.supervise(change);
    return {};
  } catch (const ConnectionError& error) {
    // The window names the environment.
    const std::string prefix = "the environment at " + connect_options_.address + ": ", text = error.what();
    std::string fault = text.starts_with(prefix) ? text.substr(prefix.size()) : text;
    const auto code = error.code();
    const bool lacks_right = code == grpc::StatusCode::PERMISSION_DENIED || code == grpc::StatusCode::UNAUTHENTICATED;
    if (lacks_right) fault = "moving requires a token of the role supervisor: " + fault;
    if (lacks_right || code == grpc::StatusCode::UNIMPLEMENTED) {
      const std::lock_guard lock(mutex_);
      refusal_ = fault;
    }
    return fault;
  }
}

}  // namespace robosim
