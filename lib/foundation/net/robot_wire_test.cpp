#include "net/robot_wire.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

std::vector<SensorInfo> everySensor() {
  std::vector<SensorInfo> sensors;
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared, SensorKind::heat,
                          SensorKind::bumper, SensorKind::odometry, SensorKind::compass, SensorKind::camera,
                          SensorKind::blob_finder, SensorKind::values, SensorKind::beacons, SensorKind::lidar}) {
    SensorInfo sensor;
    sensor.kind = kind;
    sensor.label = nameOf(kind);
    sensor.range_max_m = 5;
    sensor.times = {.rate_hz = 5, .phase_s = 0.05};
    sensor.bearing_std_rad = 0.25;
    if (kind != SensorKind::heat && kind != SensorKind::odometry && kind != SensorKind::compass) {
      sensor.beams = {{{0.1, 0.2, 0.3, 0.4, 0, 0}}, {{0.5, 0, 0, -1, 0.1, 0.2}}};
    }
    if (kind == SensorKind::camera || kind == SensorKind::blob_finder) {
      sensor.beams.resize(1);
      sensor.camera = {320, 240, 1.25, 10};
      sensor.camera.distortion = {-0.2, 0.05, 0.001, 0.002, 0.01};
    }
    if (kind == SensorKind::values) {
      sensor.quantities = {{"co2", "ppm"}, {"humidity", "%"}};
      sensor.head = {-1, 2, -0.5, 1.5, 16, 1.25, 0.75, 5};
    }
    if (kind == SensorKind::blob_finder) sensor.colors = {"gold", "red"};
    sensors.push_back(sensor);
  }
  return sensors;
}

Readings someReadings() {
  Readings readings = blankReadings(everySensor());
  std::get<Echoes>(readings.measurements[0]) = {{1.5f, {1, 2, 3}}, {2.5f, {-1, 0, 0.5f}}};
  std::get<Scalar>(readings.measurements[3]).value = 12.25;
  std::get<Contacts>(readings.measurements[4]).pressed = {0, 1};
  std::get<Odometry>(readings.measurements[5]) = {{1, -2, 0.5}, 0.25, -0.125};
  std::get<Image>(readings.measurements[7]).jpeg = "\xFF\xD8 and so on \xFF\xD9";
  std::get<Blobs>(readings.measurements[8]) = {true, {{"gold", 12, 10.5f, 20.25f, 8, 19, 6, 3}, {"red"}}};
  std::get<Values>(readings.measurements[9]).values = {412.5, 0.1};
  std::get<BeaconRanges>(readings.measurements[10]).range_m = {2.25f, 4.5f};
  readings.stalled = true;
  readings.laser_pan_rad = 0.5f;
  readings.inbox.edit() = {{"Scout1", "Pioneer1", "GOLD"}};
  readings.is_too_far = true;
  return readings;
}

/// Error text for an invalid message.
std::string wireErrorOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotWire, RoundTripsReadingsExactly) {
  const Readings sent = someReadings();
  v1::RobotReadings wire;
  encode(sent, wire);
  Readings decoded = blankReadings(everySensor());
  decode(wire, "Pioneer1", decoded);
  EXPECT_EQ(decoded.measurements, sent.measurements);
  EXPECT_EQ(decoded.stalled, sent.stalled);
  EXPECT_EQ(decoded.laser_pan_rad, sent.laser_pan_rad);
  EXPECT_EQ(decoded.inbox, sent.inbox);
  EXPECT_EQ(decoded.is_too_far, sent.is_too_far);
}

TEST(RobotWire, RoundTripsExactPictures) {
  Readings sent = someReadings();
  const RawPicture raw{2, 1, 4, {1, 2, 3, 4, 5, 6}, {1.5f, 0}, {7, RawPicture::kSky}};
  sent.measurements[7] = Image{"", std::make_shared<const RawPicture>(raw)};
  v1::RobotReadings wire;
  encode(sent, wire);
  EXPECT_TRUE(wire.measurements(7).jpeg().empty());
  Readings decoded = blankReadings(everySensor());
  decode(wire, "Pioneer1", decoded);
  EXPECT_EQ(decoded.measurements, sent.measurements);
  EXPECT_EQ(wireErrorOf([&] { checkPictures(decoded, everySensor()); }), "a picture of another model of camera");
  wire.mutable_measurements(7)->mutable_raw_picture()->pop_back();
  EXPECT_EQ(wireErrorOf([&] { decode(wire, "Pioneer1", decoded); }), "a picture of an impossible size");
}

TEST(RobotWire, RoundTripsAStepWithoutAnImage) {
  v1::RobotReadings wire;
  encode(blankReadings(everySensor()), wire);
  Readings decoded = someReadings();
  decode(wire, "Pioneer1", decoded);
  EXPECT_EQ(std::get<Image>(decoded.measurements[7]), Image{});
  EXPECT_EQ(std::get<Blobs>(decoded.measurements[8]), (Blobs{false, {{"gold"}, {"red"}}}));
}

TEST(RobotWire, ClearsReusedMessages) {
  v1::RobotReadings first, second;
  encode(someReadings(), first);
  const Readings blank = blankReadings(everySensor());
  encode(blank, first);
  encode(blank, second);
  EXPECT_EQ(first.SerializeAsString(), second.SerializeAsString());
}

TEST(RobotWire, ReplacesTheInboxByMessagesOfSeveralSteps) {
  v1::RobotReadings wire;
  encode(someReadings(), wire);
  encodeInbox({{"A", "Pioneer1", "first"}, {"B", "Pioneer1", "second"}}, wire);
  Readings decoded = blankReadings(everySensor());
  decode(wire, "Pioneer1", decoded);
  const std::vector<RobotMessage> expected{{"A", "Pioneer1", "first"}, {"B", "Pioneer1", "second"}};
  EXPECT_EQ(decoded.inbox, expected);
}

TEST(RobotWire, StatesWhenEachMeasurementWasTaken) {
  Readings readings = someReadings();
  readings.time.step = 7;
  std::get<Image>(readings.measurements[7]).jpeg.clear();
  v1::RobotReadings wire;
  encode(readings, wire);
  EXPECT_EQ(wire.measurements(0).step(), 7u);
  EXPECT_TRUE(wire.measurements(0).is_new());
  EXPECT_FALSE(wire.measurements(7).is_new()) << "a camera without an image in this step";
  encode(readings, wire, 6);
  EXPECT_TRUE(wire.measurements(0).is_new());
  encode(readings, wire, 7);
  EXPECT_FALSE(wire.measurements(0).is_new()) << "sent before";
  EXPECT_EQ(wire.measurements(0).step(), 7u);
  Readings decoded = blankReadings(everySensor());
  decoded.time.step = 6;
  EXPECT_EQ(wireErrorOf([&] { decode(wire, "Pioneer1", decoded); }), "a measurement of step 7 in step 6");
}

TEST(RobotWire, RejectsReadingsOfWrongSizeOrWithNan) {
  v1::RobotReadings good;
  encode(someReadings(), good);
  const auto error_after = [&](const std::function<void(v1::RobotReadings&)>& modify) {
    v1::RobotReadings bad = good;
    modify(bad);
    Readings decoded = blankReadings(everySensor());
    return wireErrorOf([&] { decode(bad, "Pioneer1", decoded); });
  };
  EXPECT_EQ(error_after([](auto&) {}), "");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements()->RemoveLast(); }),
            "readings of 11 sensors for a robot that has 12");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(0)->add_floats(1); }),
            "a reading of 9 numbers where 8 belong");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(0)->set_floats(7, std::nanf("")); }),
            "beam 1: a z of nan m; it must be a finite number");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(3)->clear_doubles(); }),
            "a reading of 0 numbers where 1 belong");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(5)->set_doubles(2, kInf); }),
            "a heading of inf rad; it must be a finite number");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(4)->set_flags("\1"); }),
            "a reading of 1 numbers where 2 belong");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(4)->set_flags("\1\2"); }),
            "segment 1: a pressed of 2; it must lie in [0, 1]");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(10)->set_floats(1, std::nanf("")); }),
            "beacon 1: a range of nan m; it must be a finite number");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_measurements(9)->add_doubles(1); }),
            "a reading of 3 numbers where 2 belong");
}

TEST(RobotWire, RejectsInvalidImagesAndBlobs) {
  v1::RobotReadings good;
  encode(someReadings(), good);
  const auto error_after = [&](const std::function<void(v1::Measurement&, v1::Measurement&)>& modify) {
    v1::RobotReadings bad = good;
    modify(*bad.mutable_measurements(7), *bad.mutable_measurements(8));
    Readings decoded = blankReadings(everySensor());
    return wireErrorOf([&] { decode(bad, "Pioneer1", decoded); });
  };
  EXPECT_EQ(error_after([](auto&, auto&) {}), "");
  for (const char* no_jpeg : {"\xFF\xD8", "\xFF\xD9", "GIF89a", "\xFF\xD8 cut off"}) {
    EXPECT_EQ(error_after([&](auto& image, auto&) { image.set_jpeg(no_jpeg); }), "a picture that is no JPEG file");
  }
  EXPECT_EQ(error_after([](auto& image, auto&) { image.set_jpeg(std::string(kPictureBytesMax + 1, 'x')); }),
            "a picture of 16777217 bytes; the most is 16777216");
  EXPECT_EQ(error_after([](auto&, auto& blobs) { blobs.add_doubles(1); }), "a reading of 15 numbers where 14 belong");
  // The numbers of a blob are pixels, x, y, left, top, width and height.
  const auto error_with = [&](int number, double value) {
    return error_after([&](auto&, auto& blobs) { blobs.set_doubles(number, value); });
  };
  const std::string outside_image = "a blob outside the image";
  EXPECT_EQ(error_with(0, 19), outside_image);
  EXPECT_EQ(error_with(1, 7.5), outside_image);
  EXPECT_EQ(error_with(4, 2048), outside_image);
  EXPECT_EQ(error_with(2, kNan), "blob 0: a y of nan px; it must lie in [0, 2048 px]");
  EXPECT_EQ(error_with(5, 4294967295.0), "blob 0: a width of 4294967295 px; it must lie in [0, 2048 px]");
  EXPECT_EQ(error_with(7, -1), "blob 1: a pixels of -1 px; it must lie in [0, 4194304 px]");
}

RobotsWelcome someWelcome() {
  const auto sensors = std::make_shared<const std::vector<SensorInfo>>(everySensor());
  RobotsWelcome welcome;
  welcome.world = "maze";
  welcome.world_version = "1";
  welcome.run = "0123456789abcdef";
  welcome.seed = 5;
  welcome.period_s = 0.1;
  for (const char* name : {"Pioneer1", "Pioneer2"}) {
    const MotionLimits limits{
        .speed_max_mps = 1, .turn_max_radps = 2, .emergency_decel_mps2 = 3, .lateral_max_mps = 0.5};
    const Drive drive{DriveKind::tracked, 0.25, 0.5, 0.125, 1.5, 1.25, -0.1};
    RobotInfo info{name, RobotTypeInfo{"pioneer3dx", limits, drive}, "Scout1", 0.25, 0.3, sensors};
    welcome.robots.push_back({info, 3, "wander", 41, mrpt::math::TPose2D(1, 2, 0.5)});
  }
  welcome.all_robots = {"Pioneer1", "Pioneer2", "Scout1"};
  return welcome;
}

TEST(RobotWire, RoundTripsAWelcomeWithSharedSensorSets) {
  v1::RobotsWelcome wire;
  encode(someWelcome(), wire);
  EXPECT_EQ(wire.sensor_sets_size(), 1);
  const RobotsWelcome decoded = decode(wire);
  ASSERT_EQ(decoded.robots.size(), 2u);
  EXPECT_EQ(decoded.robots[1].info.name, "Pioneer2");
  EXPECT_EQ(&*decoded.robots[1].info.type, &*decoded.robots[0].info.type) << "shared";
  EXPECT_EQ(decoded.robots[1].info.type->limits.turn_max_radps, 2);
  EXPECT_EQ(decoded.robots[1].info.type->limits.emergency_decel_mps2, 3);
  EXPECT_EQ(decoded.robots[1].info.type->limits.lateral_max_mps, 0.5);
  EXPECT_EQ(decoded.robots[1].info.type->drive, (Drive{DriveKind::tracked, 0.25, 0.5, 0.125, 1.5, 1.25, -0.1}));
  EXPECT_EQ(decoded.robots[1].controller, "wander");
  EXPECT_EQ(decoded.robots[1].next_answer, 41u);
  EXPECT_EQ(decoded.robots[1].world_from_start, mrpt::math::TPose2D(1, 2, 0.5));
  EXPECT_EQ(decoded.run, "0123456789abcdef");
  EXPECT_EQ(decoded.robots[0].info.sensors, decoded.robots[1].info.sensors);
  EXPECT_EQ((*decoded.robots[0].info.sensors)[7].camera,
            (CameraInfo{320, 240, 1.25, 10, {-0.2, 0.05, 0.001, 0.002, 0.01}}));
  EXPECT_EQ((*decoded.robots[0].info.sensors)[8].colors, (std::vector<std::string>{"gold", "red"}));
  EXPECT_EQ((*decoded.robots[0].info.sensors)[9].quantities,
            (std::vector<Quantity>{{"co2", "ppm"}, {"humidity", "%"}}));
  EXPECT_EQ((*decoded.robots[0].info.sensors)[9].head, everySensor()[9].head);
  EXPECT_EQ((*decoded.robots[0].info.sensors)[1].times, (MeasurementTimes{5, 0.05}));
  EXPECT_EQ((*decoded.robots[0].info.sensors)[9].bearing_std_rad, 0.25);
  EXPECT_EQ(decoded.all_robots, someWelcome().all_robots);
  v1::RobotsWelcome again;
  encode(decoded, again);
  EXPECT_EQ(again.SerializeAsString(), wire.SerializeAsString());
}

TEST(RobotWire, DescribesTheNumbersOfEachSensor) {
  v1::RobotsWelcome wire;
  encode(someWelcome(), wire);
  const auto& sensors = wire.sensor_sets(0).sensors();
  const auto text_of = [](const v1::SensorDescription& sensor) {
    std::string text = sensor.record() + ":";
    for (const auto& field : sensor.fields())
      text += " " + field.name() + (field.unit().empty() ? "" : "/" + field.unit());
    return text;
  };
  EXPECT_EQ(text_of(sensors[0]), "beam: range/m x/m y/m z/m");
  EXPECT_EQ(text_of(sensors[4]), "segment: pressed");
  EXPECT_EQ(text_of(sensors[5]), ": x/m y/m heading/rad speed/m/s turn/rad/s lateral/m/s");
  EXPECT_EQ(text_of(sensors[7]), ":") << "a camera has no numbers";
}

TEST(RobotWire, KeepsASensorOfAnUnknownKindWithoutDecodingItsMeasurements) {
  v1::RobotsWelcome wire;
  encode(someWelcome(), wire);
  wire.mutable_sensor_sets(0)->mutable_sensors(0)->set_kind("thermometer");
  wire.mutable_sensor_sets(0)->mutable_sensors(9)->set_kind("spectrometer");
  const RobotsWelcome decoded = decode(wire);
  const auto& sensors = *decoded.robots[0].info.sensors;
  ASSERT_EQ(sensors.size(), everySensor().size());
  EXPECT_EQ(sensors[0].kind, SensorKind::unknown);
  EXPECT_EQ(sensors[0].label, "sonar");
  EXPECT_EQ(sensors[9].kind, SensorKind::unknown);

  v1::RobotReadings sent;
  encode(someReadings(), sent);
  Readings readings = blankReadings(sensors);
  decode(sent, "Pioneer1", readings);
  EXPECT_EQ(readings.measurements[0], Measurement(Values{})) << "floats";
  EXPECT_EQ(readings.measurements[9], Measurement(Values{})) << "doubles";
  EXPECT_EQ(readings.measurements[4], someReadings().measurements[4]) << "the others are decoded";
  sent.mutable_measurements(0)->set_jpeg("no JPEG file");
  EXPECT_EQ(wireErrorOf([&] { decode(sent, "Pioneer1", readings); }), "");
}

TEST(RobotWire, RejectsInvalidWelcomes) {
  v1::RobotsWelcome good;
  encode(someWelcome(), good);
  const auto error_after = [&](const std::function<void(v1::RobotsWelcome&)>& modify) {
    v1::RobotsWelcome bad = good;
    modify(bad);
    return wireErrorOf([&] { decode(bad); });
  };
  EXPECT_EQ(error_after([](auto&) {}), "");
  EXPECT_NE(error_after([](auto& bad) { bad.set_period_s(kNan); }), "");
  EXPECT_NE(error_after([](auto& bad) { bad.mutable_robots(0)->set_sensor_set(1); }), "");
  EXPECT_NE(error_after([](auto& bad) { bad.mutable_robots(1)->set_radius_m(kInf); }), "");
  EXPECT_NE(error_after([](auto& bad) { bad.mutable_robots(1)->mutable_start()->set_heading_rad(kNan); }), "");
  EXPECT_NE(
      error_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(0)->add_beams()->set_yaw_rad(kNan); }),
      "");
  const auto camera_after = [&](const std::function<void(v1::CameraDescription&)>& modify) {
    return error_after([&](auto& bad) { modify(*bad.mutable_sensor_sets(0)->mutable_sensors(7)->mutable_camera()); });
  };
  EXPECT_EQ(
      error_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(9)->mutable_head()->set_zoom_max(0); }),
      "a camera's head with impossible limits");
  const std::string invalid_camera = "a camera with invalid parameters";
  EXPECT_EQ(camera_after([](auto& camera) { camera.Clear(); }), invalid_camera);
  EXPECT_EQ(camera_after([](auto& camera) { camera.add_distortion(0); }),
            "a camera whose lens has no five coefficients");
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_width_px(2049); }), invalid_camera);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_height_px(0); }), invalid_camera);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_field_of_view_rad(3.15); }), invalid_camera);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_rate_hz(kNan); }), invalid_camera);
  EXPECT_NE(camera_after([](auto& camera) { camera.set_rate_hz(kInf); }), "");
  EXPECT_EQ(error_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(7)->clear_beams(); }),
            "a camera has one place on the robot");
}

}  // namespace
}  // namespace robosim
