#pragma once
#include <memory>

#include "net/connect.h"
#include "wire/viewed_run.h"

namespace robosim {

/// Client of the Viewing service: requests one frame at a time, so that the server never sends more than the caller
/// processes. Not thread-safe, except for the functions marked below.
class Viewer {
 public:
  /// Connects, and blocks until the complete state has been received.
  /// @throws ConnectionError when the server does not answer or refuses this viewer.
  explicit Viewer(const ConnectOptions& connect_options, const ReadingsSelection& selection = {});
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// The run as of the last frame received.
  const ViewedRun& run() const;

  /// Blocks until a step newer than run() exists, and receives the newest. If select() has changed the selection since
  /// the last frame, the current step is received again, with the readings now selected.
  /// @return false when the run is over, or after leave(); run() keeps the last step
  /// @throws ConnectionError when the server closes the connection, or it breaks.
  bool waitForFrame();
  /// Whether the last frame replaced the world.
  bool isNewWorld() const;

  /// @name Thread-safe, also during waitForFrame()
  ///@{
  void select(const ReadingsSelection& selection);  ///< robots whose readings the following frames contain
  void leave();  ///< ends the connection permanently, and a waitForFrame() that blocks
                 ///@}

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
