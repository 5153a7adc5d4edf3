#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose2D.h>

#include "hardware/field.h"
#include "hardware/raw_picture.h"
#include "hardware/sensor_info.h"

/// @file
/// The kinds of measurement, each with a Description. The encodings of measurements (digest, network, text, JSON,
/// tests) are derived from the descriptions by the functions of measurement_fields.h; recordings use MRPT's classes, by
/// one Codec per kind (recording/codec.h). doc/architecture.md lists what to change for a new kind.
namespace robosim {

/// Description of a kind of measurement M as a list of equal records of numbers. Each specialisation has
///  * kinds: the kinds of sensor that measure M;
///  * record_name: what a record is about, "beam"; empty for a kind of one record;
///  * fields: the Field of each number of a record;
///  * records(m): the records, a std::span;
///  * blank(sensor): the initial measurement of a sensor, which also determines the number of records.
///
/// Optional members:
///  * isPresent(m): whether the sensor measured something in this step, for sensors that do not in every step. May
///    return a reference, which is then set when a measurement is decoded;
///  * file(m): the bytes of a file, for a kind without numbers, and setFile(m, bytes), which throws
///    std::invalid_argument with the reason why they are impossible;
///  * faultOf(record): why a record is impossible, beyond the fields' bounds; null for a valid record;
///  * is_reproducible = false: values may differ between machines (doc/decisions/pictures.md), and are neither part of
///    the digest nor compared with a recording, except for exactBytes(m).
template <typename M>
struct Description;

/// A range and the point of the echo. Single precision, as in MRPT's observations, so that recordings are exact. For an
/// object nearer than the sensor's range_min_m, range_m is range_min_m and the point is on the object. Without an
/// object within range_max_m, range_m is no_echo_m, and the point lies at that distance on the beam.
struct Echo {
  float range_m = 0;              ///< from the sensor
  mrpt::math::TPoint3Df point_m;  ///< robot frame
  bool operator==(const Echo&) const = default;
};

/// Sonar, laser, lidar, infrared: one echo per beam of the sensor's SensorInfo.
using Echoes = std::vector<Echo>;

template <>
struct Description<Echoes> {
  static constexpr std::array kinds{SensorKind::sonar, SensorKind::laser, SensorKind::lidar, SensorKind::infrared};
  static constexpr const char* record_name = "beam";
  static constexpr std::tuple fields{Field{"range", kMetre, kGet<&Echo::range_m>},
                                     Field{"x", kMetre, kGet<&Echo::point_m, &mrpt::math::TPoint3Df::x>},
                                     Field{"y", kMetre, kGet<&Echo::point_m, &mrpt::math::TPoint3Df::y>},
                                     Field{"z", kMetre, kGet<&Echo::point_m, &mrpt::math::TPoint3Df::z>}};
  static auto records(auto& echoes) { return std::span(echoes); }
  static Echoes blank(const SensorInfo& sensor) { return Echoes(sensor.beams.size()); }
};

/// Heat [°C-like units of the world file], compass [rad, world frame, (-π, π]] or battery [V].
struct Scalar {
  double value = 0;
  bool operator==(const Scalar&) const = default;
};

template <>
struct Description<Scalar> {
  static constexpr std::array kinds{SensorKind::heat, SensorKind::compass, SensorKind::battery};
  static constexpr const char* record_name = "";
  static constexpr std::tuple fields{Field{"value", kNoUnit, kGet<&Scalar::value>}};
  static auto records(auto& scalar) { return std::span(&scalar, 1); }
  static Scalar blank(const SensorInfo&) { return {}; }
};

/// Bumper: contact state of each segment, one per beam of the sensor's SensorInfo.
struct Contacts {
  std::vector<std::uint8_t> pressed;  ///< 0 or 1
  bool operator==(const Contacts&) const = default;
};

template <>
struct Description<Contacts> {
  static constexpr std::array kinds{SensorKind::bumper};
  static constexpr const char* record_name = "segment";
  static constexpr std::tuple fields{Field{"pressed", kNoUnit, kGet<>, 0, 1}};
  static auto records(auto& contacts) { return std::span(contacts.pressed); }
  static Contacts blank(const SensorInfo& sensor) { return {std::vector<std::uint8_t>(sensor.beams.size())}; }
};

/// Wheel odometry since the start of the run.
struct Odometry {
  mrpt::math::TPose2D odom_from_robot;  ///< (0,0,0) at the start [m, rad]
  double speed_mps = 0;                 ///< in the last step, as measured at the wheels
  double turn_radps = 0;
  double lateral_mps = 0;  ///< to the left
  bool operator==(const Odometry&) const = default;
};

template <>
struct Description<Odometry> {
  static constexpr std::array kinds{SensorKind::odometry};
  static constexpr const char* record_name = "";
  static constexpr std::tuple fields{
      Field{"x", kMetre, kGet<&Odometry::odom_from_robot, &mrpt::math::TPose2D::x>},
      Field{"y", kMetre, kGet<&Odometry::odom_from_robot, &mrpt::math::TPose2D::y>},
      Field{"heading", kRadian, kGet<&Odometry::odom_from_robot, &mrpt::math::TPose2D::phi>},
      Field{"speed", kMetrePerSecond, kGet<&Odometry::speed_mps>},
      Field{"turn", kRadianPerSecond, kGet<&Odometry::turn_radps>},
      Field{"lateral", kMetrePerSecond, kGet<&Odometry::lateral_mps>}};
  static auto records(auto& odometry) { return std::span(&odometry, 1); }
  static Odometry blank(const SensorInfo&) { return {}; }
};

/// Camera: a picture; empty in a step without one, because of the camera's rate. That of the model `opengl` is a JPEG
/// file, whose exact pixels depend on the machine (doc/decisions/pictures.md); that of the model `raycast` is exact,
/// and part of the digest. jpegOf() (hardware/picture_file.h) returns a file of either.
struct Image {
  std::string jpeg;                            ///< the file's bytes
  std::shared_ptr<const RawPicture> raw = {};  ///< shared by copies of readings; null: none

  bool isEmpty() const { return jpeg.empty() && !raw; }
  bool operator==(const Image& other) const {
    return jpeg == other.jpeg && (raw == other.raw || (raw && other.raw && *raw == *other.raw));
  }
};

template <>
struct Description<Image> {
  static constexpr std::array kinds{SensorKind::camera};
  static constexpr const char* record_name = "";
  static constexpr std::tuple<> fields{};
  static constexpr bool is_reproducible = false;
  static std::span<const char> records(auto&) { return {}; }
  static Image blank(const SensorInfo&) { return {}; }
  static bool isPresent(const Image& image) { return !image.isEmpty(); }
  /// The bytes of a picture, of a JPEG file or of RawPicture::toBytes(), and the picture of such bytes.
  static std::string file(const Image& image) { return image.raw ? image.raw->toBytes() : image.jpeg; }
  static void setFile(Image& image, std::string file);
  static std::string fileFaultOf(const std::string& jpeg);
  /// What is equal on every machine, for the digest and comparisons.
  static std::array<std::span<const std::byte>, 3> exactBytes(const Image& image) {
    return image.raw ? image.raw->bytes() : std::array<std::span<const std::byte>, 3>{};
  }
};

/// Largest connected region of one colour. Image coordinates point right and down; (0, 0) is the centre of the upper
/// left pixel.
struct Blob {
  std::string color;         ///< its name, as in SensorInfo::colors
  std::uint32_t pixels = 0;  ///< area; if 0, the colour is not visible and all other numbers are 0
  float x_px = 0;            ///< centroid
  float y_px = 0;
  std::uint32_t left_px = 0;  ///< bounding box: first column and row, width and height
  std::uint32_t top_px = 0;
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  bool operator==(const Blob&) const = default;
};

/// Blob finder: the regions in its camera's image.
struct Blobs {
  bool taken = false;          ///< whether there was an image in this step
  std::vector<Blob> of_color;  ///< one for each of SensorInfo::colors, in their order
  bool operator==(const Blobs&) const = default;
};

/// Blobs without an image, with the name of every colour.
inline Blobs blankBlobs(const SensorInfo& blob_finder) {
  Blobs blobs;
  for (const auto& color : blob_finder.colors) blobs.of_color.push_back({.color = color});
  return blobs;
}

template <>
struct Description<Blobs> {
  static constexpr std::array kinds{SensorKind::blob_finder};
  static constexpr const char* record_name = "blob";
  static constexpr double kSide_px = kPictureSideMax_px;
  static constexpr std::tuple fields{Field{"pixels", kPixel, kGet<&Blob::pixels>, 0, kSide_px* kSide_px},
                                     Field{"x", kPixel, kGet<&Blob::x_px>, 0, kSide_px},
                                     Field{"y", kPixel, kGet<&Blob::y_px>, 0, kSide_px},
                                     Field{"left", kPixel, kGet<&Blob::left_px>, 0, kSide_px},
                                     Field{"top", kPixel, kGet<&Blob::top_px>, 0, kSide_px},
                                     Field{"width", kPixel, kGet<&Blob::width_px>, 0, kSide_px},
                                     Field{"height", kPixel, kGet<&Blob::height_px>, 0, kSide_px}};
  static constexpr bool is_reproducible = false;
  static auto records(auto& blobs) { return std::span(blobs.of_color); }
  static Blobs blank(const SensorInfo& sensor) { return blankBlobs(sensor); }
  static auto& isPresent(auto& blobs) { return blobs.taken; }
  static const char* faultOf(const Blob& blob);
};

/// Ranges to radio beacons; a beacon that is not received has the sensor's no_echo_m. Single precision, as in MRPT.
struct BeaconRanges {
  std::vector<float> range_m;  ///< one per beacon, in the order of the robot type; as many as SensorInfo::beams
  bool operator==(const BeaconRanges&) const = default;
};

template <>
struct Description<BeaconRanges> {
  static constexpr std::array kinds{SensorKind::beacons};
  static constexpr const char* record_name = "beacon";
  static constexpr std::tuple fields{Field{"range", kMetre, kGet<>}};
  static auto records(auto& beacons) { return std::span(beacons.range_m); }
  static BeaconRanges blank(const SensorInfo& sensor) {
    return {std::vector(sensor.beams.size(), static_cast<float>(sensor.no_echo_m))};
  }
};

/// The generic kind: named numbers, for sensors that are not part of RoboSim. A sensor of an unknown kind has none.
struct Values {
  std::vector<double> values;  ///< one for each of SensorInfo::quantities, in their order and units
  bool operator==(const Values&) const = default;
};

template <>
struct Description<Values> {
  static constexpr std::array kinds{SensorKind::values, SensorKind::unknown};
  static constexpr const char* record_name = "quantity";
  static constexpr std::tuple fields{Field{"value", kNoUnit, kGet<>}};
  static auto records(auto& values) { return std::span(values.values); }
  static Values blank(const SensorInfo& sensor) {
    return {std::vector<double>(sensor.kind == SensorKind::unknown ? 0 : sensor.quantities.size())};
  }
};

/// Measurement of one sensor in one step.
using Measurement = std::variant<Echoes, Scalar, Contacts, Odometry, Image, Blobs, BeaconRanges, Values>;

/// Initial measurement of a sensor, of its kind and size.
Measurement blankMeasurement(const SensorInfo& sensor);

/// Why a picture of `measurements` is none of its camera: pixels of a camera of the model `opengl`, a JPEG file of one
/// of the model `raycast`, or another size, range or other layers. Null for none.
/// @param sensors as many as measurements
const char* pictureFaultOf(std::span<const Measurement> measurements, std::span<const SensorInfo> sensors);

/// Whether a sensor's kind of measurement is Echoes.
inline bool measuresEchoes(const SensorInfo& sensor) {
  const auto& kinds = Description<Echoes>::kinds;
  return std::find(kinds.begin(), kinds.end(), sensor.kind) != kinds.end();
}

}  // namespace robosim
