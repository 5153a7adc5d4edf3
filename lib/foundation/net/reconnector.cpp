#include "net/reconnector.h"

#include <thread>

namespace robosim {

Reconnector::Reconnector(Seconds timeout, std::function<void(const std::string&)> log)
    : timeout_(timeout), log_(std::move(log)) {}

void Reconnector::run(const std::function<void()>& communicate, const std::function<void()>& reconnect) {
  for (;;) {
    try {
      if (is_broken_) {
        reconnect();
        log_("connected again");
        is_broken_ = false;
      }
      communicate();
      return;
    } catch (const ConnectionError& error) {
      waitAfter(error);
    }
  }
}

void Reconnector::waitAfter(const ConnectionError& error) {
  constexpr std::chrono::milliseconds kPause(100);
  const auto now = Clock::now();
  if (!is_broken_) broken_since_ = now;
  if (!error.isTransient() || now - broken_since_ >= timeout_) throw error;
  if (is_broken_) {
    std::this_thread::sleep_for(kPause);
  } else {
    log_(std::string(error.what()) + "; reconnecting");
  }
  is_broken_ = true;
}

}  // namespace robosim
