#pragma once

namespace robosim {

/// While one of these lives, Ctrl-C (SIGINT) and SIGTERM ask for a clean end instead of killing the program. A second
/// one kills it, as always. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const;
};

}  // namespace robosim
