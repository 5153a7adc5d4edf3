#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CMemoryStream.h>

#include "base/angle_units.h"
#include "base/random.h"
#include "hardware/measurement_fields.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"

/// Test data of this module: a robot with every kind of sensor, and its readings.
namespace robosim {

inline Beam beamAt(double x_m, double y_m, double z_m, double yaw_rad) { return {{x_m, y_m, z_m, yaw_rad, 0, 0}}; }

inline SensorInfo rangeSensor(SensorKind kind, const std::string& label, std::vector<Beam> beams, double range_max_m,
                              double no_echo_m) {
  SensorInfo sensor;
  sensor.kind = kind;
  sensor.label = label;
  sensor.beams = std::move(beams);
  sensor.range_max_m = range_max_m;
  sensor.no_echo_m = no_echo_m;
  return sensor;
}

inline SensorInfo plainSensor(SensorKind kind, const std::string& label, std::vector<Beam> beams = {}) {
  return rangeSensor(kind, label, std::move(beams), 0, 0);
}

/// 181 beams over 180°, 0.2 m ahead of the robot's centre.
inline SensorInfo sampleScanner(double range_max_m = 8) {
  std::vector<Beam> beams;
  for (int i = 0; i <= 180; ++i) beams.push_back(beamAt(0.2, 0, 0.3, toRadians(i - 90)));
  return rangeSensor(SensorKind::laser, "laser", beams, range_max_m, range_max_m);
}

/// Mounted, in this order: sonar (16), laser (181 beams), beam (a laser that pans), infrared (2), heat, bumper
/// (10 segments), odometry, compass, battery, beacons (2), air (2 values).
inline RobotInfo sampleRobot(const std::string& name) {
  std::vector<Beam> ring, bumper;
  for (int i = 0; i < 16; ++i) ring.push_back(beamAt(0.2 * std::cos(i), 0.2 * std::sin(i), 0.15, (i - 8) * M_PI / 8));
  for (int i = 0; i < 10; ++i) bumper.push_back(beamAt(0.2, 0, 0.1, i * M_PI / 5));
  auto sonar = rangeSensor(SensorKind::sonar, "sonar", ring, 5, 5);
  sonar.range_min_m = 0.1;
  sonar.beam_width_rad = toRadians(20);
  auto beam = rangeSensor(SensorKind::laser, "beam", {beamAt(0.3, 0, 0.15, 0)}, 2, 2.1);
  beam.pans = true;
  const auto infrared = rangeSensor(SensorKind::infrared, "infrared",
                                    {beamAt(0.2, 0.1, 0.1, 0.2), beamAt(0.2, -0.1, 0.1, -0.2)}, 0.8, 0.8);
  const auto beacons = rangeSensor(SensorKind::beacons, "beacons", {beamAt(0, 0, 0.3, 0), beamAt(0, 0, 0.3, 0)}, 9, 9);
  auto air = plainSensor(SensorKind::values, "air");
  air.quantities = {{"co2", "ppm"}, {"humidity", "%"}};
  RobotInfo robot;
  robot.name = name;
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{
      sonar, sampleScanner(), beam, infrared, plainSensor(SensorKind::heat, "heat", {beamAt(0, 0, 0.4, 0)}),
      plainSensor(SensorKind::bumper, "bumper", bumper), plainSensor(SensorKind::odometry, "odometry"),
      plainSensor(SensorKind::compass, "compass"), plainSensor(SensorKind::battery, "battery"), beacons, air});
  return robot;
}

/// 48 × 32 pixels, an image every second step, mounted slightly ahead of the robot's centre and turned to the left.
inline SensorInfo sampleCamera() {
  auto camera = plainSensor(SensorKind::camera, "camera", {beamAt(0.15, 0, 0.3, 0.1)});
  camera.camera = {48, 32, 1.2, 5};
  return camera;
}

/// Odometry, the sample camera, and a blob finder of gold and red.
inline RobotInfo seeingRobot(const std::string& name) {
  auto blob_finder = sampleCamera();
  blob_finder.kind = SensorKind::blob_finder;
  blob_finder.label = "blob_finder";
  blob_finder.colors = {"gold", "red"};
  RobotInfo robot;
  robot.name = name;
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(
      std::vector<SensorInfo>{plainSensor(SensorKind::odometry, "odometry"), sampleCamera(), blob_finder});
  return robot;
}

/// An image of one colour, as a JPEG file.
inline std::string sampleJpeg(const SensorInfo& camera, std::uint8_t shade) {
  mrpt::img::CImage picture(camera.camera.width_px, camera.camera.height_px, mrpt::img::CH_RGB);
  picture.filledRectangle(0, 0, static_cast<int>(camera.camera.width_px) - 1,
                          static_cast<int>(camera.camera.height_px) - 1, mrpt::img::TColor(shade, 100, 50));
  mrpt::io::CMemoryStream stream;
  picture.saveToStreamAsJPEG(stream, 80);
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

/// A measurement of random numbers, of the kind and size of a blank one. About one beam in five has no echo. Images
/// exist in even steps only.
struct SampleMeasurement {
  const SensorInfo& sensor;
  float laser_pan_rad;
  std::uint64_t step;
  Rng& rng;

  void operator()(Echoes& echoes) const {
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const bool has_no_echo = rng.uniform() < 0.2;
      const double range_m = has_no_echo ? sensor.no_echo_m : rng.uniform(0, sensor.range_max_m);
      const auto& at = sensor.beams[i].robot_from_beam;
      const double yaw = at.yaw + (sensor.pans ? laser_pan_rad : 0);
      const mrpt::math::TPoint3D point{at.x + range_m * std::cos(yaw), at.y + range_m * std::sin(yaw), at.z};
      echoes[i] = {static_cast<float>(range_m), mrpt::math::TPoint3Df(point)};
    }
  }
  void operator()(Image& image) const {
    if (step % 2 == 0) image.jpeg = sampleJpeg(sensor, static_cast<std::uint8_t>(rng.below(256)));
  }
  void operator()(Blobs& blobs) const {
    blobs.taken = step % 2 == 0;
    if (blobs.taken) blobs.of_color[1] = {"red", 1 + rng.below(6), 10.25f, 11.5f, 10, 11, 2, 3};
  }
  void operator()(BeaconRanges& beacons) const {
    for (float& range_m : beacons.range_m) {
      range_m = static_cast<float>(rng.uniform() < 0.2 ? sensor.no_echo_m : rng.uniform(0, sensor.range_max_m));
    }
  }
  void operator()(auto& measurement) const {
    forNumbers(measurement, [&](const auto& field, auto& number, std::size_t) {
      using Number = std::remove_reference_t<decltype(number)>;
      const double most = std::min(9.0, field.max);
      const double random = rng.uniform(std::max(-9.0, field.min), most);
      // MRPT's temperatures have single precision.
      number = std::is_integral_v<Number>
                   ? static_cast<Number>(std::round(random))
                   : static_cast<Number>(sensor.kind == SensorKind::heat ? static_cast<float>(random) : random);
    });
  }
};

/// Readings that differ in every value from step to step.
inline Readings sampleReadings(const RobotInfo& robot, std::uint64_t step) {
  Rng rng(step);
  Readings readings;
  readings.time = {step, 0.1};
  readings.laser_pan_rad = static_cast<float>(rng.uniform(-1.5, 1.5));
  for (const auto& sensor : *robot.sensors) {
    std::visit(SampleMeasurement{sensor, readings.laser_pan_rad, step, rng},
               readings.measurements.emplace_back(blankMeasurement(sensor)));
  }
  return readings;
}

inline mrpt::img::CImage unpacked(const std::string& jpeg) {
  mrpt::io::CMemoryStream stream(jpeg.data(), jpeg.size());
  mrpt::img::CImage picture;
  picture.loadFromStreamAsJPEG(stream);
  return picture;
}

/// Expects ranges and all other numbers to be equal, points within the rounding error of their recomputation, and
/// images within the loss of one more compression.
inline void expectSameReading(const Measurement& read, const Measurement& written, const std::string& label) {
  if (const auto* image = std::get_if<Image>(&written)) {
    mrpt::img::CImage before = unpacked(image->jpeg), after = unpacked(std::get<Image>(read).jpeg);
    ASSERT_EQ(after.getWidth(), before.getWidth()) << label;
    ASSERT_EQ(after.getHeight(), before.getHeight()) << label;
    for (unsigned channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(*after(5, 5, channel), *before(5, 5, channel), 2) << label;
    }
    return;
  }
  const auto* echoes = std::get_if<Echoes>(&written);
  if (!echoes) {
    EXPECT_EQ(read, written) << label;
    return;
  }
  const auto& read_echoes = std::get<Echoes>(read);
  ASSERT_EQ(read_echoes.size(), echoes->size()) << label;
  for (std::size_t i = 0; i < echoes->size(); ++i) {
    EXPECT_EQ(read_echoes[i].range_m, (*echoes)[i].range_m) << label << ' ' << i;
    EXPECT_NEAR(read_echoes[i].point_m.x, (*echoes)[i].point_m.x, 2e-6) << label << ' ' << i;
    EXPECT_NEAR(read_echoes[i].point_m.y, (*echoes)[i].point_m.y, 2e-6) << label << ' ' << i;
    EXPECT_NEAR(read_echoes[i].point_m.z, (*echoes)[i].point_m.z, 2e-6) << label << ' ' << i;
  }
}

}  // namespace robosim
