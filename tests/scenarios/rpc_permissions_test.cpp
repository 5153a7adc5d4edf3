// Checks every RPC, for every role and for permitted and forbidden robots, against the table in doc/security.md. RPCs
// are enumerated through protobuf's descriptors, so that a new one without a table row or a first message here fails.
#include <filesystem>
#include <map>
#include <memory>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include "net/access.h"
#include "net/connect.h"
#include "net/wire_error.h"
#include "remote/testing/test_robot.h"
#include "tests/scenarios/permission_table.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

using google::protobuf::DescriptorPool;
using google::protobuf::MethodDescriptor;

const char* const kPermitted = "Pioneer1";
const char* const kForbidden = "Scout1";
const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "robot-0123456789abcdef robot Pioneer1\n"
    "geometry-0123456789abcdef geometry\n"
    "operator-0123456789abcdef operator\n"
    "supervisor-0123456789abcdef supervisor\n"
    "expired-0123456789abcdef operator expires=2020-01-31\n";

/// A role, by its column in the table, and its token.
struct Column {
  std::string head, token;
};
const std::vector<Column>& columns() {
  static const std::vector<Column> all{{"viewer", "viewer-0123456789abcdef"},
                                       {"robot", "robot-0123456789abcdef"},
                                       {"geometry", "geometry-0123456789abcdef"},
                                       {"operator", "operator-0123456789abcdef"},
                                       {"supervisor", "supervisor-0123456789abcdef"}};
  return all;
}

/// First message by RPC; ROBOT stands for the robot's name. If a permitted call would change the run, the message has
/// invalid contents instead.
const std::map<std::string, std::string>& firstMessages() {
  static const std::map<std::string, std::string> all{
      {"Robots.Drive", "hello { protocol: 1 names: 'ROBOT' }"},
      {"Viewing.Watch", "protocol: 1"},
      {"Geometry.Work", ""},
      {"ControlPanel.Load", "protocol: 1 piece: 'no world'"},
      {"ControlPanel.Start", "protocol: 1"},
      {"ControlPanel.Pause", "protocol: 1"},
      {"ControlPanel.Step", "protocol: 1 steps: 0"},
      {"ControlPanel.SetSpeed", "protocol: 1 speed: -1"},
      {"ControlPanel.SetRecording", "protocol: 1 on: false"},
      {"ControlPanel.Stop", "protocol: 1"},
      {"ControlPanel.Supervise", "protocol: 1 change: 'none'"},
      {"ControlPanel.GetStatus", "protocol: 1"},
      {"ControlPanel.Watch", "protocol: 1"},
      {"RemoteControl.Control", "init { protocol: 1 robot: 'ROBOT' }"},
  };
  return all;
}

/// "Robots.Drive", by its descriptor.
std::map<std::string, const MethodDescriptor*> allRpcs() {
  std::map<std::string, const MethodDescriptor*> rpcs;
  const std::filesystem::path root = ROBOSIM_SOURCE_DIR "/lib/foundation/net/proto";
  for (const auto& file : std::filesystem::recursive_directory_iterator(root)) {
    if (file.path().extension() != ".proto") continue;
    const std::string name = std::filesystem::relative(file.path(), root);
    const auto* proto = DescriptorPool::generated_pool()->FindFileByName(name);
    if (!proto) throw std::runtime_error(file.path().string() + " is not part of this program");
    for (int s = 0; s < proto->service_count(); ++s) {
      for (int m = 0; m < proto->service(s)->method_count(); ++m) {
        const MethodDescriptor* method = proto->service(s)->method(m);
        rpcs[proto->service(s)->name() + "." + method->name()] = method;
      }
    }
  }
  return rpcs;
}

grpc::ByteBuffer encoded(const MethodDescriptor& method, std::string text, const std::string& robot) {
  if (const auto at = text.find("ROBOT"); at != std::string::npos) text.replace(at, 5, robot);
  google::protobuf::DynamicMessageFactory factory;
  const std::unique_ptr<google::protobuf::Message> message(factory.GetPrototype(method.input_type())->New());
  if (!google::protobuf::TextFormat::ParseFromString(text, message.get()))
    throw std::runtime_error("no message: " + text);
  const grpc::Slice slice(message->SerializeAsString());
  return {&slice, 1};
}

/// Calls an RPC, sends one message, reads one, and then cancels.
/// @return status of the call; OK when it was answered
grpc::Status call(const ConnectOptions& connect_options, const MethodDescriptor& method,
                  const grpc::ByteBuffer& message) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(1));
  attachToken(context, connect_options);
  grpc::CompletionQueue queue;
  grpc::GenericStub stub(connect(connect_options));
  const std::string path = "/" + method.service()->full_name() + "/" + method.name();
  const auto stream = stub.PrepareCall(&context, path, &queue);
  const auto done = [&queue] {
    void* tag = nullptr;
    bool is_ok = false;
    return queue.Next(&tag, &is_ok) && is_ok;
  };
  stream->StartCall(nullptr);
  done();
  stream->Write(message, nullptr);
  done();
  stream->WritesDone(nullptr);
  done();
  grpc::ByteBuffer answer;
  stream->Read(&answer, nullptr);
  const bool has_answer = done();
  if (has_answer) context.TryCancel();
  grpc::Status status;
  stream->Finish(&status, nullptr);
  done();
  return has_answer ? grpc::Status::OK : status;
}

/// "yes" for a call that was processed, "no" for one refused because of its token's role or robot.
std::string outcomeOf(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::OK:
    case grpc::StatusCode::INVALID_ARGUMENT:     // processed; contents refused
    case grpc::StatusCode::DATA_LOSS:            // the same, for a geometry worker
    case grpc::StatusCode::ALREADY_EXISTS:       // another connection still drives the robot
    case grpc::StatusCode::FAILED_PRECONDITION:  // the run was started without a name for recordings
      return "yes";
    case grpc::StatusCode::PERMISSION_DENIED:
      return "no";
    case grpc::StatusCode::UNAUTHENTICATED:
      return "unauthenticated";
    default:
      return "status " + std::to_string(status.error_code()) + ": " + status.error_message();
  }
}

struct RpcPermissions : testing::Test {
  const Access access = Access::parse(kTokens, "tokens");
  TestRobot permitted{kPermitted, access}, forbidden{kForbidden, access};
  std::unique_ptr<ServedWorld> world;
  /// By address. All calls use one connection: many without an authorised call are a flood (net/flood_guard.h).
  std::map<std::string, std::shared_ptr<grpc::Channel>> channels;

  /// Result of a call.
  std::string outcome(const std::string& rpc, const MethodDescriptor& method, const std::string& token,
                      const std::string& robot) {
    if (!world) {
      ServedWorld::Options options = paused();
      options.robots_elsewhere = true;
      options.server.access = access;
      world = std::make_unique<ServedWorld>(options);
    }
    ConnectOptions connect_options = world->connectOptions();
    if (rpc.starts_with("RemoteControl."))
      connect_options.address = (robot == kPermitted ? permitted : forbidden).address();
    connect_options.token = token;
    auto& channel = channels[connect_options.address];
    if (!channel) channel = connect(connect_options);
    connect_options.channel = channel;
    const std::string outcome =
        outcomeOf(call(connect_options, method, encoded(method, firstMessages().at(rpc), robot)));
    if (rpc == "ControlPanel.Stop" && outcome == "yes") {
      EXPECT_EQ(world->wait(), Served::stopped);
      channels.erase(connect_options.address);
      world.reset();
    }
    return outcome;
  }
};

TEST_F(RpcPermissions, MatchTheTableForEveryRpcRoleAndRobot) {
  const PermissionTable table = permissionTable("RPC");
  const auto rpcs = allRpcs();
  for (const auto& [rpc, row] : table) EXPECT_TRUE(rpcs.contains(rpc)) << "doc/security.md has no longer " << rpc;
  for (const auto& [rpc, method] : rpcs) {
    ASSERT_TRUE(firstMessages().contains(rpc)) << "say here how a call of " << rpc << " begins";
    ASSERT_TRUE(table.contains(rpc)) << "doc/security.md: add a row for " << rpc;
    for (const std::string robot : {kPermitted, kForbidden}) {
      for (const char* token : {"", "wrong-0123456789abcdef", "expired-0123456789abcdef"}) {
        EXPECT_EQ(outcome(rpc, *method, token, robot), "unauthenticated") << rpc << " with the token '" << token << "'";
      }
      for (const auto& [head, token] : columns()) {
        const auto& row = table.at(rpc);
        const std::string column = head != "robot" ? head : robot == kPermitted ? "robot: its robots" : "robot: others";
        EXPECT_EQ(outcome(rpc, *method, token, robot), row.at(column)) << rpc << ", " << column << ", " << robot;
      }
    }
  }
}

}  // namespace
}  // namespace robosim
