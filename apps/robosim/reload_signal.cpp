#include "robosim/reload_signal.h"

#include <csignal>

namespace robosim {
namespace {

volatile std::sig_atomic_t reload_asked = 0;

}  // namespace

void catchReloadSignal() {
  struct sigaction action {};
  action.sa_handler = [](int) { reload_asked = 1; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGHUP, &action, nullptr);
}

bool isReloadAsked() {
  if (reload_asked == 0) return false;
  reload_asked = 0;
  return true;
}

}  // namespace robosim
