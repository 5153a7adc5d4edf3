#include "client/viewer.h"

#include <mutex>

#include "net/client_stream.h"
#include "net/wire_error.h"
#include "robosim/v1/viewing.grpc.pb.h"

namespace robosim {

struct Viewer::Impl {
  using Stream = ClientStream<v1::FrameRequest, v1::Frame>;

  ConnectOptions connect_options;
  std::unique_ptr<v1::Viewing::Stub> stub;
  Stream stream;
  v1::Frame frame;
  ViewedRun run;
  bool is_new_world = false;

  std::mutex mutex;  ///< guards the members below, and writes to the stream
  v1::FrameRequest request;
  bool is_frame_due = false, is_selection_due = false;  ///< to be requested
  bool has_ended = false;

  Impl(const ConnectOptions& options, const ReadingsSelection& selection)
      : connect_options(options),
        stub(v1::Viewing::NewStub(connect(options))),
        stream(options, [this](auto... arguments) { return stub->AsyncWatch(arguments...); }) {
    stream.setAdaptivePolling(false);
    stream.open();
    request.set_protocol(kProtocolVersion);
    encode(selection, request);
    if (!waitForFrame()) throw ConnectionError({grpc::StatusCode::UNAVAILABLE, "the run is over"}, connect_options);
    if (!is_new_world) throw WireError("the environment's first frame has no world");
  }

  bool waitForFrame() {
    if (!stream.isOpen()) return false;
    {
      const std::lock_guard lock(mutex);
      is_frame_due = true;
      sendNext();
    }
    for (;;) {
      const auto event = stream.next(frame);
      if (event == Stream::Event::received) break;
      const std::lock_guard lock(mutex);
      if (event == Stream::Event::ended) {
        finish();
        return false;
      }
      sendNext();
    }
    is_new_world = update(run, frame);
    return true;
  }

  /// @pre holds the mutex
  void finish() {
    has_ended = true;
    const grpc::Status status = stream.finish();
    if (!status.ok() && !stream.isCancelled()) throw ConnectionError(status, connect_options);
  }

  /// Writes the next request, unless another is being written. @pre holds the mutex
  void sendNext() {
    if (has_ended || stream.isWriting() || !(is_frame_due || is_selection_due)) return;
    request.set_amends(!is_frame_due);
    is_frame_due = is_selection_due = false;
    stream.write(request);  // for a broken stream, finish() returns the reason
  }

  void select(const ReadingsSelection& selection) {
    const std::lock_guard lock(mutex);
    encode(selection, request);
    is_selection_due = true;
    sendNext();
  }
};

Viewer::Viewer(const ConnectOptions& connect_options, const ReadingsSelection& selection)
    : impl_(std::make_unique<Impl>(connect_options, selection)) {}
Viewer::~Viewer() = default;
const ViewedRun& Viewer::run() const { return impl_->run; }
bool Viewer::waitForFrame() { return impl_->waitForFrame(); }
bool Viewer::isNewWorld() const { return impl_->is_new_world; }
void Viewer::select(const ReadingsSelection& selection) { impl_->select(selection); }
void Viewer::leave() { impl_->stream.cancel(); }

}  // namespace robosim
