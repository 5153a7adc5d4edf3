#pragma once
#include <memory>

#include "net/dial.h"
#include "server/sight.h"

namespace robosim {

/// A viewer's end of the connection: asks for a frame whenever its owner wants one, and so never gets more than it can
/// take. Used by one thread, except for what says otherwise.
class Viewer {
 public:
  /// Connects, and waits for the whole state.
  /// @throws ConnectionError when nobody answers, or the environment will not have this viewer.
  explicit Viewer(const DialOptions& dial_options, const ReadingsWish& wish = {});
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  const Sight& sight() const;

  /// Waits for a step newer than the one in sight, and takes the newest. If want() has changed the wish meanwhile, the
  /// step in sight comes once more, with the readings now wished for.
  /// @return false when the run is over, or after leave(); the last step remains in sight
  /// @throws ConnectionError when the environment hangs up, or is gone.
  bool look();
  /// Whether the last look showed another world.
  bool isOtherWorld() const;

  /// @name From any thread, also while another is in look()
  ///@{
  void want(const ReadingsWish& wish);  ///< whose readings there are from now on
  void leave();                         ///< for good: ends a look() that waits
                                        ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
