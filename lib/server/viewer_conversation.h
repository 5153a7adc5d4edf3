#pragma once
#include <memory>
#include <vector>

#include "net/server_stream.h"
#include "net/viewing.grpc.pb.h"
#include "server/lobby.h"

namespace robosim {

/// The conversation with viewers: each asks for a frame when it wants one, and is sent the newest step: as what changed
/// since the frame before, and the readings that it wished for. A slow one misses frames and delays nobody.
///
/// Except for Watch(), all is called by the thread that steps the environment, between steps.
class ViewerConversation final : public wire::Viewing::WithRawCallbackMethod_Watch<wire::Viewing::Service> {
 public:
  explicit ViewerConversation(Lobby& lobby);
  ~ViewerConversation() override;

  /// gRPC calls this when a viewer connects.
  RawStream* Watch(grpc::CallbackServerContext*) override;

  /// Another world is shown from now on: every viewer's next frame is a whole one.
  /// Call with the lobby's mutex held, so that nobody meets one world's list with the other.
  void show();
  /// Sends the step that stands to whoever asks and has not seen it, or not with those readings.
  void tell();
  /// The run is over.
  void sayGoodbye();

  std::size_t count() const;

 private:
  class Stream;
  void send(Stream& stream);

  Lobby& lobby_;
  std::vector<std::shared_ptr<Stream>> streams_;  ///< with the lobby's mutex held
  std::vector<std::shared_ptr<Stream>> asking_;   ///< working memory of tell()
};

}  // namespace robosim
