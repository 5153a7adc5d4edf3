#include <cmath>

#include "recording/codecs.h"
#include "recording/jpeg_observation.h"

namespace robosim {
namespace {

using mrpt::obs::CObservation;
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
  void init(JpegObservation& picture, const SensorInfo& sensor) const override {
    picture.cameraPose = CPose3D(mountOf(sensor)) + beamFromCamera();
    const CameraInfo& camera = sensor.camera;
    const double focal_px = camera.focalLength();
    picture.cameraParams.ncols = camera.width_px;
    picture.cameraParams.nrows = camera.height_px;
    picture.cameraParams.setIntrinsicParamsFromValues(focal_px, focal_px, camera.width_px / 2.0,
                                                      camera.height_px / 2.0);
    if (camera.distortion.isNone()) return;
    picture.cameraParams.setDistortionPlumbBob(camera.distortion.k1, camera.distortion.k2, camera.distortion.p1,
                                               camera.distortion.p2, camera.distortion.k3);
  }

  void set(JpegObservation& picture, const SensorInfo&, const Image& image, float) const override {
    picture.jpeg = image.jpeg;
  }

  Image get(const JpegObservation& picture, const SensorInfo&, float) const override { return {picture.jpeg}; }
};

}  // namespace

const Codec& imageCodec() { return theCodec<ImageCodec>(); }

}  // namespace robosim
