#include "aria/key_source.h"

#include <cctype>

#include <termios.h>
#include <unistd.h>

namespace robosim {
namespace {

constexpr char kEscape = 27;
constexpr char kNoKey = '.';

/// Length of the key that begins at a place of a text: 1, or that of an escape sequence, ESC [ … letter or ~.
std::size_t keyLength(const std::string& keys, std::size_t at) {
  if (keys[at] != kEscape || at + 1 >= keys.size() || (keys[at + 1] != '[' && keys[at + 1] != 'O')) return 1;
  for (std::size_t end = at + 2; end < keys.size(); ++end) {
    if (std::isalpha(static_cast<unsigned char>(keys[end])) || keys[end] == '~') return end + 1 - at;
  }
  return keys.size() - at;
}

/// All bytes until the end of the input.
std::string readAll(int descriptor) {
  std::string text;
  char buffer[4096];
  for (ssize_t count; (count = read(descriptor, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

}  // namespace

std::optional<char> TextKeys::next() {
  if (at_ == end_of_step_) return std::nullopt;
  const char byte = keys_[at_++];
  return byte == kNoKey ? std::nullopt : std::optional(byte);
}

void TextKeys::startStep() {
  at_ = end_of_step_;
  if (at_ < keys_.size()) end_of_step_ += keyLength(keys_, at_);
}

struct TerminalKeys::Settings {
  termios values;
};

TerminalKeys::TerminalKeys(int descriptor) : descriptor_(descriptor) {
  termios values;
  if (tcgetattr(descriptor, &values) != 0) {
    text_.emplace(readAll(descriptor));
    return;
  }
  former_ = std::make_unique<Settings>(Settings{values});
  values.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  values.c_cc[VMIN] = 0;
  values.c_cc[VTIME] = 0;
  tcsetattr(descriptor, TCSANOW, &values);
}

TerminalKeys::~TerminalKeys() {
  if (former_) tcsetattr(descriptor_, TCSANOW, &former_->values);
}

std::optional<char> TerminalKeys::next() {
  if (text_) return text_->next();
  char byte;
  if (read(descriptor_, &byte, 1) != 1) return std::nullopt;  // VMIN is 0: returns at once
  return byte;
}

void TerminalKeys::startStep() {
  if (text_) text_->startStep();
}

}  // namespace robosim
