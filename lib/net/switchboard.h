#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "net/lookout.h"
#include "net/open_port.h"

namespace robosim {

/// Something that gRPC was asked to do is done. Who asks for it hands this over as its tag.
class Event {
 public:
  virtual ~Event() = default;
  /// @param ok whether it could be done
  virtual void happened(bool ok) = 0;
  void* tag() { return this; }
};

/// An event that is told to one of its owner's functions.
template <typename Owner>
class EventOf final : public Event {
 public:
  EventOf(Owner& owner, void (Owner::*then)(bool)) : owner_(owner), then_(then) {}
  void happened(bool ok) override { (owner_.*then_)(ok); }

 private:
  Owner& owner_;
  void (Owner::*then_)(bool);
};

/// Where clients' calls come in, and everything that happens to them. It happens while somebody waits here, on the
/// thread that does: so the thread that steps the environment meets its clients between two steps, and there is nothing
/// to lock. (With gRPC's callbacks, which come on threads of its own, each message costs three changes of thread more:
/// doc/decisions/grpc.md.)
class Switchboard {
 public:
  using Clock = std::chrono::steady_clock;

  /// What is to be found at an address.
  struct Offer {
    std::string address;     ///< "host:port"; port 0 lets the system choose
    grpc::Service* service;  ///< must outlive this
  };
  /// What a service needs to wait for calls.
  struct Line {
    Switchboard* switchboard;
    grpc::CompletionQueue* calls;           ///< where gRPC is to tell of what happens to a call …
    grpc::ServerCompletionQueue* arrivals;  ///< … and that there is one: arguments of a generated RequestX()
  };

  /// Opens the ports; equal addresses share one.
  /// @throws std::runtime_error when a port is taken; what, where and the mend.
  Switchboard(const std::vector<Offer>& offers, const PortOptions& options);
  ~Switchboard();
  Switchboard(const Switchboard&) = delete;
  Switchboard& operator=(const Switchboard&) = delete;

  int port(std::size_t offer) const { return desks_[desk_of_offer_[offer]].open.number; }
  Line line(std::size_t offer);
  grpc::CompletionQueue* queue() const { return desks_.front().queue.get(); }

  /// Has things happen until `is_enough`, or the time has come. What is due already may happen in any case.
  void waitUntil(Clock::time_point until, const std::function<bool()>& is_enough);
  /// Whether it may look out for what comes (Lookout) rather than sleep.
  void lookOut(bool may) { looks_out_ = may; }

  /// Takes no more calls, and waits until those that are there have come to their ends; after a second it cuts them
  /// off.
  void close();

  /// A call that is waited for, or going on: for as long as one of these lives, close() waits.
  class Presence {
   public:
    explicit Presence(Switchboard& switchboard) : switchboard_(switchboard) { ++switchboard_.calls_; }
    ~Presence() { --switchboard_.calls_; }
    Presence(const Presence&) = delete;
    Presence& operator=(const Presence&) = delete;
    Switchboard& switchboard() const { return switchboard_; }

   private:
    Switchboard& switchboard_;
  };

 private:
  struct Desk {
    std::string address;
    std::unique_ptr<grpc::ServerCompletionQueue> queue;
    OpenPort open;
  };
  void waitForOne(gpr_timespec until);
  bool takeOne(grpc::ServerCompletionQueue& queue);
  void takeFromOtherDesks();
  void glance();

  std::vector<Desk> desks_;                 ///< the first one's queue is that of all calls
  std::vector<std::size_t> desk_of_offer_;  ///< by offer
  std::size_t calls_ = 0;
  bool looks_out_ = true;
  Lookout lookout_;
  Clock::time_point last_glance_;
  bool is_closed_ = false;
};

}  // namespace robosim
