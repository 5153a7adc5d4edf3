#pragma once
#include <string>

#include <mrpt/obs/CObservationImage.h>

namespace robosim {

/// A picture that MRPT takes for its own CObservationImage, and serialises with the very bytes of a JPEG file. MRPT
/// itself would keep it uncompressed, or compress it anew: other bytes, a worse picture, and a millisecond each.
class JpegObservation : public mrpt::obs::CObservationImage {
 public:
  JpegObservation();

  std::string jpeg;

 protected:
  void serializeTo(mrpt::serialization::CArchive& out) const override;
};

/// The picture of an observation as a JPEG file. That of a file of its own comes as it is in there; one that lies in
/// the recording has been unpacked by MRPT, and is compressed anew.
/// @throws RecordingError when that file is not there, is not in the recording's folder of pictures (or below it), is
/// no
///         regular file, or is larger than 64 MiB; std::exception when there is no picture.
std::string jpegOf(const mrpt::obs::CObservationImage&);

}  // namespace robosim
