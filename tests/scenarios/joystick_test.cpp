// `robosim remote --joystick` with a device file to which the test writes like the kernel.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/joystick.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/angle_units.h"
#include "client/viewer.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

constexpr int kX = 0;
constexpr int kY = 1;
constexpr int kAway = -32767;
constexpr int kLeft = -32767;

/// A minimal /dev with one joystick.
class EmulatedJoystick {
 public:
  explicit EmulatedJoystick(const fs::path& folder) : folder_(folder) {
    fs::create_directories(folder / "input");
    const std::string fifo = folder / "input/js0";
    if (mkfifo(fifo.c_str(), 0600) != 0) throw std::runtime_error("cannot make " + fifo);
    device_ = open(fifo.c_str(), O_RDWR);
  }
  ~EmulatedJoystick() { close(device_); }
  EmulatedJoystick(const EmulatedJoystick&) = delete;
  EmulatedJoystick& operator=(const EmulatedJoystick&) = delete;

  /// Starts `robosim ARGUMENTS` in a mount namespace in which this folder is /dev.
  StartedProgram start(const std::string& arguments) const {
    const std::string script = "set -e; cd '" + folder_.string() +
                               "'; for file in null zero random urandom; do touch $file; "
                               "mount --bind /dev/$file $file; done; mount --rbind . /dev; cd '" ROBOSIM_SOURCE_DIR
                               "'; exec '" ROBOSIM_PROGRAM "' " +
                               arguments;
    return StartedProgram("/usr/bin/unshare", {geteuid() == 0 ? "-m" : "-rm", "sh", "-c", script});
  }

  void moveAxis(int axis, int value) { writeEvent(JS_EVENT_AXIS, axis, value); }
  /// Counted from 1.
  void press(int button) { writeEvent(JS_EVENT_BUTTON, button - 1, 1); }
  void release(int button) { writeEvent(JS_EVENT_BUTTON, button - 1, 0); }

 private:
  void writeEvent(int type, int number, int value) {
    js_event event{};
    event.type = static_cast<std::uint8_t>(type);
    event.number = static_cast<std::uint8_t>(number);
    event.value = static_cast<std::int16_t>(value);
    ASSERT_EQ(write(device_, &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }

  fs::path folder_;
  int device_ = -1;
};

/// The maze with two robot processes that listen for remote control, and a robot list.
class JoystickDrive : public testing::Test {
 protected:
  JoystickDrive() {
    const std::string says = "remote control on 127.0.0.1:";
    std::ofstream list(team_);
    list << "<RobotInfo>\n";
    for (auto* robot : {&pioneer_, &scout_}) {
      robot->waitForError(says);
      const std::string text = robot->error();
      const int port = std::atoi(text.c_str() + text.find(says) + says.size());
      if (robot == &pioneer_) pioneer_port_ = port;
      list << "<robot><hostname>127.0.0.1</hostname><port>" << port << "</port><name>"
           << (robot == &pioneer_ ? "Pioneer1" : "Scout1") << "</name><primary>" << (robot == &pioneer_ ? 1 : 0)
           << "</primary></robot>\n";
    }
    list << "</RobotInfo>\n";
  }

  StartedProgram robot(const std::string& name, int port = 0) {
    return StartedProgram({"robot", name, "--environment", serving_.address(), "--controller", "still", "--remote-port",
                           std::to_string(port), "--dead-man", "5"});
  }
  std::string arguments(int joystick) const {
    return "remote '" + team_.string() + "' --environment " + serving_.address() + " --joystick " +
           std::to_string(joystick);
  }
  /// Waits until a robot's pose satisfies a condition.
  void waitUntil(std::size_t robot, const std::function<bool(const mrpt::math::TPose2D&)>& holds) {
    while (!holds(viewer_.run().snapshot.robots[robot].world_from_robot))
      ASSERT_TRUE(viewer_.waitForFrame()) << "the run has ended";
  }
  /// Waits until a robot has stood for 50 frames, which is longer than the joystick's orders are apart.
  void waitUntilStill(std::size_t robot) {
    auto last = at(robot);
    for (int frames = 0; frames < 50; ++frames) {
      const auto now = at(robot);
      if (now != last) frames = 0;
      last = now;
    }
  }
  mrpt::math::TPose2D at(std::size_t robot) {
    viewer_.waitForFrame();
    return viewer_.run().snapshot.robots[robot].world_from_robot;
  }

  const fs::path folder_ = emptyFolder();
  const fs::path team_ = folder_ / "team.xml";
  int pioneer_port_ = 0;  ///< for remote control
  const fs::path rawlog_ = folder_ / "driven.rawlog";
  Serving serving_{{"--wait-for-robots", "--speed", "2", "--step", "0.02", "--record", rawlog_}};
  StartedProgram pioneer_ = robot("Pioneer1");
  StartedProgram scout_ = robot("Scout1");
  Viewer viewer_{ConnectOptions{.address = serving_.address()}};
};

TEST_F(JoystickDrive, DrivesSwitchesAndIsRecorded) {
  EmulatedJoystick stick(folder_ / "dev");
  StartedProgram remote = stick.start(arguments(0));
  remote.waitForError("joystick 0 drives Pioneer1");
  remote.waitForOutput("you drive");

  const auto start = at(0);
  stick.moveAxis(kY, kAway);
  waitUntil(0, [&](const auto& pose) { return pose.x > start.x + 0.3; });
  stick.moveAxis(kY, 0);
  stick.moveAxis(kX, kLeft);
  waitUntil(0, [&](const auto& pose) { return pose.phi > start.phi + 0.3; });
  stick.moveAxis(kX, 0);

  stick.press(2);
  remote.waitForError("Pioneer1 is too far from the gold to have won.");
  stick.release(2);
  const auto before = at(0);
  stick.press(4);
  waitUntil(0, [&](const auto& pose) { return std::cos(before.phi) * (pose.x - before.x) < -0.05; });
  stick.release(4);

  // A stop is latched: the stick has no effect until it has been centred.
  stick.moveAxis(kY, kAway);
  waitUntil(0, [&, x = at(0).x](const auto& pose) { return std::abs(pose.x - x) > 0.1; });
  stick.press(5);
  stick.release(5);
  waitUntilStill(0);
  stick.moveAxis(kY, 0);
  stick.moveAxis(kX, kLeft);
  waitUntil(0, [&, phi = at(0).phi](const auto& pose) { return std::abs(pose.phi - phi) > 0.1; });
  stick.moveAxis(kX, 0);

  stick.press(1);
  remote.waitForError("joystick 0 drives Scout1");
  stick.release(1);
  const auto scout = at(1);
  stick.press(3);
  waitUntil(1, [&](const auto& pose) { return pose.y > scout.y + 0.1; });
  stick.release(3);
  remote.waitForOutput("Scout1: ");
  remote.interrupt();
  EXPECT_EQ(remote.wait().exit_code, 0);
  serving_.program().interrupt();
  EXPECT_EQ(serving_.program().wait().exit_code, 0);

  // The recording contains the commands: speed, turn, pan, activity, and whether the robot was driven remotely.
  bool drove_ahead = false;
  bool turned_left = false;
  bool backed = false;
  bool scout_drove = false;
  forEachObservation(rawlog_, [&](const mrpt::obs::CObservation::Ptr& observation) {
    const auto* status = dynamic_cast<const mrpt::obs::CObservationRawDAQ*>(observation.get());
    if (!status || status->AOUT_double.size() < 5 || status->AOUT_double[4] != 1) return;
    const double speed_mps = status->AOUT_double[0];
    const double turn_radps = status->AOUT_double[1];
    const bool is_pioneer = observation->sensorLabel == "Pioneer1/STATUS";
    drove_ahead |= is_pioneer && speed_mps == 1 && turn_radps == 0;  // full deflection: maximum speed of a Pioneer
    turned_left |= is_pioneer && speed_mps == 0 && std::abs(turn_radps - toRadians(99.7)) < 1e-6;
    backed |= is_pioneer && std::abs(speed_mps + 0.1) < 1e-9;  // one press of button 4
    scout_drove |= observation->sensorLabel == "Scout1/STATUS" && speed_mps > 0;
  });
  EXPECT_TRUE(drove_ahead);
  EXPECT_TRUE(turned_left);
  EXPECT_TRUE(backed);
  EXPECT_TRUE(scout_drove);
}

// A robot whose process has been replaced is driven by the same remote control: the stick that is held has no effect.
TEST_F(JoystickDrive, AStickHeldAcrossALostConnectionHasNoEffectUntilItHasBeenCentred) {
  EmulatedJoystick stick(folder_ / "dev");
  StartedProgram remote = stick.start(arguments(0));
  remote.waitForOutput("you drive");
  const auto start = at(0);
  stick.moveAxis(kX, kLeft);
  waitUntil(0, [&](const auto& pose) { return std::abs(pose.phi - start.phi) > 0.1; });
  pioneer_.signal(SIGKILL);
  remote.waitForError("Pioneer1 is down");
  pioneer_.wait();
  StartedProgram next = robot("Pioneer1", pioneer_port_);
  remote.waitForError("Pioneer1 is up");
  waitUntilStill(0);
  stick.moveAxis(kX, 0);
  waitUntilStill(0);
  stick.moveAxis(kX, kLeft);
  waitUntil(0, [&, phi = at(0).phi](const auto& pose) { return std::abs(pose.phi - phi) > 0.1; });
  stick.moveAxis(kX, 0);
}

TEST_F(JoystickDrive, NamesTheMissingDevice) {
  EmulatedJoystick stick(folder_ / "dev");
  StartedProgram remote = stick.start(arguments(7));
  remote.waitForError("no joystick 7 (/dev/input/js7): connect a joystick");
  EXPECT_TRUE(remote.isRunning()) << "it may be plugged in later";
  remote.interrupt();
  EXPECT_EQ(remote.wait().exit_code, 0);
}

}  // namespace
}  // namespace robosim
