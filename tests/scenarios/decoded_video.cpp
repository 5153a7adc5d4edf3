#include "tests/scenarios/decoded_video.h"

#include <memory>
#include <stdexcept>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace robosim {
namespace {

/// Calls FFmpeg's function to free an object, which takes its address.
template <auto kFree>
struct Freed {
  template <typename Object>
  void operator()(Object* object) const {
    kFree(&object);
  }
};

cv::Mat bgrOf(const AVFrame& frame) {
  cv::Mat bgr(frame.height, frame.width, CV_8UC3);
  SwsContext* const conversion =
      sws_getContext(frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width, frame.height,
                     AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr);
  std::uint8_t* const rows[] = {bgr.data};
  const int row_bytes[] = {static_cast<int>(bgr.step[0])};
  sws_scale(conversion, frame.data, frame.linesize, 0, frame.height, rows, row_bytes);
  sws_freeContext(conversion);
  return bgr;
}

}  // namespace

DecodedVideo decodeVideo(const std::filesystem::path& file) {
  const auto require = [&](bool succeeded) {
    if (!succeeded) throw std::runtime_error(file.string() + ": is no complete video");
  };
  AVFormatContext* opened = nullptr;
  require(avformat_open_input(&opened, file.c_str(), nullptr, nullptr) == 0);
  const std::unique_ptr<AVFormatContext, Freed<avformat_close_input>> container(opened);
  require(avformat_find_stream_info(opened, nullptr) >= 0);
  const int number = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  require(number >= 0);
  const AVStream& stream = *opened->streams[number];
  const AVCodec* const codec = avcodec_find_decoder(stream.codecpar->codec_id);
  require(codec != nullptr);
  const std::unique_ptr<AVCodecContext, Freed<avcodec_free_context>> decoder(avcodec_alloc_context3(codec));
  require(avcodec_parameters_to_context(decoder.get(), stream.codecpar) >= 0);
  require(avcodec_open2(decoder.get(), codec, nullptr) == 0);

  DecodedVideo video{.codec = avcodec_get_name(stream.codecpar->codec_id),
                     .pixel_format = {},
                     .size = {stream.codecpar->width, stream.codecpar->height},
                     .fps = av_q2d(stream.avg_frame_rate),
                     .frames = {}};
  const std::unique_ptr<AVPacket, Freed<av_packet_free>> packet(av_packet_alloc());
  const std::unique_ptr<AVFrame, Freed<av_frame_free>> frame(av_frame_alloc());
  const auto receive = [&] {
    while (avcodec_receive_frame(decoder.get(), frame.get()) == 0) {
      video.pixel_format = av_get_pix_fmt_name(static_cast<AVPixelFormat>(frame->format));
      video.frames.push_back(bgrOf(*frame));
    }
  };
  while (av_read_frame(opened, packet.get()) == 0) {
    if (packet->stream_index == number) {
      require(avcodec_send_packet(decoder.get(), packet.get()) == 0);
      receive();
    }
    av_packet_unref(packet.get());
  }
  avcodec_send_packet(decoder.get(), nullptr);  // the end
  receive();
  return video;
}

}  // namespace robosim
