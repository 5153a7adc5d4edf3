// ArcosHardware at a serial line of 9,600 baud: a pseudo-terminal, with a relay that passes 960 bytes per second in
// each direction between it and a simulated robot.
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>  // Boost.Asio 1.74 uses std::exchange without it

#include <boost/asio.hpp>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include "arcos/client/open_channel.h"
#include "serving/arcos_server.h"
#include "tests/scenarios/simulated_arcos_robot.h"

namespace robosim {
namespace {

using boost::asio::ip::tcp;

/// Steps a served robot every 0.1 s, as robosim serve does.
class RealTimeRobot {
 public:
  RealTimeRobot() : environment_(robotAlone("p3dx")), server_(options(), *environment_, {0}) {
    thread_ = std::thread([this] {
      for (auto due = std::chrono::steady_clock::now(); !ends_; due += std::chrono::milliseconds(100)) {
        while (std::chrono::steady_clock::now() < due) {
          server_.poll();
          std::this_thread::sleep_until(std::min(due, std::chrono::steady_clock::now() + ArcosServer::kPollInterval));
        }
        server_.decide();
        environment_->step();
        server_.stepped();
      }
    });
  }
  ~RealTimeRobot() {
    ends_ = true;
    thread_.join();
  }
  int port() const { return server_.ports().front(); }

 private:
  static ArcosOptions options() {
    ArcosOptions options;
    options.listen = "127.0.0.1:0";
    return options;
  }
  std::unique_ptr<Environment> environment_;
  ArcosServer server_;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

/// Passes bytes between a port and a new pseudo-terminal at the rate of a serial line.
class SerialRelay {
 public:
  explicit SerialRelay(int port) : terminal_(posix_openpt(O_RDWR | O_NOCTTY)), socket_(io_) {
    EXPECT_EQ(grantpt(terminal_), 0);
    EXPECT_EQ(unlockpt(terminal_), 0);
    device_ = ptsname(terminal_);
    // The other end, kept open, so that the terminal stays while the program opens and closes it.
    line_ = open(device_.c_str(), O_RDWR | O_NOCTTY);
    termios raw{};
    tcgetattr(line_, &raw);
    cfmakeraw(&raw);
    tcsetattr(line_, TCSANOW, &raw);
    fcntl(terminal_, F_SETFL, O_NONBLOCK);
    socket_.connect({boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
    socket_.non_blocking(true);
    thread_ = std::thread([this] { relay(); });
  }
  ~SerialRelay() {
    ends_ = true;
    thread_.join();
    close(line_);
    close(terminal_);
  }
  const std::string& device() const { return device_; }

 private:
  void relay() {
    constexpr std::size_t kPerTick = 24;  // 960 bytes/s
    for (auto due = std::chrono::steady_clock::now(); !ends_; due += std::chrono::milliseconds(25)) {
      std::this_thread::sleep_until(due);
      std::array<char, 4096> bytes;
      boost::system::error_code error;
      to_line_.append(bytes.data(), socket_.read_some(boost::asio::buffer(bytes), error));
      if (const auto size = read(terminal_, bytes.data(), bytes.size()); size > 0) {
        to_robot_.append(bytes.data(), static_cast<std::size_t>(size));
      }
      const std::string down = to_line_.substr(0, kPerTick), up = to_robot_.substr(0, kPerTick);
      if (!down.empty() && write(terminal_, down.data(), down.size()) > 0) to_line_.erase(0, down.size());
      to_robot_.erase(0, socket_.write_some(boost::asio::buffer(up), error));
    }
  }

  int terminal_, line_ = -1;
  std::string device_;
  boost::asio::io_context io_;
  tcp::socket socket_;
  std::string to_line_, to_robot_;  ///< on their way
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

TEST(ArcosSerialLine, KeepsEveryCycleAt960BytesPerSecond) {
  RealTimeRobot robot;
  SerialRelay relay(robot.port());
  ArcosHardware::Options options;
  std::string log;
  options.type_of = [](const std::string& subclass) { return readArcosType(subclass); };
  options.log = [&](const std::string& line) { log += line + '\n'; };
  ArcosHardware hardware(openChannel("serial:" + relay.device() + ":9600"), std::move(options));
  EXPECT_NE(log.find("the scans of 'laser' need a line of 108300 baud"), std::string::npos) << log;
  EXPECT_NE(log.find("not available: CheckWin, laser"), std::string::npos) << log;
  const auto x_m = [&] { return std::get<Odometry>(hardware.readings().measurements[2]).odom_from_robot.x; };
  // Until it drives at 0.3 m/s; then each SIP adds 30 mm, of units of 0.485 mm, unless one is lost.
  double before_m = x_m();
  std::uint64_t sips_before = hardware.sips();
  int steady = 0;
  for (int step = 0; step < 60 && steady < 25; ++step) {
    hardware.command({.speed_mps = 0.3});
    ASSERT_TRUE(hardware.nextStep());
    const double driven_m = x_m() - before_m;
    const auto sips = static_cast<double>(hardware.sips() - sips_before);
    before_m = x_m();
    sips_before = hardware.sips();
    if (steady == 0 && driven_m <= 0.0295 * sips) continue;
    EXPECT_NEAR(driven_m, 0.03 * sips, 0.0005) << "cycle " << step;
    ++steady;
  }
  EXPECT_EQ(steady, 25);
}

}  // namespace
}  // namespace robosim
