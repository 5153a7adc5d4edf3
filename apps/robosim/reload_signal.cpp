#include "robosim/reload_signal.h"

#include <csignal>

namespace robosim {
namespace {

volatile std::sig_atomic_t reload_requested = 0;

}  // namespace

void catchReloadSignal() {
  struct sigaction action {};
  action.sa_handler = [](int) { reload_requested = 1; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGHUP, &action, nullptr);
}

bool isReloadRequested() {
  if (reload_requested == 0) return false;
  reload_requested = 0;
  return true;
}

}  // namespace robosim
