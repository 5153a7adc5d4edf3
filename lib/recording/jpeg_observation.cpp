#include "recording/jpeg_observation.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <mrpt/io/CMemoryStream.h>

#include "recording/byte_archive.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

/// A picture of no meaning, in whose place ours is put.
struct Placeholder {
  mrpt::img::CImage picture{8, 8, mrpt::img::CH_RGB};
  std::vector<std::uint8_t> jpeg;

  Placeholder() {
    mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);  // MRPT keeps pictures as they are unless it is told
    picture.filledRectangle(0, 0, 7, 7, mrpt::img::TColor(10, 120, 240));
    mrpt::io::CMemoryStream stream;
    picture.saveToStreamAsJPEG(stream, mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY());
    const auto* bytes = static_cast<const std::uint8_t*>(stream.getRawBufferData());
    jpeg.assign(bytes, bytes + stream.getTotalBytesCount());
  }
};

const Placeholder& placeholder() {
  static const Placeholder only;
  return only;
}

/// The observation's bytes as MRPT writes them.
class Unchanged : public mrpt::obs::CObservationImage {
 public:
  explicit Unchanged(const mrpt::obs::CObservationImage& observation) : CObservationImage(observation) {}
  std::vector<std::uint8_t> bytes() const {
    ByteArchive archive;
    serializeTo(archive);
    return std::move(archive.bytes);
  }
};

/// The file beside the recording that a picture lies in, which may be named by a stranger.
std::string fileOf(const mrpt::img::CImage& image) {
  namespace fs = std::filesystem;
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;
  const fs::path name = image.getExternalStorageFile();
  if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) {
    throw RecordingError(name.string() + ": is no picture of the recording's own folder; it is not opened");
  }
  const fs::path path = fs::path(mrpt::img::CImage::getImagesPathBase()) / name;
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw RecordingError(path.string() + ": is no file, let alone a picture");
  }
  const auto size = fs::file_size(path, error);
  if (!error && size > kMostBytes) throw RecordingError(path.string() + ": is larger than 64 MiB, so it is no picture");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw RecordingError(path.string() + ": cannot be read; is the folder of pictures beside the recording?");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

JpegObservation::JpegObservation() { image = placeholder().picture; }

void JpegObservation::serializeTo(mrpt::serialization::CArchive& out) const {
  if (image.isExternallyStored()) return CObservationImage::serializeTo(out);
  const auto bytes = Unchanged(*this).bytes();
  const auto& replaced = placeholder().jpeg;
  const auto at = std::search(bytes.begin(), bytes.end(), replaced.begin(), replaced.end());
  std::uint32_t size = 0;
  const auto before = at - bytes.begin() - static_cast<std::ptrdiff_t>(sizeof size);
  if (at != bytes.end() && before >= 0) std::memcpy(&size, &bytes[static_cast<std::size_t>(before)], sizeof size);
  if (size != replaced.size()) {
    throw RecordingError("this version of MRPT keeps pictures in a way that is unknown here; record them as files");
  }
  out.WriteBuffer(bytes.data(), static_cast<std::size_t>(before));
  out << static_cast<std::uint32_t>(jpeg.size());
  out.WriteBuffer(jpeg.data(), jpeg.size());
  const auto after = static_cast<std::size_t>(before) + sizeof size + replaced.size();
  out.WriteBuffer(bytes.data() + after, bytes.size() - after);
}

std::string jpegOf(const mrpt::obs::CObservationImage& observation) {
  if (observation.image.isExternallyStored()) return fileOf(observation.image);
  mrpt::io::CMemoryStream stream;
  observation.image.saveToStreamAsJPEG(stream);
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

}  // namespace robosim
