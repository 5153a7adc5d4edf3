#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

namespace robosim {

/// Checks the pictures in a rawlog before MRPT decodes them. MRPT decodes JPEG files with libjpeg's default error
/// handler, which ends the process, and copies raw pixels without comparing their number with the picture's size.
///
/// It follows the reads of MRPT's archive: after the name of the class CImage it expects the fields of a picture, as
/// CImage::serializeFrom() of MRPT 0.6 to 2.5 reads them. A damaged JPEG file is replaced by a placeholder, so that
/// MRPT reads the entry to its end and the entries after it.
class PictureGuard {
 public:
  /// Prepares for the next entry.
  void beginEntry();
  /// Examines bytes that MRPT requested, before MRPT sees them.
  /// @throws std::runtime_error for pixels that do not fit into the picture, and for JPEG files that are too small for
  /// a
  ///         placeholder
  void inspect(std::uint8_t* bytes, std::size_t size);

  /// Cause of the first damage in this entry; empty for none.
  const std::string& fault() const { return fault_; }
  /// Whether an observation of this entry holds a placeholder.
  bool isDamaged(const mrpt::obs::CObservation& observation) const;

 private:
  /// What MRPT reads next.
  enum class Next { other, version, is_external, has_color, gray, color, size, jpeg };

  void inspectOther(const std::uint8_t* bytes, std::size_t size);
  void inspectJpeg(std::uint8_t* bytes, std::size_t size);
  void checkGray() const;

  Next next_ = Next::other;
  std::size_t name_size_ = 0;  ///< of the class name that follows; 0 for none
  int version_ = 0;            ///< of the picture
  std::vector<std::int64_t> numbers_;
  std::string fault_;
};

}  // namespace robosim
