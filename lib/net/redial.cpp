#include "net/redial.h"

#include <thread>

namespace robosim {

Redial::Redial(std::chrono::duration<double> patience, std::function<void(const std::string&)> log)
    : patience_(patience), log_(std::move(log)) {}

void Redial::keepTalking(const std::function<void()>& talk, const std::function<void()>& reconnect) {
  for (;;) {
    try {
      if (is_broken_) {
        reconnect();
        log_("connected again");
        is_broken_ = false;
      }
      talk();
      return;
    } catch (const ConnectionError& error) {
      waitAfter(error);
    }
  }
}

void Redial::waitAfter(const ConnectionError& error) {
  constexpr std::chrono::milliseconds kPause(100);
  const auto now = Clock::now();
  if (!is_broken_) broken_since_ = now;
  if (!error.mayPass() || now - broken_since_ >= patience_) throw error;
  if (is_broken_) {
    std::this_thread::sleep_for(kPause);
  } else {
    log_(std::string(error.what()) + "; calling again");
  }
  is_broken_ = true;
}

}  // namespace robosim
