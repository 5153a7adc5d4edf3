#include "recording/observation_writer.h"

#include <utility>

#include "recording/exact_observations.h"
#include "recording/jpeg_observation.h"

namespace robosim {
namespace {

/// Number of bytes compressed at a time.
constexpr std::size_t kBufferBytes = 64 * 1024;

}  // namespace

ObservationWriter::ObservationWriter(const std::filesystem::path& file, std::filesystem::path pictures)
    : pictures_(std::move(pictures)), file_(file) {}

void ObservationWriter::write(const mrpt::obs::CObservation& observation) {
  // Observations of the same time, which may be those of a step, are in the same member.
  const std::size_t size = file_.memberBytes() + buffer_.bytes.size();
  if (size >= (observation.timestamp == last_time_ ? GzipFile::kMaxMemberBytes : GzipFile::kMemberBytes)) {
    flush();
    file_.endMember();
  }
  last_time_ = observation.timestamp;
  const auto* const image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation);
  const auto* const scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
  if (image && image->cameraParams.cameraName == kExactCameraName) {
    const ExactImageObservation exact(*image);
    buffer_.WriteObject(&exact);
  } else if (scan && scan->cameraParams.cameraName == kExactCameraName) {
    const ExactDepthObservation exact(*scan);
    buffer_.WriteObject(&exact);
  } else if (image) {
    JpegObservation embedded;
    const mrpt::img::CImage placeholder = embedded.image;
    static_cast<mrpt::obs::CObservationImage&>(embedded) = *image;
    embedded.image = placeholder;
    embedded.jpeg = extractCheckedJpeg(*image, pictures_);
    buffer_.WriteObject(&embedded);
  } else {
    buffer_.WriteObject(&observation);
  }
  if (buffer_.bytes.size() >= kBufferBytes) flush();
}

void ObservationWriter::commit() {
  flush();
  file_.commit();
}

void ObservationWriter::flush() {
  file_.write(buffer_.bytes);
  buffer_.bytes.clear();
}

}  // namespace robosim
