#include "base/progress.h"

#include <cstdio>

#include <unistd.h>

#include "base/printable_text.h"

namespace robosim {

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO) == 1), next_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (shown_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown_), "");
}

bool Progress::due() {
  if (!on_terminal_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds(200);
  return true;
}

void Progress::show(const std::string& shown) {
  if (!on_terminal_) return;
  const std::string text = printableText(shown);
  const auto pad = static_cast<int>(shown_ > text.size() ? shown_ - text.size() : 0);
  std::fprintf(stderr, "\r%s%*s", text.c_str(), pad, "");
  std::fflush(stderr);
  shown_ = text.size();
}

}  // namespace robosim
