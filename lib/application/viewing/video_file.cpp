#include "viewing/video_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include "base/error_list.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr double kKeyFramePeriod_s = 2;

std::string videoEndingOf(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// A kind of video: FFmpeg's names of its format and encoder.
struct VideoKind {
  const char* ending;
  const char* format;
  const char* encoder;
};

constexpr VideoKind kVideoKinds[] = {
    {".mp4", "mp4", "libx264"}, {".webm", "webm", "libvpx-vp9"}, {".webp", "webp", "libwebp_anim"}};

/// nullptr for a file that is no video
const VideoKind* findVideoKind(const fs::path& file) {
  const std::string ending = videoEndingOf(file);
  const auto* const found = std::find_if(std::begin(kVideoKinds), std::end(kVideoKinds),
                                         [&](const auto& kind) { return ending == kind.ending; });
  return found == std::end(kVideoKinds) ? nullptr : found;
}

std::string avErrorText(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(error, text, sizeof text);
  return text;
}

/// Releases FFmpeg's objects.
struct AvDeleter {
  void operator()(AVFormatContext* format) const {
    if (format->pb) avio_closep(&format->pb);
    avformat_free_context(format);
  }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};
template <typename T>
using AvPtr = std::unique_ptr<T, AvDeleter>;

template <typename T>
AvPtr<T> owned(T* object) {
  if (!object) throw std::bad_alloc();
  return AvPtr<T>(object);
}

}  // namespace

bool isVideo(const fs::path& file) { return findVideoKind(file) != nullptr; }

/// FFmpeg's objects for one video.
struct VideoFile::Encoder {
  Encoder(const fs::path& named, const fs::path& part, int width_px, int height_px, double fps) : named_file(named) {
    av_log_set_level(AV_LOG_QUIET);  // errors are reported here
    const VideoKind& kind = *findVideoKind(named);
    const AVCodec* const codec = avcodec_find_encoder_by_name(kind.encoder);
    if (!codec) {
      throw ConfigError(named.string() + ": FFmpeg's library libavcodec has no encoder " + kind.encoder +
                        "; install Debian's full build of FFmpeg (apt-get install ffmpeg), or write another of .mp4, "
                        ".webm and .webp");
    }
    AVFormatContext* opened = nullptr;
    // "file:", so that a colon in the name does not start a protocol.
    avformat_alloc_output_context2(&opened, nullptr, kind.format, ("file:" + part.string()).c_str());
    format = owned(opened);
    stream = avformat_new_stream(format.get(), nullptr);
    if (!stream) throw std::bad_alloc();
    context = owned(avcodec_alloc_context3(codec));
    packet = owned(av_packet_alloc());
    setOptions(codec->id, width_px, height_px, fps);
    checkEncoding(avcodec_open2(context.get(), codec, nullptr));
    checkEncoding(avcodec_parameters_from_context(stream->codecpar, context.get()));
    stream->time_base = context->time_base;
    stream->avg_frame_rate = context->framerate;
    makeFrame();
    checkWriting(avio_open(&format->pb, format->url, AVIO_FLAG_WRITE));
    AVDictionary* options = nullptr;
    if (codec->id == AV_CODEC_ID_H264) av_dict_set(&options, "movflags", "+faststart", 0);
    if (codec->id == AV_CODEC_ID_WEBP) av_dict_set(&options, "loop", "0", 0);  // repeats for ever
    const int begun = avformat_write_header(format.get(), &options);
    av_dict_free(&options);
    checkEncoding(begun);
    checkWriting(format->pb->error);
  }

  void setOptions(AVCodecID codec, int width_px, int height_px, double fps) {
    context->width = width_px & ~1;
    context->height = height_px & ~1;
    context->pix_fmt = AV_PIX_FMT_YUV420P;
    context->framerate = av_d2q(fps, 1'000'000);
    context->time_base = av_inv_q(context->framerate);
    context->gop_size = std::max(1, static_cast<int>(std::lround(kKeyFramePeriod_s * fps)));
    context->thread_count = 1;  // the number of threads changes the bytes
    context->color_range = AVCOL_RANGE_MPEG;
    context->colorspace = AVCOL_SPC_BT709;
    context->color_primaries = AVCOL_PRI_BT709;
    context->color_trc = AVCOL_TRC_BT709;
    // No versions and random identifiers in the file.
    context->flags |= AV_CODEC_FLAG_BITEXACT;
    format->flags |= AVFMT_FLAG_BITEXACT;
    if (format->oformat->flags & AVFMT_GLOBALHEADER) context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    const auto set = [this](const char* option, const char* value) {
      checkEncoding(av_opt_set(context->priv_data, option, value, 0));
    };
    // Constant quality, at which thin lines and small text stay sharp.
    if (codec == AV_CODEC_ID_WEBP) {
      context->pix_fmt = AV_PIX_FMT_RGB32;  // the library converts to its own colour space
      set("quality", "80");
      return;
    }
    set("crf", codec == AV_CODEC_ID_VP9 ? "24" : "18");
    if (codec == AV_CODEC_ID_VP9) {
      context->bit_rate = 0;
      set("deadline", "good");
      set("cpu-used", "5");
    } else {
      set("preset", "fast");
    }
  }

  void makeFrame() {
    frame = owned(av_frame_alloc());
    frame->format = context->pix_fmt;
    frame->width = context->width;
    frame->height = context->height;
    frame->pts = 0;
    checkEncoding(av_frame_get_buffer(frame.get(), 0));
    scaler = owned(sws_getContext(frame->width, frame->height, AV_PIX_FMT_BGR24, frame->width, frame->height,
                                  context->pix_fmt, SWS_BICUBIC | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr,
                                  nullptr, nullptr));
    const int* const matrix = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler.get(), matrix, 1, matrix, 0, 0, 1 << 16, 1 << 16);
  }

  /// @param next null: the end
  void encode(const AVFrame* next) {
    checkEncoding(avcodec_send_frame(context.get(), next));
    for (;;) {
      const int received = avcodec_receive_packet(context.get(), packet.get());
      if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) break;
      checkEncoding(received);
      packet->stream_index = stream->index;
      packet->duration = 1;
      av_packet_rescale_ts(packet.get(), context->time_base, stream->time_base);
      checkWriting(av_interleaved_write_frame(format.get(), packet.get()));
    }
    checkWriting(format->pb->error);
  }

  void finish() {
    encode(nullptr);
    checkWriting(av_write_trailer(format.get()));
    avio_flush(format->pb);
    checkWriting(format->pb->error);
    checkWriting(avio_closep(&format->pb));
  }

  /// Reports an error of the encoder, FFmpeg's negative code.
  void checkEncoding(int result) const {
    if (result >= 0) return;
    throw std::runtime_error(named_file.string() + ": the video could not be encoded (" + avErrorText(result) +
                             "); choose another size or frame rate");
  }

  /// Reports an error of the file, FFmpeg's negative code.
  void checkWriting(int result) const {
    if (result >= 0) return;
    throw std::runtime_error(named_file.string() + ": the video could not be written (" + avErrorText(result) +
                             "); free disk space, or choose another place");
  }

  fs::path named_file;
  AvPtr<AVFormatContext> format;
  AVStream* stream = nullptr;  ///< of format
  AvPtr<AVCodecContext> context;
  AvPtr<AVPacket> packet;
  AvPtr<AVFrame> frame;
  AvPtr<SwsContext> scaler;
};

VideoFile::VideoFile(const fs::path& file, int width_px, int height_px, double fps)
    : file_(file),
      encoder_(std::make_unique<Encoder>(file, file_.path().string() + ".part", width_px, height_px, fps)) {}

VideoFile::~VideoFile() = default;

void VideoFile::add(const cv::Mat& picture) {
  Encoder& e = *encoder_;
  e.checkEncoding(av_frame_make_writable(e.frame.get()));
  const std::uint8_t* const rows[] = {picture.data};
  const int strides[] = {static_cast<int>(picture.step[0])};
  sws_scale(e.scaler.get(), rows, strides, 0, e.frame->height, e.frame->data, e.frame->linesize);
  e.encode(e.frame.get());
  ++e.frame->pts;
}

void VideoFile::commit() {
  encoder_->finish();
  file_.commit();
}

}  // namespace robosim
