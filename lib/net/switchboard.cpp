#include "net/switchboard.h"

#include <algorithm>
#include <thread>

namespace robosim {
namespace {

/// Where there are several desks, those but the first are looked after so often.
constexpr std::chrono::milliseconds kRound(20);
/// A step that waits for nobody may take less time than to look whether anything has happened, so not each looks.
constexpr std::chrono::milliseconds kGlance(1);
/// So many things happen between two looks at anything else, however many are due: a flood keeps nobody from stepping.
constexpr int kAtOnce = 32;
constexpr std::chrono::seconds kGrace(1);

gpr_timespec timespecOf(Switchboard::Clock::time_point until) {
  const auto wait = std::chrono::duration_cast<std::chrono::nanoseconds>(until - Switchboard::Clock::now());
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC), gpr_time_from_nanos(wait.count(), GPR_TIMESPAN));
}

}  // namespace

Switchboard::Switchboard(const std::vector<Offer>& offers, const PortOptions& options) {
  for (const auto& offer : offers) {
    const auto found =
        std::find_if(desks_.begin(), desks_.end(), [&](const Desk& desk) { return desk.address == offer.address; });
    desk_of_offer_.push_back(static_cast<std::size_t>(found - desks_.begin()));
    if (found == desks_.end()) desks_.push_back({offer.address, nullptr, {}});
  }
  try {
    for (std::size_t d = 0; d < desks_.size(); ++d) {
      std::vector<grpc::Service*> services;
      for (std::size_t i = 0; i < offers.size(); ++i) {
        if (desk_of_offer_[i] == d) services.push_back(offers[i].service);
      }
      grpc::ServerBuilder builder;
      desks_[d].queue = builder.AddCompletionQueue();
      desks_[d].open = openPort(desks_[d].address, options, services, std::move(builder));
    }
  } catch (...) {
    close();
    throw;
  }
}

Switchboard::~Switchboard() { close(); }

Switchboard::Line Switchboard::line(std::size_t offer) {
  return {this, queue(), desks_[desk_of_offer_[offer]].queue.get()};
}

void Switchboard::waitForOne(gpr_timespec until) {
  void* tag = nullptr;
  bool ok = false;
  const bool has_come = looks_out_ ? awaitEvent(*queue(), lookout_, until, tag, ok)
                                   : queue()->AsyncNext(&tag, &ok, until) == grpc::CompletionQueue::GOT_EVENT;
  if (has_come) static_cast<Event*>(tag)->happened(ok);
}

bool Switchboard::takeOne(grpc::ServerCompletionQueue& queue) {
  void* tag = nullptr;
  bool ok = false;
  if (queue.AsyncNext(&tag, &ok, gpr_time_0(GPR_CLOCK_MONOTONIC)) != grpc::CompletionQueue::GOT_EVENT) return false;
  static_cast<Event*>(tag)->happened(ok);
  return true;
}

void Switchboard::takeFromOtherDesks() {
  for (std::size_t d = 1; d < desks_.size(); ++d) {
    for (int n = 0; n < kAtOnce && takeOne(*desks_[d].queue); ++n) {
    }
  }
}

void Switchboard::waitUntil(Clock::time_point until, const std::function<bool()>& is_enough) {
  bool has_waited = false;
  while (!is_enough()) {
    const auto now = Clock::now();
    if (has_waited && now >= until) return;
    takeFromOtherDesks();
    waitForOne(timespecOf(desks_.size() == 1 ? until : std::min(until, now + kRound)));
    has_waited = true;
  }
  if (!has_waited) glance();
}

void Switchboard::glance() {
  const auto now = Clock::now();
  if (now - last_glance_ < kGlance) return;
  last_glance_ = now;
  takeFromOtherDesks();
  for (int n = 0; n < kAtOnce && takeOne(*desks_.front().queue); ++n) {
  }
}

void Switchboard::close() {
  if (std::exchange(is_closed_, true)) return;
  std::thread closing([&] {
    const auto until = std::chrono::system_clock::now() + kGrace;
    for (const auto& desk : desks_) {
      if (desk.open.server) desk.open.server->Shutdown(until);
    }
  });
  while (calls_ > 0) {
    takeFromOtherDesks();
    waitForOne(timespecOf(Clock::now() + kRound));
  }
  closing.join();
  for (const auto& desk : desks_) {
    if (!desk.queue) continue;
    desk.queue->Shutdown();
    void* tag = nullptr;
    for (bool ok = false; desk.queue->Next(&tag, &ok);) {
    }
  }
}

}  // namespace robosim
