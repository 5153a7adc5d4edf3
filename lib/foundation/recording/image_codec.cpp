#include <cmath>

#include "recording/codecs.h"
#include "recording/exact_observations.h"
#include "recording/jpeg_observation.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationImage;
using mrpt::poses::CPose3D;

/// MRPT's camera frame: z points ahead along the optical axis, x to the right.
const CPose3D& beamFromCamera() {
  static const CPose3D pose(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  return pose;
}

/// Camera: CObservationImage with the unchanged bytes of the JPEG file, embedded or in an external file.
class ImageCodec : public CodecOf<JpegObservation, Image> {
 public:
  Measurement measurementFrom(const CObservation& observation, const SensorInfo& sensor, float,
                              const std::filesystem::path& pictures) const override {
    const auto* const image = dynamic_cast<const CObservationImage*>(&observation);
    if (!image) {
      refuse(observation, sensor,
             std::string("the class should be ") + CObservationImage::GetRuntimeClassIdStatic().className);
    }
    if (!image->image.isExternallyStored() && image->image.isEmpty()) refuse(observation, sensor, "it has no picture");
    return Image{extractCheckedJpeg(*image, pictures)};
  }

 private:
  void init(JpegObservation& picture, const SensorInfo& sensor) const override { setCamera(picture, sensor); }

  void set(JpegObservation& picture, const SensorInfo&, const Image& image, float) const override {
    picture.jpeg = image.jpeg;
  }

  Image get(const JpegObservation& picture, const SensorInfo&, float) const override { return {picture.jpeg}; }
};

mrpt::img::TCamera parametersOf(const CameraInfo& camera) {
  mrpt::img::TCamera parameters;
  const double focal_px = camera.focalLength();
  parameters.ncols = camera.width_px;
  parameters.nrows = camera.height_px;
  parameters.setIntrinsicParamsFromValues(focal_px, focal_px, camera.width_px / 2.0, camera.height_px / 2.0);
  if (camera.isRaycast()) parameters.cameraName = kExactCameraName;
  const LensDistortion& lens = camera.distortion;
  if (!lens.isNone()) parameters.setDistortionPlumbBob(lens.k1, lens.k2, lens.p1, lens.p2, lens.k3);
  return parameters;
}

}  // namespace

void setCamera(CObservation& picture, const SensorInfo& sensor) {
  const CPose3D pose(mountOf(sensor));
  if (auto* const image = dynamic_cast<CObservationImage*>(&picture)) {
    image->cameraPose = pose + beamFromCamera();
    image->cameraParams = parametersOf(sensor.camera);
    return;
  }
  auto& scan = dynamic_cast<CObservation3DRangeScan&>(picture);
  scan.sensorPose = pose;
  scan.cameraParams = scan.cameraParamsIntensity = parametersOf(sensor.camera);
}

const Codec& imageCodec() { return theCodec<ImageCodec>(); }

}  // namespace robosim
