// Messages between robosim::dds and Fast DDS, another implementation, which rmw_fastrtps uses: all types of messages,
// in both directions, over the loopback interface.
#include <cmath>
#include <mutex>
#include <optional>
#include <sstream>
#include <type_traits>

#include <gtest/gtest.h>

#include "dds/cyclone/cyclone_participant.h"
#include "dds/names.h"
#include "dds/testing/domain.h"
#include "ros/messages.h"
#include "tests/dds/fast_dds_peer.h"

namespace robosim {
namespace {

using dds::eventually;
using Bytes = std::vector<std::uint8_t>;

/// Sets the fields of messages, and lists them. The n-th value is n for an unsigned number, -n for a signed one, n +
/// 0.5 for a fraction, true or false, and "text n"; a sequence has two elements, or three.
class Values {
 public:
  template <typename T>
  void set(T& value) {
    if constexpr (fast::Message<T>) {
      value.fields([this](auto&... field) { (set(field), ...); });
    } else if constexpr (ros::Message<T>) {
      T::describe(value, [this](const char*, auto& field) { set(field); });
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "text " + std::to_string(++count_);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = ++count_ % 2 == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(++count_) + T(0.5);
    } else if constexpr (sizeof(T) == 1) {
      value = static_cast<T>(++count_ % 100);
    } else {
      ++count_;
      value = static_cast<T>(std::is_signed_v<T> ? -count_ : count_);
    }
  }
  template <typename T>
  void set(std::vector<T>& sequence) {
    sequence.resize(2 + static_cast<std::size_t>(count_ % 2));
    for (auto& element : sequence) set(element);
  }
  template <typename T, std::size_t size>
  void set(std::array<T, size>& array) {
    for (auto& element : array) set(element);
  }

 private:
  int count_ = 0;
};

/// All values of a message in order, and the sizes of its sequences.
class Listing {
 public:
  template <typename T>
  void add(T& value) {
    using Value = std::remove_const_t<T>;
    if constexpr (fast::Message<Value>) {
      value.fields([this](auto&... field) { (add(field), ...); });
    } else if constexpr (ros::Message<Value>) {
      Value::describe(value, [this](const char*, auto& field) { add(field); });
    } else {
      text_ << +value << ' ';
    }
  }
  void add(std::string& value) { text_ << '"' << value << "\" "; }
  template <typename T>
  void add(std::vector<T>& sequence) {
    text_ << '[' << sequence.size() << "] ";
    for (auto& element : sequence) add(element);
  }
  template <typename T, std::size_t size>
  void add(std::array<T, size>& array) {
    for (auto& element : array) add(element);
  }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

template <typename M>
M filled() {
  M message;
  Values().set(message);
  return message;
}
template <typename M>
std::string listed(M message) {
  Listing listing;
  listing.add(message);
  return listing.text();
}

/// The last message that was received.
class Latest {
 public:
  void set(Bytes message) {
    const std::lock_guard lock(mutex_);
    message_ = std::move(message);
  }
  std::optional<Bytes> get() const {
    const std::lock_guard lock(mutex_);
    return message_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<Bytes> message_;
};

/// A type of message in both encodings.
template <typename Ours, typename Theirs>
struct Both {
  using Our = Ours;
  using Their = Theirs;
};

template <typename B>
struct FastDds : testing::Test {
  std::unique_ptr<dds::Participant> ours = dds::joinByCyclone({.domain = dds::testDomain()});
  fast::Peer peer{dds::testDomain()};
  Topic topic{"/robot1/topic", &ros::typeOf<typename B::Our>(), TopicDelivery::steady};
};

using All = testing::Types<
    Both<ros::LaserScan, fast::LaserScan>, Both<ros::Odometry, fast::Odometry>, Both<ros::Range, fast::Range>,
    Both<ros::TFMessage, fast::TFMessage>, Both<ros::Clock, fast::Clock>, Both<ros::OccupancyGrid, fast::OccupancyGrid>,
    Both<ros::PointCloud2, fast::PointCloud2>, Both<ros::BatteryState, fast::BatteryState>,
    Both<ros::String, fast::String>, Both<ros::Twist, fast::Twist>, Both<ros::TwistStamped, fast::TwistStamped>,
    Both<ros::PoseWithCovarianceStamped, fast::PoseWithCovarianceStamped>, Both<ros::Temperature, fast::Temperature>,
    Both<ros::Imu, fast::Imu>, Both<ros::NavSatFix, fast::NavSatFix>, Both<ros::CompressedImage, fast::CompressedImage>,
    Both<ros::CameraInfo, fast::CameraInfo>, Both<ros::UInt8MultiArray, fast::UInt8MultiArray>,
    Both<ros::Float64MultiArray, fast::Float64MultiArray>, Both<ros::MarkerArray, fast::MarkerArray>>;
TYPED_TEST_SUITE(FastDds, All);

TYPED_TEST(FastDds, ReceivesEveryValue) {
  using Our = typename TypeParam::Our;
  using Their = typename TypeParam::Their;
  EXPECT_EQ(dds::ddsTypeName(Our::kType), Their::kDdsType);
  Latest latest;
  const auto reader = this->peer.reader("rt/robot1/topic", Their::kDdsType, {.is_reliable = false, .depth = 5},
                                        [&](Bytes bytes) { latest.set(std::move(bytes)); });
  const auto writer = this->ours->write(this->topic);
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->matched() == 1; }));
  Bytes sent;
  ros::encode(filled<Our>(), sent);
  writer->write(sent);
  ASSERT_TRUE(eventually([&] { return latest.get().has_value(); }));
  EXPECT_EQ(listed(fast::decode<Their>(*latest.get())), listed(filled<Our>()));
}

TYPED_TEST(FastDds, SendsEveryValue) {
  using Our = typename TypeParam::Our;
  using Their = typename TypeParam::Their;
  Latest latest;
  const auto reader = this->ours->read(this->topic, dds::Receipt::reliable, [&](const dds::Sample& sample) {
    latest.set({sample.message.begin(), sample.message.end()});
  });
  const auto writer = this->peer.writer("rt/robot1/topic", Their::kDdsType, {});
  ASSERT_TRUE(eventually([&] { return writer->matched() == 1 && reader->writers() == 1; }));
  writer->write(fast::encode(filled<Their>()));
  ASSERT_TRUE(eventually([&] { return latest.get().has_value(); }));
  EXPECT_EQ(listed(ros::decode<Our>(*latest.get())), listed(filled<Their>()));
}

using FastDdsWire = FastDds<Both<ros::OccupancyGrid, fast::OccupancyGrid>>;

TEST_F(FastDdsWire, ReceivesALargeLatchedMapLater) {
  ros::OccupancyGrid grid = filled<ros::OccupancyGrid>();
  grid.data.resize(4'000'000);
  for (std::size_t i = 0; i < grid.data.size(); ++i) grid.data[i] = static_cast<std::int8_t>(i % 101);
  topic.delivery = TopicDelivery::latched;
  const auto writer = ours->write(topic);
  Bytes sent;
  ros::encode(grid, sent);
  writer->write(sent);
  Latest latest;
  const auto reader = peer.reader("rt/robot1/topic", fast::OccupancyGrid::kDdsType,
                                  {.is_reliable = true, .is_transient_local = true, .depth = 1},
                                  [&](Bytes bytes) { latest.set(bytes); });
  ASSERT_TRUE(eventually([&] { return latest.get().has_value(); }));
  EXPECT_TRUE(fast::decode<fast::OccupancyGrid>(*latest.get()).data == grid.data);
}

TEST_F(FastDdsWire, SendsALargeMapInFragments) {
  fast::OccupancyGrid grid = filled<fast::OccupancyGrid>();
  grid.data.resize(1'000'003);
  for (std::size_t i = 0; i < grid.data.size(); ++i) grid.data[i] = static_cast<std::int8_t>(i % 101);
  topic.delivery = TopicDelivery::latched;
  const auto writer = peer.writer("rt/robot1/topic", fast::OccupancyGrid::kDdsType,
                                  {.is_reliable = true, .is_transient_local = true, .depth = 1});
  writer->write(fast::encode(grid));
  Latest latest;
  const auto reader = ours->read(topic, dds::Receipt::reliable, [&](const dds::Sample& sample) {
    latest.set({sample.message.begin(), sample.message.end()});
  });
  ASSERT_TRUE(eventually([&] { return latest.get().has_value(); }));
  EXPECT_TRUE(ros::decode<ros::OccupancyGrid>(*latest.get()).data == grid.data);
}

}  // namespace
}  // namespace robosim
