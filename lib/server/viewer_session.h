#pragma once
#include <memory>
#include <vector>

#include "net/stream_call.h"
#include "net/viewing.grpc.pb.h"
#include "server/camera_frame_cache.h"
#include "server/pending_handshakes.h"
#include "server/serving_state.h"

namespace robosim {

/// Server side of the Viewing service. A viewer requests each frame, and receives the newest step: the changes since
/// its previous frame, and the selected readings. A slow viewer skips frames and delays neither the run nor other
/// viewers.
///
/// All functions are called between steps.
class ViewerSession final : public wire::Viewing::WithRawMethod_Watch<wire::Viewing::Service> {
 public:
  explicit ViewerSession(ServingState& serving);
  ~ViewerSession() override;

  /// Starts to accept viewers.
  void open(const CompletionQueueServer::ServiceQueues& queues);
  /// Switches to the current ServingState::run_info: every viewer's next frame is complete.
  void reset();
  /// Disconnects the viewers whose token has been withdrawn or has expired.
  void checkAccess();
  /// Sends the current step to the viewers with a pending request, unless they have received it with the same readings.
  void publish();
  /// Ends all calls, because the run is over.
  void endAll();

  std::size_t count() const { return streams_.size(); }

 private:
  class Stream;
  void awaitViewer();
  void called(Stream& stream);
  void send(Stream& stream);
  void addPhotos(Stream& stream, wire::Frame& frame) const;

  ServingState& serving_;
  CompletionQueueServer::ServiceQueues queues_{};
  PendingHandshakes<Stream> handshakes_;
  std::vector<std::shared_ptr<Stream>> streams_;
  CameraFrameCache camera_frames_;
};

}  // namespace robosim
