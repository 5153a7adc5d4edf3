#include "server/geometry_seal.h"

#include <gtest/gtest.h>

#include "net/wire_error.h"

namespace robosim {
namespace {

wire::FromWorker someResult() {
  wire::FromWorker message;
  message.mutable_result()->set_step(7);
  message.mutable_result()->add_measurements()->add_floats(1.5f);
  return message;
}

TEST(GeometrySeal, RoundTripsAMessage) {
  wire::Sealed sealed;
  seal(someResult(), sealed);
  wire::FromWorker received;
  unseal(sealed, received);
  EXPECT_EQ(received.SerializeAsString(), someResult().SerializeAsString());
}

TEST(GeometrySeal, DetectsEveryBitError) {
  wire::Sealed sealed;
  seal(someResult(), sealed);
  const std::string bytes = sealed.SerializeAsString();
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    wire::Sealed damaged;
    if (!damaged.ParseFromString(flipped)) continue;
    wire::FromWorker received;
    EXPECT_THROW(unseal(damaged, received), WireError) << "bit " << bit;
  }
}

TEST(GeometrySeal, RefusesAPayloadOfAnotherMessageType) {
  wire::Replica other;
  other.set_period_s(0.1);
  wire::Sealed sealed;
  seal(other, sealed);
  sealed.set_payload("\xff");
  wire::FromWorker received;
  EXPECT_THROW(unseal(sealed, received), WireError);
}

TEST(GeometrySeal, NamesBothProtocolVersions) {
  EXPECT_NO_THROW(checkGeometryProtocol(kGeometryProtocolVersion));
  try {
    checkGeometryProtocol(1);
    ADD_FAILURE();
  } catch (const WireError& error) {
    EXPECT_EQ(error.code(), grpc::StatusCode::FAILED_PRECONDITION);
    EXPECT_STREQ(
        error.what(),
        "the geometry worker speaks version 1 of its conversation, the environment version 2; install the same "
        "version of robosim at both ends");
  }
}

}  // namespace
}  // namespace robosim
