#include "recording/jpeg_observation.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <mrpt/io/CMemoryStream.h>

#include "base/jpeg_file.h"
#include "recording/byte_archive.h"
#include "recording/picture_compression.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Placeholder image, which is replaced by the JPEG file.
struct Placeholder {
  mrpt::img::CImage picture{8, 8, mrpt::img::CH_RGB};
  std::vector<std::uint8_t> jpeg;

  Placeholder() {
    picture.filledRectangle(0, 0, 7, 7, mrpt::img::TColor(10, 120, 240));
    mrpt::io::CMemoryStream stream;
    picture.saveToStreamAsJPEG(stream, mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY());
    const auto* bytes = static_cast<const std::uint8_t*>(stream.getRawBufferData());
    jpeg.assign(bytes, bytes + stream.getTotalBytesCount());
  }
};

const Placeholder& placeholder() {
  static const Placeholder instance;
  return instance;
}

/// The observation as serialised by MRPT.
class SerializableImage : public mrpt::obs::CObservationImage {
 public:
  explicit SerializableImage(const mrpt::obs::CObservationImage& observation) : CObservationImage(observation) {}
  std::vector<std::uint8_t> bytes() const {
    const PictureCompression on(true);
    ByteArchive archive;
    serializeTo(archive);
    return std::move(archive.bytes);
  }
};

constexpr std::uintmax_t kMaxImageBytes = std::uintmax_t{64} << 20;

[[noreturn]] void refuseOutside(const fs::path& name) {
  throw RecordingError(name.string() + ": is outside the recording's folder of images; it is not opened");
}

/// Reads an external image file. Its name comes from the recording, which is untrusted input.
std::string fileOf(const mrpt::img::CImage& image, const fs::path& pictures) {
  const fs::path name = image.getExternalStorageFile();
  if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) refuseOutside(name);
  const fs::path path = pictures / name;
  const auto cannotBeRead = [&]() -> std::string {
    return path.string() + ": cannot be read; is the folder of pictures beside the recording?";
  };
  std::error_code error;
  const fs::path folder = fs::canonical(pictures, error);
  if (error) throw RecordingError(cannotBeRead());
  const fs::path target = fs::canonical(path, error);
  if (error) throw RecordingError(cannotBeRead());
  if (std::mismatch(folder.begin(), folder.end(), target.begin(), target.end()).first != folder.end()) {
    refuseOutside(name);
  }
  if (!fs::is_regular_file(target, error)) throw RecordingError(path.string() + ": is not a regular file");
  if (fs::file_size(target, error) > kMaxImageBytes && !error) {
    throw RecordingError(path.string() + ": is larger than 64 MiB, so it is no picture");
  }
  std::ifstream file(target, std::ios::binary);
  if (!file) throw RecordingError(cannotBeRead());
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

JpegObservation::JpegObservation() { image = placeholder().picture; }

void JpegObservation::serializeTo(mrpt::serialization::CArchive& out) const {
  if (image.isExternallyStored()) return CObservationImage::serializeTo(out);
  const auto bytes = SerializableImage(*this).bytes();
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

std::string extractJpeg(const mrpt::obs::CObservationImage& observation, const fs::path& pictures) {
  const auto* const with_file = dynamic_cast<const JpegObservation*>(&observation);
  if (with_file && !with_file->jpeg.empty()) return with_file->jpeg;
  if (observation.image.isExternallyStored()) return fileOf(observation.image, pictures);
  mrpt::io::CMemoryStream stream;
  observation.image.saveToStreamAsJPEG(stream);
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

std::string extractCheckedJpeg(const mrpt::obs::CObservationImage& observation, const fs::path& pictures) {
  std::string jpeg = extractJpeg(observation, pictures);
  if (!observation.image.isExternallyStored()) return jpeg;  // decoded before
  if (const std::string fault = jpegFault(jpeg); !fault.empty()) {
    throw RecordingError((pictures / observation.image.getExternalStorageFile()).string() +
                         ": is a damaged JPEG file, or none: " + fault);
  }
  return jpeg;
}

}  // namespace robosim
