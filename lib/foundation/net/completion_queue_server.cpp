#include "net/completion_queue_server.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <dlfcn.h>

#include "base/log.h"
#include "net/flood_guard.h"

namespace robosim {
namespace {

/// Interval at which the queues of all endpoints but the first are polled.
constexpr std::chrono::milliseconds kSecondaryPollInterval(20);
/// Minimum interval between polls when waitUntil() does not wait: a step can take less time than a poll.
constexpr std::chrono::milliseconds kPollInterval(1);
/// Maximum number of events handled per queue and poll, so that a flood of events cannot delay the step.
constexpr int kMaxEventsPerPoll = 32;
constexpr std::chrono::seconds kShutdownGracePeriod(1);

gpr_timespec toTimespec(CompletionQueueServer::Clock::time_point until) {
  const std::chrono::nanoseconds wait = until - CompletionQueueServer::Clock::now();
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC), gpr_time_from_nanos(wait.count(), GPR_TIMESPAN));
}

/// Loads gRPC's library for reflection, which this program is not linked to: it adds the service to all servers whose
/// grpc::ServerBuilder is created from then on.
/// @throws std::runtime_error with how to fix it when the library is not installed.
void enableReflection() {
  if (dlopen(ROBOSIM_GRPC_REFLECTION, RTLD_NOW)) return;
  throw std::runtime_error("cannot load " ROBOSIM_GRPC_REFLECTION ", which --reflection requires (" +
                           std::string(dlerror()) + "); install it, or serve without --reflection");
}

}  // namespace

CompletionQueueServer::CompletionQueueServer(const std::vector<Binding>& bindings, const PortOptions& options) {
  for (const auto& binding : bindings) {
    const auto found = std::find_if(endpoints_.begin(), endpoints_.end(),
                                    [&](const Endpoint& endpoint) { return endpoint.address == binding.address; });
    endpoint_of_binding_.push_back(static_cast<std::size_t>(found - endpoints_.begin()));
    if (found == endpoints_.end()) endpoints_.push_back({binding.address, nullptr, {}});
  }
  try {
    for (std::size_t d = 0; d < endpoints_.size(); ++d) {
      std::vector<grpc::Service*> services;
      for (std::size_t i = 0; i < bindings.size(); ++i) {
        if (endpoint_of_binding_[i] == d) services.push_back(bindings[i].service);
      }
      if (options.standard_services.reflection) enableReflection();
      grpc::ServerBuilder builder;
      endpoints_[d].queue = builder.AddCompletionQueue();
      endpoints_[d].port = openPort(endpoints_[d].address, options, services, std::move(builder));
    }
  } catch (...) {
    close();
    throw;
  }
}

CompletionQueueServer::~CompletionQueueServer() { close(); }

CompletionQueueServer::ServiceQueues CompletionQueueServer::queuesFor(std::size_t binding) {
  return {this, queue(), endpoints_[endpoint_of_binding_[binding]].queue.get()};
}

void CompletionQueueServer::waitForEvent(gpr_timespec until) {
  void* tag = nullptr;
  bool ok = false;
  const bool has_event = [&] {
    const flood_guard::Wait wait;
    return polls_adaptively_ ? awaitEvent(*queue(), polling_, until, tag, ok)
                             : queue()->AsyncNext(&tag, &ok, until) == grpc::CompletionQueue::GOT_EVENT;
  }();
  if (has_event) handle(tag, ok);
}

void CompletionQueueServer::handle(void* tag, bool ok) {
  std::unique_lock<std::mutex> lock;
  if (mutex_) lock = std::unique_lock(*mutex_);
  static_cast<CompletionTag*>(tag)->onCompletion(ok);
}

void CompletionQueueServer::wake() {
  const std::lock_guard lock(wake_mutex_);
  if (!accepts_wakes_ || std::exchange(is_wake_pending_, true)) return;
  wake_alarm_.Set(queue(), std::chrono::system_clock::now(), wake_tag_.tag());
}

void CompletionQueueServer::woke(bool) {
  const std::lock_guard lock(wake_mutex_);
  is_wake_pending_ = false;
}

bool CompletionQueueServer::handleNext(grpc::ServerCompletionQueue& queue) {
  void* tag = nullptr;
  bool ok = false;
  const bool has_event = [&] {
    const flood_guard::Wait wait;
    return queue.AsyncNext(&tag, &ok, gpr_time_0(GPR_CLOCK_MONOTONIC)) == grpc::CompletionQueue::GOT_EVENT;
  }();
  if (!has_event) return false;
  handle(tag, ok);
  return true;
}

void CompletionQueueServer::handleSecondaryEvents() {
  for (std::size_t d = 1; d < endpoints_.size(); ++d) {
    for (int n = 0; n < kMaxEventsPerPoll && handleNext(*endpoints_[d].queue); ++n) {
    }
  }
}

void CompletionQueueServer::waitUntil(Clock::time_point until, const std::function<bool()>& is_enough) {
  bool has_waited = false;
  while (!is_enough()) {
    const auto now = Clock::now();
    if (has_waited && now >= until) return;
    handleSecondaryEvents();
    waitForEvent(toTimespec(endpoints_.size() == 1 ? until : std::min(until, now + kSecondaryPollInterval)));
    has_waited = true;
  }
  if (!has_waited) pollAll();
}

void CompletionQueueServer::pollAll() {
  const auto now = Clock::now();
  if (now - last_poll_ < kPollInterval) return;
  last_poll_ = now;
  handleSecondaryEvents();
  for (int n = 0; n < kMaxEventsPerPoll && handleNext(*endpoints_.front().queue); ++n) {
  }
}

void CompletionQueueServer::close(Clock::duration at_most) {
  if (std::exchange(is_closed_, true)) return;
  {
    const std::lock_guard lock(wake_mutex_);
    accepts_wakes_ = false;
  }
  for (auto& endpoint : endpoints_) endpoint.port.gate.reset();
  std::thread closing([&] {
    const auto until = std::chrono::system_clock::now() + kShutdownGracePeriod;
    for (const auto& endpoint : endpoints_) {
      if (endpoint.port.server) endpoint.port.server->Shutdown(until);
    }
  });
  const auto until = Clock::now() + at_most;
  while (*calls_ > 0 && Clock::now() < until) {
    handleSecondaryEvents();
    waitForEvent(toTimespec(Clock::now() + kSecondaryPollInterval));
  }
  if (*calls_ > 0) {
    logError("net", std::to_string(*calls_) + " calls have not ended; the ports are closed without them. This is a " +
                        "fault of the program: report it with the lines before this one");
  }
  closing.join();
  for (const auto& endpoint : endpoints_) {
    if (!endpoint.queue) continue;
    endpoint.queue->Shutdown();
    void* tag = nullptr;
    for (bool ok = false; endpoint.queue->Next(&tag, &ok);) {
    }
  }
}

}  // namespace robosim
