#pragma once
#include <memory>
#include <vector>

#include "net/stream_call.h"
#include "net/viewing.grpc.pb.h"
#include "server/lobby.h"
#include "server/photo_album.h"

namespace robosim {

/// The conversation with viewers: each asks for a frame when it wants one, and is sent the newest step: as what changed
/// since the frame before, and the readings that it wished for. A slow one misses frames and delays nobody.
///
/// Everything is called between steps.
class ViewerConversation final : public wire::Viewing::WithRawMethod_Watch<wire::Viewing::Service> {
 public:
  explicit ViewerConversation(Lobby& lobby);
  ~ViewerConversation() override;

  /// Lets viewers come in.
  void open(const Switchboard::Line& line);
  /// Another world is shown from now on: every viewer's next frame is a whole one.
  void show();
  /// Sends the step that stands to whoever asks and has not seen it, or not with those readings.
  void tell();
  /// The run is over.
  void sayGoodbye();

  std::size_t count() const { return streams_.size(); }

 private:
  class Stream;
  void awaitViewer();
  void called(Stream& stream);
  void send(Stream& stream);
  void addPhotos(Stream& stream, wire::Frame& frame) const;

  Lobby& lobby_;
  Switchboard::Line line_{};
  std::vector<std::shared_ptr<Stream>> streams_;
  PhotoAlbum album_;
};

}  // namespace robosim
