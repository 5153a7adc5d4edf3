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
  for (const auto kind :
       {SensorKind::sonar, SensorKind::laser, SensorKind::infrared, SensorKind::heat, SensorKind::bumper,
        SensorKind::odometry, SensorKind::compass, SensorKind::camera, SensorKind::blob_finder}) {
    SensorInfo sensor;
    sensor.kind = kind;
    sensor.label = nameOf(kind);
    sensor.range_max_m = 5;
    if (kind != SensorKind::heat && kind != SensorKind::odometry && kind != SensorKind::compass) {
      sensor.beams = {{{0.1, 0.2, 0.3, 0.4, 0, 0}}, {{0.5, 0, 0, -1, 0.1, 0.2}}};
    }
    if (kind == SensorKind::camera || kind == SensorKind::blob_finder) {
      sensor.beams.resize(1);
      sensor.camera = {320, 240, 1.25, 10};
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
  readings.stalled = true;
  readings.laser_pan_rad = 0.5f;
  readings.inbox = {{"Scout1", "Pioneer1", "GOLD"}};
  readings.is_too_far = true;
  return readings;
}

/// What is said of a message that is refused.
std::string complaint(const std::function<void()>& read) {
  try {
    read();
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

std::string complaintOf(const wire::FromRobots& message) {
  RobotsAnswer answer;
  return complaint([&] { decode(message, 2, answer); });
}

TEST(RobotWire, CarriesReadingsBitForBit) {
  const Readings sent = someReadings();
  wire::RobotReadings wire;
  encode(sent, wire);
  Readings heard = blankReadings(everySensor());
  decode(wire, "Pioneer1", heard);
  EXPECT_EQ(heard.measurements, sent.measurements);
  EXPECT_EQ(heard.stalled, sent.stalled);
  EXPECT_EQ(heard.laser_pan_rad, sent.laser_pan_rad);
  EXPECT_EQ(heard.inbox, sent.inbox);
  EXPECT_EQ(heard.is_too_far, sent.is_too_far);
}

TEST(RobotWire, CarriesAStepWithoutAPicture) {
  wire::RobotReadings wire;
  encode(blankReadings(everySensor()), wire);
  Readings heard = someReadings();
  decode(wire, "Pioneer1", heard);
  EXPECT_EQ(std::get<Image>(heard.measurements[7]), Image{});
  EXPECT_EQ(std::get<Blobs>(heard.measurements[8]), (Blobs{false, {{"gold"}, {"red"}}}));
}

TEST(RobotWire, LeavesNothingOfTheStepBeforeInAMessageThatIsUsedAgain) {
  wire::RobotReadings again, anew;
  encode(someReadings(), again);
  const Readings blank = blankReadings(everySensor());
  encode(blank, again);
  encode(blank, anew);
  EXPECT_EQ(again.SerializeAsString(), anew.SerializeAsString());
}

TEST(RobotWire, PutsHeldLettersBeforeTheNewestOnes) {
  wire::RobotReadings wire;
  encode(someReadings(), wire);
  encodeInbox({{"A", "Pioneer1", "first"}, {"B", "Pioneer1", "second"}}, wire);
  Readings heard = blankReadings(everySensor());
  decode(wire, "Pioneer1", heard);
  const std::vector<RobotMessage> expected{
      {"A", "Pioneer1", "first"}, {"B", "Pioneer1", "second"}, {"Scout1", "Pioneer1", "GOLD"}};
  EXPECT_EQ(heard.inbox, expected);
}

TEST(RobotWire, CarriesCommandsLettersAndQuestionsWhetherOneHasWon) {
  const Command command{0.5, -0.25, 0.125f, Activity::found, true};
  wire::FromRobots message;
  message.set_step(7);
  encode(command, 1, *message.add_commands());
  message.add_letters()->set_to("Scout1");
  message.mutable_letters(0)->set_text(std::string(kMaxMessageBytes, '\0'));
  message.add_check_win(1);
  RobotsAnswer answer;
  decode(message, 2, answer);
  EXPECT_EQ(answer.win_checks, std::vector<std::uint32_t>{1});
  EXPECT_EQ(answer.step, 7u);
  ASSERT_EQ(answer.orders.size(), 1u);
  EXPECT_EQ(answer.orders[0].robot, 1u);
  EXPECT_EQ(answer.orders[0].command, command);
  ASSERT_EQ(answer.letters.size(), 1u);
  EXPECT_EQ(answer.letters[0].to, "Scout1");
  EXPECT_EQ(answer.letters[0].text.size(), kMaxMessageBytes);
}

TEST(RobotWire, RefusesSpeedsThatAreNotFinite) {
  for (const double bad : {kNan, kInf, -kInf}) {
    wire::FromRobots message;
    message.add_commands()->set_speed_mps(bad);
    EXPECT_NE(complaintOf(message).find("has a speed_mps of "), std::string::npos) << complaintOf(message);
    message.mutable_commands(0)->set_speed_mps(0);
    message.mutable_commands(0)->set_turn_radps(bad);
    EXPECT_NE(complaintOf(message).find("has a turn_radps of "), std::string::npos);
    message.mutable_commands(0)->set_turn_radps(0);
    message.mutable_commands(0)->set_laser_pan_rad(static_cast<float>(bad));
    EXPECT_NE(complaintOf(message).find("has a laser_pan_rad of "), std::string::npos);
  }
}

TEST(RobotWire, RefusesUnknownActivitiesOtherProcessesRobotsAndLongLetters) {
  wire::FromRobots message;
  message.add_commands()->set_activity(static_cast<wire::Activity>(3));
  EXPECT_EQ(complaintOf(message),
            "the command for robot 0 has the activity 3; there are 0 (active), 1 (halted) and 2 "
            "(found)");
  message.Clear();
  message.add_commands()->set_robot(2);
  EXPECT_EQ(complaintOf(message),
            "a command for robot 2 of 2; a connection speaks only for the robots of its hello, counted from 0");
  message.Clear();
  message.add_letters()->set_robot(0xFFFFFFFF);
  EXPECT_NE(complaintOf(message).find("a letter for robot 4294967295 of 2"), std::string::npos);
  message.Clear();
  message.add_check_win(2);
  EXPECT_NE(complaintOf(message).find("a question whether it has won for robot 2 of 2"), std::string::npos);
  message.Clear();
  message.add_letters()->set_text(std::string(kMaxMessageBytes + 1, 'x'));
  EXPECT_EQ(complaintOf(message), "a letter of 4097 bytes; the most is 4096");
}

TEST(RobotWire, RefusesReadingsOfAnotherSizeOrThatAreNoNumbers) {
  wire::RobotReadings good;
  encode(someReadings(), good);
  const auto complaint_after = [&](const std::function<void(wire::RobotReadings&)>& spoil) {
    wire::RobotReadings bad = good;
    spoil(bad);
    Readings heard = blankReadings(everySensor());
    return complaint([&] { decode(bad, "Pioneer1", heard); });
  };
  EXPECT_EQ(complaint_after([](auto&) {}), "");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements()->RemoveLast(); }),
            "readings of 8 sensors for a robot that has 9");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(0)->add_echoes(1); }),
            "a reading of 9 floats for 2 beams; each has four");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(0)->set_echoes(3, std::nanf("")); }),
            "an echo is not a number");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(3)->clear_numbers(); }),
            "a reading of 0 numbers where 1 belong");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(5)->set_numbers(2, kInf); }),
            "a reading that is not a finite number");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(4)->set_pressed("\1"); }),
            "a reading of 1 segments for a bumper of 2");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_measurements(4)->set_pressed("\1\2"); }),
            "a bumper's segment that is neither 0 nor 1");
}

TEST(RobotWire, RefusesPicturesAndBlobsThatAreNone) {
  wire::RobotReadings good;
  encode(someReadings(), good);
  const auto complaint_after = [&](const std::function<void(wire::Measurement&, wire::Measurement&)>& spoil) {
    wire::RobotReadings bad = good;
    spoil(*bad.mutable_measurements(7), *bad.mutable_measurements(8));
    Readings heard = blankReadings(everySensor());
    return complaint([&] { decode(bad, "Pioneer1", heard); });
  };
  EXPECT_EQ(complaint_after([](auto&, auto&) {}), "");
  for (const char* no_jpeg : {"\xFF\xD8", "\xFF\xD9", "GIF89a", "\xFF\xD8 cut off"}) {
    EXPECT_EQ(complaint_after([&](auto& image, auto&) { image.set_jpeg(no_jpeg); }), "a picture that is no JPEG file");
  }
  EXPECT_EQ(complaint_after([](auto& image, auto&) { image.set_jpeg(std::string(kPictureBytesMax + 1, 'x')); }),
            "a picture of 16777217 bytes; the most is 16777216");
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.add_blobs(); }),
            "a reading of 3 blobs for a blob finder of 2 colours");
  const std::string in_no_picture = "a blob that is in no picture";
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.mutable_blobs(0)->set_pixels(19); }), in_no_picture);
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.mutable_blobs(0)->set_x_px(7.5f); }), in_no_picture);
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.mutable_blobs(0)->set_y_px(std::nanf("")); }),
            in_no_picture);
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.mutable_blobs(0)->set_width_px(0xFFFFFFFF); }),
            in_no_picture);
  EXPECT_EQ(complaint_after([](auto&, auto& blobs) { blobs.mutable_blobs(0)->set_top_px(2049); }), in_no_picture);
}

RobotsWelcome someWelcome() {
  const auto sensors = std::make_shared<const std::vector<SensorInfo>>(everySensor());
  RobotsWelcome welcome{.world = "maze", .world_version = "1", .seed = 5, .period_s = 0.1, .seats = {}, .everyone = {}};
  for (const char* name : {"Pioneer1", "Pioneer2"}) {
    RobotInfo info{name, "pioneer3dx", "Scout1", 0.25, 0.3, {.speed_max_mps = 1, .turn_max_radps = 2}, sensors};
    welcome.seats.push_back({info, 3, "wander"});
  }
  welcome.everyone = {"Pioneer1", "Pioneer2", "Scout1"};
  return welcome;
}

TEST(RobotWire, CarriesAWelcomeAndRobotsOfAModelShareTheirSensorsAgain) {
  wire::RobotsWelcome wire;
  encode(someWelcome(), wire);
  EXPECT_EQ(wire.sensor_sets_size(), 1);
  const RobotsWelcome heard = decode(wire);
  ASSERT_EQ(heard.seats.size(), 2u);
  EXPECT_EQ(heard.seats[1].info.name, "Pioneer2");
  EXPECT_EQ(heard.seats[1].info.limits.turn_max_radps, 2);
  EXPECT_EQ(heard.seats[1].controller, "wander");
  EXPECT_EQ(heard.seats[0].info.sensors, heard.seats[1].info.sensors);
  EXPECT_EQ((*heard.seats[0].info.sensors)[7].camera, (CameraInfo{320, 240, 1.25, 10}));
  EXPECT_EQ((*heard.seats[0].info.sensors)[8].colors, (std::vector<std::string>{"gold", "red"}));
  EXPECT_EQ(heard.everyone, someWelcome().everyone);
  wire::RobotsWelcome again;
  encode(heard, again);
  EXPECT_EQ(again.SerializeAsString(), wire.SerializeAsString());
}

TEST(RobotWire, RefusesAWelcomeThatMakesNoSense) {
  wire::RobotsWelcome good;
  encode(someWelcome(), good);
  const auto complaint_after = [&](const std::function<void(wire::RobotsWelcome&)>& spoil) {
    wire::RobotsWelcome bad = good;
    spoil(bad);
    return complaint([&] { decode(bad); });
  };
  EXPECT_EQ(complaint_after([](auto&) {}), "");
  EXPECT_NE(complaint_after([](auto& bad) { bad.set_period_s(kNan); }), "");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_robots(0)->set_sensor_set(1); }), "");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_robots(1)->set_radius_m(kInf); }), "");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(0)->add_beams(1); }), "");
  EXPECT_NE(complaint_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(0)->set_beams(0, kNan); }), "");
  EXPECT_NE(complaint_after([](auto& bad) {
              bad.mutable_sensor_sets(0)->mutable_sensors(0)->set_kind(static_cast<wire::SensorKind>(10));
            }),
            "");
  const auto camera_after = [&](const std::function<void(wire::CameraDescription&)>& spoil) {
    return complaint_after(
        [&](auto& bad) { spoil(*bad.mutable_sensor_sets(0)->mutable_sensors(7)->mutable_camera()); });
  };
  const std::string takes_none = "a camera that takes no pictures";
  EXPECT_EQ(camera_after([](auto& camera) { camera.Clear(); }), takes_none);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_width_px(2049); }), takes_none);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_height_px(0); }), takes_none);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_field_of_view_rad(3.15); }), takes_none);
  EXPECT_EQ(camera_after([](auto& camera) { camera.set_rate_hz(kNan); }), takes_none);
  EXPECT_NE(camera_after([](auto& camera) { camera.set_rate_hz(kInf); }), "");
  EXPECT_EQ(complaint_after([](auto& bad) { bad.mutable_sensor_sets(0)->mutable_sensors(7)->clear_beams(); }),
            "a camera has one place on the robot");
}

}  // namespace
}  // namespace robosim
