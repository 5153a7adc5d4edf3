#include "base/jpeg_file.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>

// libjpeg's headers need <cstdio>.
#include <jerror.h>
#include <jpeglib.h>

namespace robosim {
namespace {

constexpr long kMaxDecoderBytes = 256L << 20;
constexpr int kMaxScans = 100;

/// A decoder that C code reaches through jpeg_common_struct::client_data.
struct Decoder {
  explicit Decoder(std::string_view bytes) : file(bytes) {
    jpeg.err = jpeg_std_error(&errors);
    jpeg.client_data = this;
  }
  ~Decoder() { jpeg_destroy_decompress(&jpeg); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  std::string_view file;
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf on_error{};
  char fault[JMSG_LENGTH_MAX] = "";
};

Decoder& decoderOf(j_common_ptr jpeg) { return *static_cast<Decoder*>(jpeg->client_data); }

[[noreturn]] void fail(j_common_ptr jpeg) {
  Decoder& decoder = decoderOf(jpeg);
  jpeg->err->format_message(jpeg, decoder.fault);
  std::longjmp(decoder.on_error, 1);
}

void onMessage(j_common_ptr jpeg, int level) {
  if (level >= 0) return;  // trace messages
  const int code = jpeg->err->msg_code;
  const bool is_harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM;
  if (!is_harmless) fail(jpeg);
}

void printNothing(j_common_ptr) {}

void onProgress(j_common_ptr jpeg) {
  Decoder& decoder = decoderOf(jpeg);
  if (decoder.jpeg.input_scan_number <= kMaxScans) return;
  std::snprintf(decoder.fault, sizeof decoder.fault, "it has more than %d scans", kMaxScans);
  std::longjmp(decoder.on_error, 1);
}

void readHeader(Decoder& decoder) {
  decoder.errors.error_exit = fail;
  decoder.errors.emit_message = onMessage;
  decoder.errors.output_message = printNothing;
  jpeg_create_decompress(&decoder.jpeg);
  decoder.jpeg.mem->max_memory_to_use = kMaxDecoderBytes;
  decoder.progress.progress_monitor = onProgress;
  decoder.jpeg.progress = &decoder.progress;
  jpeg_mem_src(&decoder.jpeg, reinterpret_cast<const unsigned char*>(decoder.file.data()), decoder.file.size());
  jpeg_read_header(&decoder.jpeg, TRUE);
}

/// @param picture null: the pixels are decoded and dropped
void readPixels(Decoder& decoder, JpegPicture* picture) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_calc_output_dimensions(&jpeg);
  const std::size_t row_bytes = std::size_t{jpeg.output_width} * static_cast<std::size_t>(jpeg.output_components);
  if (picture) {
    if (row_bytes * jpeg.output_height > std::size_t{kMaxDecoderBytes}) ERREXIT1(&jpeg, JERR_OUT_OF_MEMORY, 0);
    picture->channels = static_cast<std::uint32_t>(jpeg.output_components);
    picture->values.resize(row_bytes * jpeg.output_height);  // longjmp() does not skip its destructor
  }
  jpeg_start_decompress(&jpeg);
  JSAMPARRAY dropped = (*jpeg.mem->alloc_sarray)(reinterpret_cast<j_common_ptr>(&jpeg), JPOOL_IMAGE,
                                                 static_cast<JDIMENSION>(row_bytes), 1);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW to = picture ? picture->values.data() + row_bytes * jpeg.output_scanline : dropped[0];
    jpeg_read_scanlines(&jpeg, &to, 1);
  }
  jpeg_finish_decompress(&jpeg);
}

/// Calls a function that may fail by longjmp(). No object with a destructor lives in the frames that it skips.
/// @returns whether it succeeded; otherwise decoder.fault has the reason
template <typename Function>
bool succeeds(Decoder& decoder, const Function& function) {
  if (setjmp(decoder.on_error) != 0) return false;
  function();
  return true;
}

}  // namespace

std::string jpegFault(std::string_view file) {
  Decoder decoder(file);
  const auto decode = [&decoder] {
    readHeader(decoder);
    readPixels(decoder, nullptr);
  };
  return succeeds(decoder, decode) ? "" : decoder.fault;
}

JpegSize jpegSize(std::string_view file) {
  Decoder decoder(file);
  if (!succeeds(decoder, [&decoder] { readHeader(decoder); })) return {};
  return {decoder.jpeg.image_width, decoder.jpeg.image_height};
}

JpegPicture decodeJpeg(std::string_view file, std::string& fault) {
  Decoder decoder(file);
  JpegPicture picture;
  const auto decode = [&decoder, &picture] {
    readHeader(decoder);
    readPixels(decoder, &picture);
  };
  if (!succeeds(decoder, decode)) {
    fault = decoder.fault;
    return {};
  }
  picture.columns = decoder.jpeg.image_width;
  picture.rows = decoder.jpeg.image_height;
  fault.clear();
  return picture;
}

std::string encodeJpeg(const JpegPicture& picture, int quality) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};  // the default handler: valid arguments cause no error but a lack of memory
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = picture.columns;
  jpeg.image_height = picture.rows;
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    // libjpeg's interface has no const; it does not write to the row.
    auto* row = const_cast<JSAMPROW>(picture.values.data() + std::size_t{3} * picture.columns * jpeg.next_scanline);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const std::unique_ptr<unsigned char, void (*)(void*)> owned(bytes, std::free);
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace robosim
