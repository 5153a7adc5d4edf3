// ArcosHardware: the controllers of simulated robots drive robots that speak ARCOS.
#include "arcos/client/arcos_hardware.h"

#include <cmath>

#include <gtest/gtest.h>

#include "arcos/client/open_channel.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/sip.h"
#include "base/angle_units.h"
#include "base/random.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/simulated_arcos_robot.h"

namespace robosim {
namespace {

using arcos::encodeCommand;

/// Speeds and turns for 30 s, with stops and reversals; within what a pioneer3dx can do.
Command scripted(std::uint64_t step) {
  constexpr double kSpeeds_mps[] = {0.3, 0.7, 0.45, 0, -0.25, 0.61};
  constexpr double kTurns_radps[] = {0, 0.2, -0.433, 0.9, 0.123, -1.1};
  const std::size_t part = step / 50 % std::size(kSpeeds_mps);
  return {.speed_mps = kSpeeds_mps[part], .turn_radps = kTurns_radps[part]};
}

TEST(ArcosHardware, ReproducesTheTrajectoryOfLocalHardwareWithinTheRoundingOfPackets) {
  const auto environment = robotAlone("pioneer3dx");
  LocalHardware local(*environment, 0);
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware remote(robot.channel(), robot.options());
  int changes = 0;
  for (std::uint64_t step = 0; step < 300; ++step) {
    if (step == 0 || scripted(step) != scripted(step - 1)) ++changes;
    local.command(scripted(step));
    environment->step();
    remote.command(scripted(step));
    ASSERT_TRUE(remote.nextStep());
    const State& state = environment->state();
    const auto& expected = state.world_from_robot[0];
    // Turn rates are sent in whole degrees per second. What is rounded off, at most 0.5 °/s, is sent later, and lost if
    // the robot is then still reaching its new rate: at most 1 °/s for 0.1 s at each change of the command.
    // Up to 0.05° are still to be sent.
    const double turned_wrongly_deg = 0.1 * changes + 0.05;
    EXPECT_NEAR(toDegrees(std::remainder(robot.truePose().phi - expected.phi, 2 * M_PI)), 0, turned_wrongly_deg)
        << step;
    const double aside_m = toRadians(turned_wrongly_deg) * state.driven_m[0] + 0.001;
    EXPECT_NEAR(robot.truePose().x, expected.x, aside_m) << step;
    EXPECT_NEAR(robot.truePose().y, expected.y, aside_m) << step;
    EXPECT_NEAR(robot.environment().state().driven_m[0], state.driven_m[0], 0.001) << step;
  }
  EXPECT_GT(environment->state().driven_m[0], 10);
}

TEST(ArcosHardware, ReportsWhatTheRobotSensesInTheUnitsOfSimulatedRobots) {
  SimulatedArcosRobot robot("p3dx", {0.3, -0.2, 0.4}, 5);
  ArcosHardware hardware(robot.channel(), robot.options());
  for (int step = 0; step < 40; ++step) {
    hardware.command({.speed_mps = 0.2, .turn_radps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
  }
  const Readings& expected = robot.environment().state().readings[0];
  const auto& sensors = *robot.environment().fleet().robots[0].info.sensors;
  int compared = 0;
  for (std::size_t i = 0; i < hardware.info().sensors->size(); ++i) {
    const SensorInfo& sensor = (*hardware.info().sensors)[i];
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      if (sensors[k].label != sensor.label) continue;
      ++compared;
      if (const auto* echoes = std::get_if<Echoes>(&hardware.readings().measurements[i])) {
        const auto& exact = std::get<Echoes>(expected.measurements[k]);
        ASSERT_EQ(echoes->size(), exact.size());
        for (std::size_t beam = 0; beam < exact.size(); ++beam) {
          EXPECT_NEAR((*echoes)[beam].range_m, exact[beam].range_m, 0.0006) << sensor.label << beam;
          EXPECT_NEAR((*echoes)[beam].point_m.x, exact[beam].point_m.x, 0.001) << sensor.label << beam;
        }
      } else if (const auto* odometry = std::get_if<Odometry>(&hardware.readings().measurements[i])) {
        const auto& exact = std::get<Odometry>(expected.measurements[k]);
        EXPECT_NEAR(odometry->odom_from_robot.x, exact.odom_from_robot.x, 0.001);
        EXPECT_NEAR(odometry->odom_from_robot.y, exact.odom_from_robot.y, 0.001);
        EXPECT_NEAR(odometry->odom_from_robot.phi, exact.odom_from_robot.phi, 0.001);
        EXPECT_NEAR(odometry->speed_mps, exact.speed_mps, 0.001);
        EXPECT_NEAR(toDegrees(odometry->turn_radps - exact.turn_radps), 0, 0.06);
      } else if (sensor.kind == SensorKind::compass) {
        const double difference = std::get<Scalar>(hardware.readings().measurements[i]).value -
                                  std::get<Scalar>(expected.measurements[k]).value;
        EXPECT_NEAR(toDegrees(std::remainder(difference, 2 * M_PI)), 0, 2.01) << "sent in units of 2°";
      } else if (sensor.kind == SensorKind::bumper) {
        EXPECT_EQ(std::get<Contacts>(hardware.readings().measurements[i]),
                  std::get<Contacts>(expected.measurements[k]));
      }
    }
  }
  EXPECT_EQ(compared, 5) << "sonar, laser, bumper, odometry, compass";
  EXPECT_FALSE(hardware.readings().stalled);
}

TEST(ArcosHardware, LeavesTheLaserOfASimulatorOffOnRequest) {
  SimulatedArcosRobot robot;
  ArcosHardware::Options options = robot.options();
  options.requests_laser = false;
  ArcosHardware hardware(robot.channel(), std::move(options));
  ASSERT_TRUE(hardware.nextStep());
  EXPECT_EQ(robot.session().lasers()[0].form, arcos::LaserRequest::Form::off);
  for (const SensorInfo& sensor : *hardware.info().sensors) EXPECT_NE(sensor.kind, SensorKind::laser);
  EXPECT_NE(robot.log_text.find("laser"), std::string::npos) << "it is listed as not available: " << robot.log_text;
}

TEST(ArcosHardware, LogsTheSensorsThatTheRobotLacks) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  EXPECT_NE(robot.log_text.find("connected to MobileSim (p3dx) at memory; not available: CheckWin, heat"),
            std::string::npos)
      << robot.log_text;
  EXPECT_EQ(hardware.referee(), nullptr);
  EXPECT_THROW(hardware.send("other", "text"), std::invalid_argument);
}

TEST(ArcosHardware, StopsAtABatteryThatIsLowAndStatesIt) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  const auto drive = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      hardware.command({.speed_mps = 0.3});
      ASSERT_TRUE(hardware.nextStep());
    }
  };
  drive(15);
  EXPECT_GT(robot.environment().state().speed_mps[0], 0.2);
  robot.session().receive(encodeCommand(arcos::command::battest, 110), robot.now());
  drive(20);
  EXPECT_EQ(robot.environment().state().speed_mps[0], 0);
  EXPECT_EQ(hardware.baseState().stop_reason, "the battery is low");
  EXPECT_NE(robot.log_text.find("the robot stops: the battery is low"), std::string::npos);
  robot.session().receive(encodeCommand(arcos::command::battest, 0), robot.now());
  drive(15);
  EXPECT_GT(robot.environment().state().speed_mps[0], 0.2);
  EXPECT_EQ(hardware.baseState().stop_reason, "");
}

TEST(ArcosHardware, StopsWhileTheEmergencyStopIsPressedAndStatesIt) {
  SimulatedArcosRobot robot("pioneer3dx");
  bool is_pressed = false;
  const auto with_button = [&is_pressed](const std::string& bytes) {
    std::string changed;
    arcos::PacketReader reader;
    reader.add(bytes);
    while (const auto packet = reader.next()) {
      auto sip = arcos::decodeSip(*packet);
      if (sip && is_pressed) sip->flags |= arcos::Sip::kEstopPressed;
      changed += sip ? encode(*sip) : encode(*packet);
    }
    return changed;
  };
  ArcosHardware hardware(robot.channel({}, with_button), robot.options());
  for (const bool pressed : {false, true, false}) {
    is_pressed = pressed;
    for (int i = 0; i < 15; ++i) {
      hardware.command({.speed_mps = 0.3});
      ASSERT_TRUE(hardware.nextStep());
    }
    EXPECT_EQ(robot.environment().state().speed_mps[0] == 0, pressed);
    EXPECT_EQ(hardware.baseState().stop_reason, pressed ? "the emergency stop is pressed" : "");
    EXPECT_EQ(hardware.baseState().estop_pressed, pressed);
  }
}

TEST(ArcosHardware, StandsBeforeItClosesTheSession) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  for (int i = 0; i < 15; ++i) {
    hardware.command({.speed_mps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
  }
  hardware.close();
  EXPECT_NEAR(robot.environment().state().speed_mps[0], 0, 1e-9);
  EXPECT_EQ(robot.session().endReason(), "it has closed the session");
}

// ESTOP, at 2 m/s² from 0.3 m/s; without it, the robot would take ten cycles to stand.
TEST(ArcosHardware, MakesAnEmergencyStopByTheBoard) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  for (int i = 0; i < 15; ++i) {
    hardware.command({.speed_mps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
  }
  EXPECT_NEAR(robot.environment().state().speed_mps[0], 0.3, 1e-9);
  hardware.command({.speed_mps = 0.3, .emergency_stop = true});
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(hardware.nextStep());
  EXPECT_EQ(robot.environment().state().speed_mps[0], 0);
  hardware.command({.speed_mps = 0.3});
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(hardware.nextStep());
  EXPECT_GT(robot.environment().state().speed_mps[0], 0) << "it may drive again";
}

TEST(ArcosHardware, TakesStepsUntilItStandsWhenItIsInterrupted) {
  SimulatedArcosRobot robot("pioneer3dx");
  auto options = robot.options();
  bool is_interrupted = false;
  options.interrupted = [&] { return is_interrupted; };
  ArcosHardware hardware(robot.channel(), std::move(options));
  for (int i = 0; i < 15; ++i) {
    hardware.command({.speed_mps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
  }
  is_interrupted = true;
  EXPECT_FALSE(hardware.nextStep());
  std::vector<std::uint64_t> steps;
  const std::uint64_t before = hardware.readings().time.step;
  hardware.close([&] { steps.push_back(hardware.readings().time.step); });
  // From 0.3 m/s at 0.3 m/s²: ten cycles of 0.1 s, and those of the packets on their way.
  EXPECT_GE(steps.size(), 10u);
  EXPECT_LE(steps.size(), 13u);
  EXPECT_EQ(steps.back(), before + steps.size());
  const auto& sensors = *hardware.info().sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].kind != SensorKind::odometry) continue;
    const auto& odometry = std::get<Odometry>(hardware.readings().measurements[i]);
    EXPECT_EQ(odometry.speed_mps, 0) << "the last readings are those of the standing robot";
    EXPECT_NEAR(odometry.odom_from_robot.x, robot.truePose().x, 0.001);
  }
}

TEST(ArcosHardware, RequestsNoSimulatedScansOverALineThatDoesNotCarryThem) {
  /// A channel over a slow line.
  class SlowChannel : public ByteChannel {
   public:
    SlowChannel(std::unique_ptr<ByteChannel> channel, double capacity)
        : channel_(std::move(channel)), capacity_(capacity) {}
    std::string read(Clock::duration timeout) override { return channel_->read(timeout); }
    void write(std::string_view bytes) override { channel_->write(bytes); }
    Clock::time_point now() const override { return channel_->now(); }
    std::optional<double> capacity() const override { return capacity_; }
    const std::string& name() const override { return channel_->name(); }

   private:
    std::unique_ptr<ByteChannel> channel_;
    double capacity_;
  };
  const auto has_laser = [](const ArcosHardware& hardware) {
    const auto& sensors = *hardware.info().sensors;
    return std::any_of(sensors.begin(), sensors.end(),
                       [](const SensorInfo& sensor) { return sensor.kind == SensorKind::laser; });
  };
  // 181 beams: five packets of 173 bytes and one of 118 in each cycle of 0.1 s, 9,830 bytes/s.
  SimulatedArcosRobot slow("p3dx"), fast("p3dx");
  const ArcosHardware at_9600(std::make_unique<SlowChannel>(slow.channel(), 960), slow.options());
  EXPECT_FALSE(has_laser(at_9600));
  EXPECT_NE(slow.log_text.find("need a line of 108300 baud"), std::string::npos) << slow.log_text;
  const ArcosHardware at_115200(std::make_unique<SlowChannel>(fast.channel(), 11520), fast.options());
  EXPECT_TRUE(has_laser(at_115200));
}

TEST(ArcosHardware, StopsWhenItsMotorsAreDisabledAndStatesIt) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  const auto drive = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      hardware.command({.speed_mps = 0.3});
      ASSERT_TRUE(hardware.nextStep());
    }
  };
  drive(15);
  robot.session().receive(encodeCommand(arcos::command::enable, 0), robot.now());
  drive(15);
  EXPECT_EQ(robot.environment().state().speed_mps[0], 0);
  EXPECT_EQ(hardware.baseState().motors_enabled, false);
  EXPECT_EQ(hardware.baseState().stop_reason, "the motors are disabled");
  hardware.enableMotors(true);
  drive(15);
  EXPECT_GT(robot.environment().state().speed_mps[0], 0.2);
}

TEST(ArcosHardware, ReportsARobotThatHasFallenSilent) {
  SimulatedArcosRobot robot("pioneer3dx");
  ArcosHardware hardware(robot.channel(), robot.options());
  for (int i = 0; i < 15; ++i) {
    hardware.command({.speed_mps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
  }
  robot.is_silent = true;
  try {
    hardware.nextStep();
    ADD_FAILURE() << "no error";
  } catch (const RobotLinkError& error) {
    EXPECT_EQ(std::string(error.what()),
              "the robot at memory has sent nothing for 8 s; it has stopped by its watchdog");
  }
  EXPECT_NE(robot.log_text.find("the robot has sent nothing for 1 s"), std::string::npos);
  EXPECT_EQ(robot.environment().state().speed_mps[0], 0);
}

TEST(ArcosHardware, NamesAnAddressAtWhichNoRobotAnswers) {
  SimulatedArcosRobot robot("pioneer3dx");
  robot.is_silent = true;
  try {
    ArcosHardware(robot.channel(), robot.options());
    ADD_FAILURE() << "no error";
  } catch (const RobotLinkError& error) {
    EXPECT_EQ(std::string(error.what()), "no robot answers at memory; check that it is on, and its cable or address");
  }
}

/// Changes bytes at random: flips, loses, repeats, cuts off.
SimulatedArcosRobot::Noise noise(std::uint32_t seed, std::uint32_t one_of, const bool& is_on) {
  return [rng = Rng(seed), one_of, &is_on](std::string bytes) mutable {
    if (!is_on || bytes.empty() || rng.below(one_of) != 0) return bytes;
    const std::size_t at = rng.below(static_cast<std::uint32_t>(bytes.size()));
    switch (rng.below(4)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
        break;
      case 1:
        bytes.erase(at, 1);
        break;
      case 2:
        bytes.insert(at, 1, bytes[at]);
        break;
      default:
        bytes.resize(at);
    }
    return bytes;
  };
}

TEST(ArcosHardware, NeverMovesWronglyOnALineThatChangesBytes) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SimulatedArcosRobot robot("pioneer3dx");
    bool is_on = false;
    ArcosHardware hardware(robot.channel(noise(seed, 3, is_on), noise(seed + 100, 3, is_on)), robot.options());
    is_on = true;
    const double start_heading = robot.truePose().phi;
    mrpt::math::TPose2D before = robot.truePose();
    std::uint64_t step_before = robot.environment().time().step;
    for (int step = 0; step < 300; ++step) {
      hardware.command({.speed_mps = 0.3});
      ASSERT_TRUE(hardware.nextStep());
      // Only one command is ever sent: straight on at 0.3 m/s. Lost packets can only stop the robot.
      ASSERT_EQ(robot.truePose().phi, start_heading) << "seed " << seed << " step " << step;
      ASSERT_GE(robot.truePose().x, before.x) << "seed " << seed << " step " << step;
      const std::uint64_t now = robot.environment().time().step;
      ASSERT_LE(robot.truePose().x - before.x, 0.03 * static_cast<double>(now - step_before) + 1e-9)
          << "seed " << seed << " step " << step;
      before = robot.truePose();
      step_before = now;
    }
    EXPECT_GT(robot.truePose().x, 5) << "seed " << seed << ": it drives in spite of the noise";
    const auto& odometry = std::get<Odometry>(hardware.readings().measurements[3]);
    EXPECT_NEAR(odometry.odom_from_robot.x, robot.truePose().x, 0.1) << "seed " << seed;
  }
}

TEST(ArcosHardware, RepeatsTheReadingsOfALog) {
  const auto log = emptyFolder() / "arcos.log";
  std::vector<Readings> recorded;
  {
    SimulatedArcosRobot robot("p3dx", {}, 5);
    ArcosHardware hardware(logChannel(robot.channel(), log.string()), robot.options());
    do {
      recorded.push_back(hardware.readings());
      hardware.command(scripted(recorded.size()));
    } while (hardware.nextStep() && recorded.size() < 100);
  }
  SimulatedArcosRobot other("p3dx");  // for its options only
  ArcosHardware replayed(openChannel("replay:" + log.string()), other.options());
  for (const Readings& readings : recorded) {
    ASSERT_EQ(replayed.readings(), readings) << readings.time.step;
    replayed.nextStep();
  }
  EXPECT_FALSE(replayed.nextStep());
  EXPECT_NE(other.log_text.find("the log has ended"), std::string::npos);
}

TEST(ArcosHardware, ExplainsWrongAddressesAndLogs) {
  const auto error_of = [](const std::string& address) {
    try {
      openChannel(address);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const auto* wrong : {"", "8101", "tcp:", "tcp:host:x", "udp:host:1", "serial:"}) {
    EXPECT_NE(error_of(wrong).find("must be tcp:HOST:PORT, serial:DEVICE or replay:FILE"), std::string::npos) << wrong;
  }
  EXPECT_NE(error_of("serial:/dev/no_such_line").find("No such file or directory"), std::string::npos);
  EXPECT_NE(error_of("replay:" ROBOSIM_SOURCE_DIR "/README.md").find("README.md:1: is no log of --arcos-log"),
            std::string::npos)
      << error_of("replay:" ROBOSIM_SOURCE_DIR "/README.md");
  EXPECT_EQ(error_of("replay:/dev/zero"), "/dev/zero: is a character device; name a regular file or a pipe");
}

}  // namespace
}  // namespace robosim
