#include "recording/observation_writer.h"

#include <utility>

#include "recording/jpeg_observation.h"

namespace robosim {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

}  // namespace

ObservationWriter::ObservationWriter(const std::filesystem::path& file, std::filesystem::path pictures)
    : pictures_(std::move(pictures)), file_(file) {}

void ObservationWriter::write(const mrpt::obs::CObservation& observation) {
  if (const auto* image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation)) {
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
