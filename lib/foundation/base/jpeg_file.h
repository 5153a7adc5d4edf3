#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// A decoded JPEG picture.
struct JpegPicture {
  std::uint32_t columns = 0, rows = 0;
  std::uint32_t channels = 1;        ///< 1: gray; 3: red, green, blue
  std::vector<std::uint8_t> values;  ///< row by row from the top
};

/// @name JPEG files as untrusted input
/// Decoded by libjpeg with an error handler that reports faults as text. libjpeg's default handler, which MRPT uses,
/// ends the process, so that every JPEG file of another program is checked here before MRPT decodes it.
///
/// A fault is missing or damaged data, also where libjpeg would go on with a warning and gray pixels; a picture that
/// needs more than 256 MiB to decode; or one of more than 100 scans, which would take minutes. Superfluous bytes
/// between two segments, as some cameras write them, are none.
///@{

/// The reason why a JPEG file cannot be decoded, in libjpeg's words; empty for a valid file.
std::string jpegFault(std::string_view file);

/// The size of a JPEG picture by its header, without decoding it; both 0 for a file without a valid header.
struct JpegSize {
  std::uint32_t columns = 0, rows = 0;
};
JpegSize jpegSize(std::string_view file);

/// Decodes a JPEG file. @param[out] fault as jpegFault(); the picture is empty unless it is
JpegPicture decodeJpeg(std::string_view file, std::string& fault);
///@}

/// A JPEG file of a picture. @pre it has pixels and 3 channels @param quality [1, 100]
std::string encodeJpeg(const JpegPicture& picture, int quality);

}  // namespace robosim
