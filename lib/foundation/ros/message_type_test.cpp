#include "ros/message_type.h"

#include <gtest/gtest.h>

#include "ros/messages.h"

namespace robosim::ros {
namespace {

template <typename... M>
void expectHashes(const std::vector<std::string>& published) {
  const std::vector<std::string> ours{typeOf<M>().hash()...};
  const std::vector<std::string> names{typeOf<M>().name...};
  ASSERT_EQ(ours.size(), published.size());
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_EQ(ours[i], "RIHS01_" + published[i]) << names[i];
}

// The hashes that ROS 2 prints (ros2 topic info -v). They depend on the name, the type and the order of every field at
// any depth.
TEST(MessageType, HasThePublishedHashOfEachMessage) {
  expectHashes<String, Header, Time, Clock, Twist, TwistStamped, TransformStamped, Pose, PoseWithCovariance, Odometry,
               OccupancyGrid, TFMessage, LaserScan, Range, BatteryState, CompressedImage, CameraInfo, Temperature,
               PointCloud2, Marker, MarkerArray>({"df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
                                                  "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01",
                                                  "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197",
                                                  "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564",
                                                  "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
                                                  "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64",
                                                  "0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206",
                                                  "d501954e9476cea2996984e812054b68026ae0bfae789d9a10b23daf35cc90fa",
                                                  "9a7c0fd234b7f45c6098745ecccd773ca1085670e64107135397aee31c02e1bb",
                                                  "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0",
                                                  "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7",
                                                  "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
                                                  "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
                                                  "b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a",
                                                  "4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741",
                                                  "15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a",
                                                  "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275",
                                                  "72514a14126ab9f8a9abec974c78e5610a367b59db5da355ff1fb982d5bad4b8",
                                                  "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5",
                                                  "45b13ccf791f225962bf74e746f9644518855d783a6f42ba0cc14fde2b4f3ce0",
                                                  "86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"});
}

TEST(MessageType, DefinesAMessageWithAllMessagesInIt) {
  const std::string line(80, '=');
  EXPECT_EQ(typeOf<Temperature>().definition(),
            "std_msgs/Header header\nfloat64 temperature\nfloat64 variance\n" + line +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

TEST(MessageType, DefinesEachNestedMessageOnce) {
  const std::string definition = typeOf<MarkerArray>().definition();
  std::size_t count = 0;
  for (std::size_t at = 0; (at = definition.find("MSG: geometry_msgs/Point\n", at)) != std::string::npos; ++at) ++count;
  EXPECT_EQ(count, 1u);
}

TEST(MessageType, WritesArraysWithTheirSizeAndSequencesWithout) {
  EXPECT_EQ(typeOf<PoseWithCovariance>().text(), "geometry_msgs/Pose pose\nfloat64[36] covariance\n");
  EXPECT_EQ(typeOf<TFMessage>().text(), "geometry_msgs/TransformStamped[] transforms\n");
}

}  // namespace
}  // namespace robosim::ros
