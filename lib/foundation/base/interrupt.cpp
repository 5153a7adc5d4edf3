#include "base/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <set>

#include <unistd.h>

namespace robosim {
namespace {

constexpr std::array<int, 3> kInterrupts{SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interrupt_signal = 0;
std::array<struct sigaction, kInterrupts.size()> former_actions;

/// Restores the previous action, so that the same signal ends the program the next time.
void onInterrupt(int signal) {
  interrupt_signal = signal;
  for (std::size_t i = 0; i < kInterrupts.size(); ++i) sigaction(kInterrupts[i], &former_actions[i], nullptr);
}

/// Paths of partial files; null for a free slot. Read by a signal handler, hence atomic and of fixed size.
std::array<std::atomic<const char*>, PartialFile::kMaxPartialFiles> partial_files;
static_assert(std::atomic<const char*>::is_always_lock_free);

/// Only async-signal-safe calls.
void onEndingSignal(int signal) {
  for (const auto& file : partial_files) {
    if (const char* path = file.load()) unlink(path);
  }
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  raise(signal);  // takes effect when this handler returns
}

/// The path in memory that is never freed: a signal handler of another thread may be reading it after the end of its
/// PartialFile. Equal paths share it.
const char* permanent(const std::string& path) {
  static std::mutex mutex;
  static std::set<std::string>& paths = *new std::set<std::string>;
  const std::lock_guard lock(mutex);
  return paths.insert(path).first->c_str();
}

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

Interrupt::Interrupt() {
  interrupt_signal = 0;
  struct sigaction action {};
  action.sa_handler = onInterrupt;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < kInterrupts.size(); ++i) {
    sigaction(kInterrupts[i], nullptr, &former_actions[i]);
    if (kInterrupts[i] == SIGHUP && isIgnored(SIGHUP)) continue;
    sigaction(kInterrupts[i], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  if (is_ignored_until_exit_) return;
  for (std::size_t i = 0; i < kInterrupts.size(); ++i) sigaction(kInterrupts[i], &former_actions[i], nullptr);
}

bool Interrupt::isRequested() const { return signal() != 0; }

void Interrupt::ignoreUntilExit() {
  is_ignored_until_exit_ = true;
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  for (const int signal : kInterrupts) sigaction(signal, &ignore, nullptr);
}

int Interrupt::signal() { return interrupt_signal; }

void throwIfInterrupted(const std::string& what) {
  if (Interrupt::signal() != 0) throw Interrupted("interrupted; " + what);
}

PartialFile::PartialFile(const std::string& path) {
  const char* const permanent_path = permanent(path);
  for (std::size_t i = 0; i < partial_files.size(); ++i) {
    const char* expected = nullptr;
    if (!partial_files[i].compare_exchange_strong(expected, permanent_path)) continue;
    slot_ = i;
    break;
  }
}

PartialFile::~PartialFile() {
  if (slot_ < partial_files.size()) partial_files[slot_] = nullptr;
}

void removePartialFilesOnSignals() {
  struct sigaction action {};
  action.sa_handler = onEndingSignal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    if (!isIgnored(signal)) sigaction(signal, &action, nullptr);
  }
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace robosim
