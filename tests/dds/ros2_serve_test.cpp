// `robosim serve --ros2` and `robosim run --ros2` with a program that uses Fast DDS, as nodes of ROS 2 do.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>

#include <gtest/gtest.h>

#include "dds/testing/domain.h"
#include "mcap/reader.h"
#include "tests/dds/fast_dds_peer.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using dds::eventually;
using dds::testDomain;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kMaze = ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml";

/// All messages of a topic.
class Received {
 public:
  Received(fast::Peer& peer, const std::string& topic, const char* type, const fast::Qos& qos = {true, false, 1000})
      : reader_(peer.reader("rt" + topic, type, qos, [this](Bytes message) {
          const std::lock_guard lock(mutex_);
          messages_.push_back(std::move(message));
        })) {}
  std::vector<Bytes> all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  std::size_t count() const { return all().size(); }
  bool isMatched() const { return reader_->matched() > 0; }

 private:
  mutable std::mutex mutex_;
  std::vector<Bytes> messages_;
  std::unique_ptr<fast::Peer::Endpoint> reader_;
};

/// Sends a message again and again until it has its effect: a reader that has just been found may miss the first.
template <fast::Message M, typename Condition>
bool sendUntil(fast::Peer::Endpoint& writer, const M& message, const Condition& is_so) {
  int polls = 0;
  return eventually([&] {
    if (polls++ % 100 == 0) writer.write(fast::encode(message));
    return is_so();
  });
}

double xOf(const Bytes& odometry) { return fast::decode<fast::Odometry>(odometry).pose.pose.position.x; }
double yOf(const Bytes& odometry) { return fast::decode<fast::Odometry>(odometry).pose.pose.position.y; }

std::vector<std::string> arguments(const std::string& command, const std::vector<std::string>& more) {
  std::vector<std::string> all{
      command, kMaze, "--controller", "still", "--ros2", "--domain", std::to_string(testDomain())};
  if (command == "serve") all.insert(all.end(), {"--listen", "127.0.0.1:0"});
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string digestOf(const std::string& summary) {
  const auto at = summary.find("digest");
  return at == std::string::npos ? "none in " + summary : summary.substr(at, 27);
}

TEST(Ros2Serve, DrivesARobotAndStopsItWithoutCommands) {
  fast::Peer peer(testDomain());
  Received odometry(peer, "/Pioneer1/ground_truth", fast::Odometry::kDdsType, {false, false, 5});
  const auto commands = peer.writer("rt/Pioneer1/cmd_vel", fast::Twist::kDdsType, {});
  StartedProgram robosim(arguments("serve", {"--speed", "4"}));
  ASSERT_TRUE(eventually([&] { return odometry.count() > 0 && commands->matched() == 1; })) << robosim.error();
  const double start_m = xOf(odometry.all().front());
  const auto distance_m = [&] { return std::abs(xOf(odometry.all().back()) - start_m); };
  fast::Twist forwards;
  forwards.linear.x = 0.2;
  ASSERT_TRUE(sendUntil(*commands, forwards, [&] { return distance_m() > 0.05; })) << robosim.error();
  // Without commands, two messages after another have the same position.
  ASSERT_TRUE(eventually([&] {
    const auto all = odometry.all();
    return xOf(all[all.size() - 1]) == xOf(all[all.size() - 2]);
  }));
  robosim.waitForError("Pioneer1 stops: no message from ROS 2 for 0.5 s");
  EXPECT_NE(robosim.error().find("drive Pioneer1"), std::string::npos) << robosim.error();
  robosim.interrupt();
  EXPECT_EQ(robosim.wait().exit_code, 0);
}

TEST(Ros2Serve, RefusesOtherMachinesUnlessTheyAreTrusted) {
  const std::string serve = std::string("serve ") + kMaze + " --controller still --listen 127.0.0.1:0 --ros2 ";
  for (const char* const options : {"--ros2-interface eth0", "--ros2-peer 192.0.2.7"}) {
    const Ended refused = runProgram(serve + options);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.err.find("add --ros2-unprotected"), std::string::npos) << refused.err;
  }
  const Ended no_domain = runProgram(serve + "--domain 233");
  EXPECT_EQ(no_domain.exit_code, 1);
  EXPECT_NE(no_domain.err.find("--domain"), std::string::npos) << no_domain.err;
  EXPECT_NE(no_domain.err.find("232"), std::string::npos) << no_domain.err;
  EXPECT_EQ(runProgram(serve + "--namespace 1team").exit_code, 1);
}

TEST(Ros2Serve, DoesNotLetProgramsWithoutTokensDriveBesideTokens) {
  const auto tokens = emptyFolder() / "tokens";
  std::ofstream(tokens) << "operator-0123456789abcdef operator\n";
  std::filesystem::permissions(tokens, std::filesystem::perms::owner_read);
  StartedProgram robosim(arguments("serve", {"--tokens", tokens, "--speed", "1"}));
  robosim.waitForError("this machine only, without driving");
  robosim.interrupt();
  robosim.wait();
  const Ended supervised = runProgram(std::string("serve ") + kMaze + " --ros2 --ros2-supervise --tokens " +
                                      quoted(tokens) + " --listen 127.0.0.1:0");
  EXPECT_EQ(supervised.exit_code, 1);
  EXPECT_NE(supervised.err.find("--ros2-supervise: with --tokens"), std::string::npos) << supervised.err;
}

TEST(Ros2Serve, PublishesWhatARecordingContains) {
  const auto file = emptyFolder() / "run.mcap";
  fast::Peer peer(testDomain());
  const std::map<std::string, const char*> types{{"/clock", fast::Clock::kDdsType},
                                                 {"/tf", fast::TFMessage::kDdsType},
                                                 {"/Pioneer1/odom", fast::Odometry::kDdsType},
                                                 {"/Pioneer1/ground_truth", fast::Odometry::kDdsType},
                                                 {"/Pioneer1/scan", fast::LaserScan::kDdsType},
                                                 {"/Pioneer1/sonar/points", fast::PointCloud2::kDdsType},
                                                 {"/Pioneer1/sonar/range_3", fast::Range::kDdsType},
                                                 {"/Pioneer1/compass", fast::Imu::kDdsType},
                                                 {"/Pioneer1/heat", fast::Temperature::kDdsType},
                                                 {"/Pioneer1/bumper", fast::UInt8MultiArray::kDdsType},
                                                 {"/Scout1/odom", fast::Odometry::kDdsType}};
  std::map<std::string, std::unique_ptr<Received>> received;
  for (const auto& [topic, type] : types) received[topic] = std::make_unique<Received>(peer, topic, type);
  Received map(peer, "/map", fast::OccupancyGrid::kDdsType, {true, true, 1});
  Received static_transforms(peer, "/tf_static", fast::TFMessage::kDdsType, {true, true, 1});
  Received objects(peer, "/objects", fast::MarkerArray::kDdsType, {true, true, 1});
  StartedProgram robosim({"serve", kMaze, "--controller", "gold_finder", "--ros2", "--domain",
                          std::to_string(testDomain()), "--listen", "127.0.0.1:0", "--speed", "4", "--record", file});
  ASSERT_TRUE(eventually([&] {
    return map.count() > 0 && static_transforms.count() > 0 && objects.count() > 0 &&
           std::all_of(received.begin(), received.end(), [](const auto& entry) { return entry.second->count() >= 5; });
  })) << robosim.error();
  robosim.interrupt();
  EXPECT_EQ(robosim.wait().exit_code, 0);

  std::map<std::string, std::vector<Bytes>> recorded;
  mcap::Reader reader(file);
  while (const auto message = reader.next()) {
    Bytes bytes(message->data.begin(), message->data.end());
    bytes.resize((bytes.size() + 3) / 4 * 4);  // as DDS transports it
    recorded[reader.channels().at(message->channel).topic].push_back(std::move(bytes));
  }
  for (const auto& [topic, of_topic] : received) {
    // In order; a program that gets no processor time may lose some.
    const std::vector<Bytes>& expected = recorded.at(topic);
    auto next = expected.begin();
    for (const Bytes& message : of_topic->all()) {
      next = std::find(next, expected.end(), message);
      ASSERT_NE(next, expected.end()) << topic;
      ++next;
    }
  }
  const auto live_map = fast::decode<fast::OccupancyGrid>(map.all().at(0));  // its time is that of the request
  const auto recorded_map = fast::decode<fast::OccupancyGrid>(recorded.at("/map").at(0));
  EXPECT_EQ(live_map.data, recorded_map.data);
  EXPECT_EQ(live_map.info.width, recorded_map.info.width);
  EXPECT_EQ(live_map.info.origin.position.x, recorded_map.info.origin.position.x);
  const auto transforms = fast::decode<fast::TFMessage>(static_transforms.all().at(0)).transforms;
  EXPECT_EQ(transforms.at(0).header.frame_id, "Pioneer1/base_link");
}

TEST(Ros2Serve, PublishesRangesWithoutVarianceForHumble) {
  fast::Peer peer(testDomain());
  Received ranges(peer, "/Pioneer1/sonar/range_3", fast::Range::kDdsType);
  Received of_truth(peer, "/Pioneer1/ground_truth", fast::Odometry::kDdsType);
  StartedProgram robosim(arguments("run", {"--speed", "4", "--time", "1000", "--ros2-distribution", "humble"}));
  ASSERT_TRUE(eventually([&] { return ranges.count() > 0 && of_truth.count() > 0; })) << robosim.error();
  robosim.interrupt();
  robosim.wait();
  // The header of CDR, stamp, "Pioneer1/sonar_3" with its length, the kind of radiation, four numbers.
  const std::size_t text_end = 4 + 8 + 4 + std::string("Pioneer1/sonar_3").size() + 1;
  const std::size_t numbers = (text_end + 1 + 3) / 4 * 4;
  EXPECT_EQ(ranges.all().front().size(), numbers + 4 * sizeof(float));
}

TEST(Ros2Serve, DoesNotChangeARun) {
  const std::vector<std::string> serve{"serve",    kMaze,         "--controller", "gold_finder",
                                       "--listen", "127.0.0.1:0", "--time",       "3"};
  StartedProgram plain(serve);
  const std::string digest = digestOf(plain.wait().out);
  fast::Peer peer(testDomain());
  Received scans(peer, "/Pioneer1/scan", fast::LaserScan::kDdsType);
  Received map(peer, "/map", fast::OccupancyGrid::kDdsType, {true, true, 1});
  std::vector<std::string> with_ros2 = serve;
  with_ros2.insert(with_ros2.end(), {"--ros2", "--domain", std::to_string(testDomain()), "--paused"});
  StartedProgram robosim(with_ros2);
  robosim.waitForError("listening on ");
  ASSERT_TRUE(eventually([&] { return scans.isMatched() && map.count() > 0; })) << robosim.error();
  const std::string log = robosim.error();
  const std::size_t address = log.find("listening on ") + std::string("listening on ").size();
  const Ended started = runProgram("control " + log.substr(address, log.find('\n', address) - address) + " start");
  EXPECT_EQ(started.exit_code, 0) << started.err;
  EXPECT_EQ(digestOf(robosim.wait().out), digest);
  EXPECT_TRUE(eventually([&] { return scans.count() > 0; })) << "they may arrive after the end of the program";
}

TEST(Ros2Serve, PlacesAddsAndRemovesRobots) {
  fast::Peer peer(testDomain());
  Received truth(peer, "/team/Pioneer1/ground_truth", fast::Odometry::kDdsType, {false, false, 5});
  const auto place = peer.writer("rt/team/Pioneer1/initialpose", fast::PoseWithCovarianceStamped::kDdsType, {});
  const auto spawn = peer.writer("rt/team/robosim/spawn", fast::String::kDdsType, {});
  const auto remove = peer.writer("rt/team/robosim/remove", fast::String::kDdsType, {});
  const auto commands = peer.writer("rt/team/New/cmd_vel", fast::TwistStamped::kDdsType, {});
  StartedProgram robosim(
      arguments("run", {"--speed", "2", "--time", "1000", "--namespace", "team", "--ros2-supervise"}));
  ASSERT_TRUE(eventually([&] {
    return truth.count() > 0 && place->matched() == 1 && spawn->matched() == 1 && remove->matched() == 1;
  })) << robosim.error();
  fast::PoseWithCovarianceStamped pose;
  pose.header.frame_id = "map";
  pose.pose.pose.position.x = xOf(truth.all().back()) + 0.1;
  pose.pose.pose.position.y = yOf(truth.all().back());
  pose.pose.pose.orientation.w = 1;
  EXPECT_TRUE(sendUntil(*place, pose, [&] { return xOf(truth.all().back()) == pose.pose.pose.position.x; }))
      << robosim.error();

  Received of_new(peer, "/team/New/odom", fast::Odometry::kDdsType);
  ASSERT_TRUE(sendUntil(*spawn, fast::String{R"(<robot name="New" model="scout" x="0" y="0"/>)"}, [&] {
    return of_new.count() > 0 && commands->matched() == 1;
  })) << robosim.error();
  fast::TwistStamped forwards;
  forwards.twist.linear.x = 0.2;
  EXPECT_TRUE(sendUntil(*commands, forwards, [&] { return xOf(of_new.all().back()) > 0.02; })) << robosim.error();
  EXPECT_TRUE(sendUntil(*remove, fast::String{"New"}, [&] {
    return robosim.error().find("<remove name=\"New\"/>") != std::string::npos;
  })) << robosim.error();
  robosim.interrupt();
  robosim.wait();
}

}  // namespace
}  // namespace robosim
