#include "robosim/interrupt.h"

#include <csignal>

namespace robosim {
namespace {

volatile std::sig_atomic_t interrupt_asked = 0;

void onSignal(int signal) {
  interrupt_asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  interrupt_asked = 0;
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::asked() const { return interrupt_asked != 0; }

}  // namespace robosim
