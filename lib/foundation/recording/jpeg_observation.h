#pragma once
#include <filesystem>
#include <string>

#include <mrpt/obs/CObservationImage.h>

namespace robosim {

/// A CObservationImage that is serialised with the bytes of an existing JPEG file. MRPT itself would store the image
/// uncompressed or compress it again, with different bytes, a loss of quality, and about 1 ms per image.
class JpegObservation : public mrpt::obs::CObservationImage {
 public:
  JpegObservation();

  std::string jpeg;

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override;
};

/// The image of an observation as a JPEG file. That of a JpegObservation and an external image file are returned
/// unchanged; another embedded image has been decompressed, and is compressed again.
/// @param pictures the recording's folder of images
/// @throws RecordingError when the file does not exist, is not in this folder or below it (links are followed only
///         within it), is not a regular file, or is larger than 64 MiB; std::exception when there is no image.
std::string extractJpeg(const mrpt::obs::CObservationImage&, const std::filesystem::path& pictures);
/// The same. @throws RecordingError also when an external file is damaged or not a JPEG file
std::string extractCheckedJpeg(const mrpt::obs::CObservationImage&, const std::filesystem::path& pictures);

}  // namespace robosim
