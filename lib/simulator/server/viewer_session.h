#pragma once
#include <memory>
#include <vector>

#include "net/stream_session.h"
#include "robosim/v1/viewing.grpc.pb.h"
#include "server/camera_frame_cache.h"
#include "server/serving_state.h"

namespace robosim {

/// Server side of the Viewing service. A viewer requests each frame, and receives the newest step: the changes since
/// its previous frame, and the selected readings. A slow viewer skips frames and delays neither the run nor other
/// viewers.
///
/// All functions are called between steps.
class ViewerSession final : public v1::Viewing::WithRawMethod_Watch<v1::Viewing::Service> {
 public:
  explicit ViewerSession(ServingState& serving);
  ~ViewerSession() override;

  /// Starts to accept viewers.
  void open(const CompletionQueueServer::ServiceQueues& queues);
  /// Switches to the current ServingState::run_info: every viewer's next frame is complete.
  void reset();
  /// Sends the world again, with the robots that have been added to the run.
  void addRobots() { reset(); }
  /// Sends the current step to the viewers with a pending request, unless they have received it with the same readings.
  void publish();

  /// Sets the flags of robots whose pictures a viewer receives.
  void addPictured(std::vector<std::uint8_t>& robots) const;

  std::size_t count() const { return streams_.size(); }

 private:
  class Stream;
  void send(Stream& stream);
  /// Adds the newest pictures of the robots that the viewer has selected by index.
  /// @param repeats whether to add those that the viewer has received, too
  void addPictures(Stream& stream, v1::Frame& frame, bool repeats) const;

  ServingState& serving_;
  std::vector<std::shared_ptr<Stream>> streams_;  ///< established
  CameraFrameCache camera_frames_;
};

}  // namespace robosim
