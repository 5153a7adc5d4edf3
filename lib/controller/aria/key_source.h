#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace robosim {

/// Source of key strokes: a terminal, or a text in tests and scripts.
class KeySource {
 public:
  virtual ~KeySource() = default;
  /// The next byte that was typed; nullopt when there is none now. Does not block. Special keys are several bytes, as
  /// terminals send them: ESC [ A for the arrow up.
  virtual std::optional<char> next() = 0;
  /// Called once per time step, before the bytes of the step are read.
  virtual void startStep() {}
};

/// Keys of a text, one per time step, so that a run with them is reproducible. A '.' is a step without a key, and an
/// escape sequence is one key.
class TextKeys : public KeySource {
 public:
  explicit TextKeys(std::string keys) : keys_(std::move(keys)) {}
  std::optional<char> next() override;
  void startStep() override;

 private:
  std::string keys_;
  std::size_t at_ = 0, end_of_step_ = 0;
};

/// Keys of a terminal, which it switches to raw input without echo until it is destroyed; signals such as Ctrl-C work
/// as before. Input that is no terminal, a pipe or a file, is
/// read to its end at once, and gives one key per time step, as TextKeys does.
class TerminalKeys : public KeySource {
 public:
  /// @param descriptor to read from
  explicit TerminalKeys(int descriptor = 0);
  ~TerminalKeys() override;
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;
  std::optional<char> next() override;
  void startStep() override;

 private:
  struct Settings;
  int descriptor_;
  std::unique_ptr<Settings> former_;  ///< settings of the terminal; null for input that is none
  std::optional<TextKeys> text_;
};

}  // namespace robosim
