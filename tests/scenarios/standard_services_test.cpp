// gRPC's health and reflection services: absent by default; with the options, for every client.
#include <filesystem>
#include <fstream>

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

struct Response {
  grpc::Status status;
  std::string bytes;
};

/// Calls a method with one request, and reads one response.
Response call(const std::string& address, const std::string& method, const std::string& request) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(1));
  grpc::CompletionQueue queue;
  grpc::GenericStub stub(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
  const auto stream = stub.PrepareCall(&context, method, &queue);
  const auto wait = [&queue] {
    void* tag = nullptr;
    bool is_ok = false;
    return queue.Next(&tag, &is_ok) && is_ok;
  };
  const grpc::Slice slice(request);
  stream->StartCall(nullptr);
  wait();
  stream->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  wait();
  Response response;
  grpc::ByteBuffer received;
  stream->Read(&received, nullptr);
  if (wait()) {
    grpc::Slice bytes;
    received.DumpToSingleSlice(&bytes);
    response.bytes.assign(bytes.begin(), bytes.end());
  }
  stream->Finish(&response.status, nullptr);
  wait();
  return response;
}

const char* const kHealth = "/grpc.health.v1.Health/Check";
const char* const kReflection = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
const std::string kServing{8, 1};            // HealthCheckResponse { status: SERVING }
const std::string kListServices{'\x3a', 0};  // ServerReflectionRequest { list_services: "" }

TEST(StandardServices, AreAbsentByDefault) {
  const Serving serving({"--paused"});
  for (const char* method : {kHealth, kReflection}) {
    EXPECT_EQ(call(serving.address(), method, "").status.error_code(), grpc::StatusCode::UNIMPLEMENTED) << method;
  }
}

TEST(StandardServices, AnswerClientsWithoutATokenAndGrantThemNothingElse) {
  const auto tokens = emptyFolder() / "tokens";
  std::ofstream(tokens) << "operator-0123456789ab operator\n";
  std::filesystem::permissions(tokens, std::filesystem::perms::owner_read);
  const Serving serving({"--paused", "--health", "--reflection", "--tokens", tokens.string()});
  const Response health = call(serving.address(), kHealth, "");
  EXPECT_TRUE(health.status.ok()) << health.status.error_message();
  EXPECT_EQ(health.bytes, kServing);
  const Response services = call(serving.address(), kReflection, kListServices);
  EXPECT_NE(services.bytes.find("robosim.v1.Robots"), std::string::npos) << services.status.error_message();
  EXPECT_EQ(call(serving.address(), "/robosim.v1.ControlPanel/GetStatus", {8, 1}).status.error_code(),
            grpc::StatusCode::UNAUTHENTICATED);
}

}  // namespace
}  // namespace robosim
