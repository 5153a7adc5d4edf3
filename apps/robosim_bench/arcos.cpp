// Robots served to ARCOS programs: the interval of their packets, and the time from a command to the packet that shows
// it.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

#include <CLI/CLI.hpp>
#include <boost/asio.hpp>
#include <nlohmann/json.hpp>

#include "arcos/client/arcos_client.h"
#include "arcos/protocol/command.h"
#include "arcos/protocol/laser_packets.h"
#include "base/seconds.h"
#include "base/temporary_directory.h"
#include "base/text_table.h"
#include "robosim/arguments.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/child_program.h"
#include "robosim_bench/rounds.h"

namespace robosim {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Clock = std::chrono::steady_clock;

struct ArcosArguments {
  int robots = 1000;
  double time_s = 20;
  bool json = false;
};

/// One program: drives, requests the default scan, and notes when packets arrive.
class BenchProgram {
 public:
  BenchProgram(asio::io_context& io, std::uint16_t port) : socket_(io) {
    socket_.connect({asio::ip::address_v4::loopback(), port});
    socket_.set_option(tcp::no_delay(true));
    send(client_.receive({}, Clock::now()));
    receive();
  }

  /// Forgets what has been measured so far.
  void restart() {
    intervals_s.clear();
    latencies_s.clear();
    scans_before_ = client_.scans();
  }
  bool isReady() const { return client_.isReady(); }
  std::uint64_t scans() const { return client_.scans() - scans_before_; }
  /// Sends a command with another speed, and measures the time until a packet shows it.
  void changeSpeed() {
    if (asked_) return;
    speed_before_ = client_.sip().speed_left;
    speed_mmps_ = speed_mmps_ > 0 ? -200 : 200;
    send(arcos::encodeCommand(arcos::command::vel, speed_mmps_));
    asked_ = Clock::now();
  }

  std::vector<double> intervals_s;  ///< between two SIPs
  std::vector<double> latencies_s;

 private:
  void send(const std::string& bytes) {
    if (!bytes.empty()) asio::write(socket_, asio::buffer(bytes));
  }
  void receive() {
    socket_.async_read_some(asio::buffer(buffer_), [this](const boost::system::error_code& error, std::size_t size) {
      if (error) return;
      const std::uint64_t sips = client_.sips();
      const bool was_ready = client_.isReady();
      send(client_.receive({buffer_.data(), size}, Clock::now()));
      if (client_.isReady() && !was_ready) begin();
      if (client_.sips() > sips) noteSip();
      receive();
    });
  }
  void begin() {
    using namespace arcos;
    send(encodeCommand(command::old_laser_start, -90) + encodeCommand(command::old_laser_end, 90) +
         encodeCommand(command::old_laser_increment, 100) + encodeCommand(command::old_laser_enable, 2));
  }
  void noteSip() {
    const auto now = Clock::now();
    if (last_sip_) intervals_s.push_back(toSeconds(now - *last_sip_));
    last_sip_ = now;
    if (asked_ && client_.sip().speed_left != speed_before_) {
      latencies_s.push_back(toSeconds(now - *asked_));
      asked_.reset();
    }
  }

  tcp::socket socket_;
  std::array<char, 8192> buffer_;
  ArcosClient client_;
  std::optional<Clock::time_point> last_sip_, asked_;
  int speed_mmps_ = 0, speed_before_ = 0;
  std::uint64_t scans_before_ = 0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// A world file without objects, large enough for the robots.
class EmptyWorldFile {
 public:
  explicit EmptyWorldFile(int robots) {
    const int half_m = 5 + 2 * static_cast<int>(std::ceil(std::sqrt(robots)));
    const std::string low = std::to_string(-half_m), high = std::to_string(half_m);
    std::ofstream(path()) << "<world><surface><type>smooth</type><size><xmin>" << low << "</xmin><xmax>" << high
                          << "</xmax><ymin>" << low << "</ymin><ymax>" << high << "</ymax></size></surface></world>";
  }
  std::string path() const { return (folder_ / "empty.xml").string(); }

 private:
  TemporaryDirectory folder_;
};

/// A port on which no program listens.
std::uint16_t freePort(asio::io_context& io) {
  return tcp::acceptor(io, {asio::ip::address_v4::loopback(), 0}).local_endpoint().port();
}

/// @throws std::runtime_error when no program listens after a minute
void awaitPort(asio::io_context& io, std::uint16_t port, ChildProgram& server) {
  for (int i = 0; i < 600; ++i) {
    boost::system::error_code error;
    tcp::socket(io).connect({asio::ip::address_v4::loopback(), port}, error);
    if (!error) return;
    if (server.hasEnded()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw std::runtime_error("robosim serve does not listen");
}

void runFor(asio::io_context& io, double seconds) { io.run_for(fromSeconds(seconds)); }

nlohmann::ordered_json measure(const ArcosArguments& arguments) {
  const EmptyWorldFile world(arguments.robots);
  asio::io_context io;
  const std::uint16_t port = freePort(io);
  ChildProgram server({"serve", world.path(), "--listen", "127.0.0.1:0", "--arcos", std::to_string(port),
                       "--arcos-factory", "p3dx:" + std::to_string(arguments.robots)});
  awaitPort(io, port, server);  // takes a robot for a moment: one more than programs
  std::vector<std::unique_ptr<BenchProgram>> programs;
  for (int i = 0; i < arguments.robots; ++i) programs.push_back(std::make_unique<BenchProgram>(io, port));
  const auto all_ready = [&] {
    return std::all_of(programs.begin(), programs.end(), [](const auto& program) { return program->isReady(); });
  };
  for (int i = 0; i < 60 && !all_ready(); ++i) runFor(io, 1);
  if (!all_ready()) throw std::runtime_error("not all programs have completed the handshake within a minute");
  runFor(io, 2);
  for (const auto& program : programs) program->restart();
  const double cpu_before_s = Clocks::now().cpu_s, server_before_s = server.cpuSeconds();
  const auto start = Clock::now();
  while (secondsSince(start) < arguments.time_s) {
    for (const auto& program : programs) program->changeSpeed();
    runFor(io, 0.73);  // no multiple of the cycle, so that commands arrive at any time in it
  }
  const double wall_s = secondsSince(start), cpu_s = Clocks::now().cpu_s - cpu_before_s;
  const double server_s = server.cpuSeconds() - server_before_s;
  std::vector<double> intervals, latencies;
  std::uint64_t scans = 0;
  for (const auto& program : programs) {
    intervals.insert(intervals.end(), program->intervals_s.begin(), program->intervals_s.end());
    latencies.insert(latencies.end(), program->latencies_s.begin(), program->latencies_s.end());
    scans += program->scans();
  }
  const auto ms = [](double seconds) { return std::round(seconds * 1e4) / 10; };
  const double per_s = 1 / (wall_s * arguments.robots);
  return {{"robots", arguments.robots},
          {"sips_per_robot_per_s", static_cast<double>(intervals.size()) * per_s},
          {"scans_per_robot_per_s", static_cast<double>(scans) * per_s},
          {"interval_ms_median", ms(quantile(intervals, 0.5))},
          {"interval_ms_p99", ms(quantile(intervals, 0.99))},
          {"interval_ms_max", ms(quantile(intervals, 1))},
          {"latency_ms_median", ms(quantile(latencies, 0.5))},
          {"latency_ms_p99", ms(quantile(latencies, 0.99))},
          {"processors_server", server_s / wall_s},
          {"processors_programs", cpu_s / wall_s}};
}

void benchArcos(const ArcosArguments& arguments) {
  const auto figures = measure(arguments);
  if (arguments.json) {
    std::cout << figures.dump() << std::endl;
    return;
  }
  Rows rows;
  for (const auto& [name, value] : figures.items()) {
    rows.push_back({name, value.is_number_integer() ? std::to_string(value.get<long>()) : value.dump().substr(0, 7)});
  }
  std::cout << listing(rows);
}

}  // namespace

void addArcosBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("arcos",
                                         "Robots with sonar and laser of robosim serve --arcos-factory, driven by "
                                         "ARCOS programs in this process: interval "
                                         "of SIPs, and time from a command to the SIP that shows it");
  auto a = std::make_shared<ArcosArguments>();
  command->add_option("--robots", a->robots, "number of robots and programs")
      ->check(wholeNumberIn(1, 1000))
      ->capture_default_str();
  command->add_option("--time", a->time_s, "duration")
      ->check(numberIn(1, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command->add_flag("--json", a->json, "print one JSON object");
  command->callback([a] { benchArcos(*a); });
}

}  // namespace robosim
