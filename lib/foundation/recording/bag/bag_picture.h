#pragma once
#include <optional>
#include <stdexcept>

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>

#include "ros/messages.h"

namespace robosim {

/// A picture in a format that is not read.
class UnknownPictureFormat : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @name A picture of ROS as CObservationImage
/// @param camera its parameters; nullopt: unknown
/// @param robot_from_optical pose of the optical frame, whose axes are those of MRPT's cameras: z forward, x right
/// @throws std::runtime_error for a damaged picture; UnknownPictureFormat for one of another format than JPEG, PNG,
/// rgb8, rgba8, bgr8, bgra8 and mono8
///@{
mrpt::obs::CObservation::Ptr pictureObservation(const ros::CompressedImage& picture,
                                                const std::optional<ros::CameraInfo>& camera,
                                                const mrpt::poses::CPose3D& robot_from_optical);
mrpt::obs::CObservation::Ptr pictureObservation(const ros::Image& picture, const std::optional<ros::CameraInfo>& camera,
                                                const mrpt::poses::CPose3D& robot_from_optical);
///@}

}  // namespace robosim
