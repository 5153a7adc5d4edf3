#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/async_stream.h>

#include "net/switchboard.h"
#include "net/wire_error.h"

namespace robosim {

/// Whose turn it is to speak on a stream.
enum class Turn {
  theirs,  ///< the peer is listened to at once
  /// The peer is listened to at once, but no more than a few times a millisecond. gRPC looks at no other connection as
  /// long as something has come already, so a peer that speaks without end would keep us from hearing anybody else.
  in_measure,
  /// The peer is listened to when our next message goes out. Then HTTP/2's acknowledgement of what it said travels with
  /// that, and not alone, which would cost a packet, and wake the peer for nothing. Nor can a peer flood us.
  ours,
};

/// The environment's end of a two-way stream. It keeps what gRPC demands, or else ends the process: one read and one
/// write at a time, none after the end, and an object that lives until gRPC has done with it. Whoever else holds a
/// stream may go on calling it after its end; nothing happens then.
///
/// gRPC's messages are bytes to us: it would only say that the stream has ended where a message cannot be read, and the
/// peer would never hear why.
template <typename In, typename Out>
class StreamCall : public std::enable_shared_from_this<StreamCall<In, Out>> {
 public:
  using Wire = grpc::ServerAsyncReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>;

  explicit StreamCall(Switchboard& switchboard) : presence_(switchboard) {}
  StreamCall(const StreamCall&) = delete;
  StreamCall& operator=(const StreamCall&) = delete;

  /// Waits for a client's call. Call once it is fully made, by make_shared.
  /// @param request is called with a ServerContext*, a Wire* and a tag, for a service's RequestX()
  template <typename Request>
  void await(const Request& request) {
    self_ = this->shared_from_this();
    context_.AsyncNotifyWhenDone(done_.tag());
    request(&context_, &wire_, called_.tag());
  }

  /// @name Sending
  /// Fill the draft, which stands as it was last left, then post it. It goes out once the write before it is done. A
  /// draft posted before that has not gone out yet is taken back.
  ///@{
  Out& draft() {
    posted_ = false;
    return draft_;
  }
  void post() {
    posted_ = true;
    writeNext();
  }
  ///@}

  /// Whether nothing is posted or being written.
  bool isIdle() const { return !posted_ && !writing_; }

  /// Ends the stream: what is posted still goes out if all is well. A peer that is too late may never take what is
  /// being written, and is cut off; any other is told the status after that, unless it takes nothing for a second.
  void end(const grpc::Status& status) {
    if (ending_) return;
    ending_ = true;
    status_ = {status.error_code(), fitForStatus(status.error_message())};
    if (!status.ok()) {
      posted_ = false;
      is_patient_ = true;
      ++pending_;
      patience_.Set(presence_.switchboard().queue(), std::chrono::system_clock::now() + kPatience,
                    patience_over_.tag());
    }
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && writing_) context_.TryCancel();
    writeNext();
  }

  const grpc::ServerContext& context() const { return context_; }
  const std::string& peer() const { return peer_; }  ///< who has called; also after the end
  /// The peer has given up, or is gone.
  bool isCancelled() const { return is_cancelled_; }

 protected:
  virtual ~StreamCall() = default;

  /// A client has called. It is listened to from now on.
  virtual void called() = 0;
  /// A message came.
  /// @throws WireError for one that makes no sense, and nothing else.
  virtual Turn received(const In&) = 0;
  /// The peer will say nothing more.
  virtual void heardAll() { end(grpc::Status::OK); }
  /// Hangs up on a peer that sent what makes no sense.
  virtual void refuse(const WireError&) = 0;
  /// The peer has hung up, or is lost. Followed by no other call.
  virtual void ended() = 0;

 private:
  using Event = EventOf<StreamCall>;

  void writeNext() {
    if (writing_ || finished_) return;
    if (posted_) {
      posted_ = false;
      writing_ = has_spoken_ = true;
      bool owns_bytes = false;
      bytes_written_.Clear();
      grpc::SerializationTraits<Out>::Serialize(draft_, &bytes_written_, &owns_bytes);
      ++pending_;
      wire_.Write(bytes_written_, written_.tag());
      if (std::exchange(is_read_held_, false)) read();
    } else if (ending_) {
      finished_ = true;
      ++pending_;
      wire_.Finish(status_, over_.tag());
    }
  }

  void read() {
    if (finished_) return;
    ++pending_;
    wire_.Read(&bytes_read_, read_.tag());
  }

  void onCalled(bool ok) {
    if (!ok) {  // nobody calls any more
      const auto last = std::move(self_);
      return;
    }
    ++pending_;  // for onDone()
    peer_ = context_.peer();
    called();
    read();
  }

  void onRead(bool ok) {
    if (ok) {
      hear();
    } else {
      heardAll();
    }
    settle();
  }

  void hear() {
    has_spoken_ = false;
    auto turn = Turn::theirs;
    try {
      if (!grpc::SerializationTraits<In>::Deserialize(&bytes_read_, &in_).ok()) {
        throw WireError("a message that is no " + in_.GetTypeName() + "; doc/protocol.md tells what is");
      }
      turn = received(in_);
    } catch (const WireError& error) {
      refuse(error);
    }
    if (turn == Turn::in_measure && isHasty()) {
      ++pending_;
      breath_.Set(presence_.switchboard().queue(), std::chrono::system_clock::now() + kBreath, breathed_.tag());
    } else if (turn == Turn::ours && !has_spoken_) {
      is_read_held_ = true;
    } else {
      read();
    }
  }

  void onWritten(bool ok) {
    writing_ = false;
    if (!ok) {  // the peer is gone: there is nobody to write to
      posted_ = false;
      ending_ = true;
    }
    writeNext();
    settle();
  }

  /// Whether the peer has spoken too often of late.
  bool isHasty() {
    const auto now = Switchboard::Clock::now();
    if (now - spoken_since_ >= kBreath) {
      spoken_since_ = now;
      spoken_ = 0;
    }
    return ++spoken_ >= kMostABreath;
  }

  void onBreathed(bool /*ok*/) {
    read();
    settle();
  }

  void onPatienceOver(bool ok) {
    if (ok) context_.TryCancel();
    settle();
  }

  /// The stream is at its end, or the connection has broken, or the peer has given up the call.
  void onDone(bool /*ok*/) {
    is_cancelled_ = context_.IsCancelled();
    if (is_cancelled_) end(grpc::Status::CANCELLED);
    settle();
  }

  void onOver(bool /*ok*/) {
    is_over_ = true;
    if (std::exchange(is_patient_, false)) patience_.Cancel();
    settle();
  }

  /// One thing less is pending.
  void settle() {
    if (--pending_ > 0 || !is_over_) return;
    ended();
    const auto last = std::move(self_);  // may be the last to hold this, and ends with this function
  }

  static constexpr std::chrono::seconds kPatience{1};
  static constexpr std::chrono::milliseconds kBreath{1};
  static constexpr int kMostABreath = 4;

  Switchboard::Presence presence_;
  std::shared_ptr<StreamCall> self_;
  grpc::ServerContext context_;
  std::string peer_;
  Wire wire_{&context_};
  grpc::Alarm patience_, breath_;
  Event called_{*this, &StreamCall::onCalled}, read_{*this, &StreamCall::onRead},
      written_{*this, &StreamCall::onWritten}, patience_over_{*this, &StreamCall::onPatienceOver},
      done_{*this, &StreamCall::onDone}, over_{*this, &StreamCall::onOver}, breathed_{*this, &StreamCall::onBreathed};
  grpc::ByteBuffer bytes_read_;
  In in_;
  Out draft_;
  grpc::ByteBuffer bytes_written_;
  Switchboard::Clock::time_point spoken_since_;
  int spoken_ = 0;       ///< messages that have come since then
  int pending_ = 0;      ///< what gRPC was asked to do and has not done
  bool posted_ = false;  ///< the draft is to be written next
  bool writing_ = false;
  bool has_spoken_ = false;    ///< a write has begun since the last message came
  bool is_read_held_ = false;  ///< the next message is to be read when the next write begins
  bool ending_ = false;
  bool finished_ = false;  ///< gRPC was told the end …
  bool is_over_ = false;   ///< … and has told it
  bool is_patient_ = false;
  bool is_cancelled_ = false;
  grpc::Status status_;
};

}  // namespace robosim
