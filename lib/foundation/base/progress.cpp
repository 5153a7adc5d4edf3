#include "base/progress.h"

#include <algorithm>

#include <unistd.h>

#include "base/printable_text.h"
#include "base/text_table.h"

namespace robosim {
namespace {

constexpr std::chrono::milliseconds kTerminalPeriod{200};
constexpr std::chrono::minutes kLogPeriod{1};

}  // namespace

Progress::Progress() : Progress(stderr, isatty(STDERR_FILENO) == 1, Clock::now) {}

Progress::Progress(std::FILE* out, bool on_terminal, std::function<Clock::time_point()> now)
    : out_(out), on_terminal_(on_terminal), now_(std::move(now)), next_(now_()) {
  if (!on_terminal_) next_ += kLogPeriod;
}

Progress::~Progress() {
  if (shown_ > 0) std::fprintf(out_, "\r%*s\r", static_cast<int>(shown_), "");
}

bool Progress::due() {
  const auto now = now_();
  is_due_ = now >= next_;
  if (is_due_ && on_terminal_) next_ = now + kTerminalPeriod;
  if (is_due_ && !on_terminal_) next_ = now + kLogPeriod;
  return is_due_;
}

void Progress::show(const std::string& shown) {
  const std::string text = printableText(shown);
  if (!on_terminal_) {
    if (is_due_) std::fprintf(out_, "%s\n", text.c_str());
    is_due_ = false;
  } else {
    const auto pad = static_cast<int>(shown_ > text.size() ? shown_ - text.size() : 0);
    std::fprintf(out_, "\r%s%*s", text.c_str(), pad, "");
    shown_ = text.size();
  }
  std::fflush(out_);
}

std::string remainingTime(double elapsed_s, double done, double total) {
  if (!(done > 0)) return "";
  const double left_s = elapsed_s / done * std::max(0.0, total - done);
  if (left_s <= 120) return fixed(left_s, 0) + " s left";
  if (left_s <= 2 * 3600) return fixed(left_s / 60, 0) + " min left";
  if (left_s <= 2 * 86400) return fixed(left_s / 3600, 1) + " h left";
  return fixed(left_s / 86400, 1) + " days left";
}

std::string commaRemainingTime(double elapsed_s, double done, double total) {
  const std::string text = remainingTime(elapsed_s, done, total);
  return text.empty() ? "" : ", " + text;
}

}  // namespace robosim
