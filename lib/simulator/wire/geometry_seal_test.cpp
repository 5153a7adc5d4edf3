#include "wire/geometry_seal.h"

#include <gtest/gtest.h>

#include "net/wire_error.h"

namespace robosim {
namespace {

internal::WorkRequest someResult() {
  internal::WorkRequest message;
  message.mutable_result()->set_step(7);
  message.mutable_result()->add_measurements()->add_floats(1.5f);
  return message;
}

TEST(GeometrySeal, RoundTripsAMessage) {
  internal::Sealed sealed;
  seal(someResult(), sealed);
  internal::WorkRequest received;
  unseal(sealed, received);
  EXPECT_EQ(received.SerializeAsString(), someResult().SerializeAsString());
}

TEST(GeometrySeal, DetectsEveryBitError) {
  internal::Sealed sealed;
  seal(someResult(), sealed);
  const std::string bytes = sealed.SerializeAsString();
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    internal::Sealed damaged;
    if (!damaged.ParseFromString(flipped)) continue;
    internal::WorkRequest received;
    EXPECT_THROW(unseal(damaged, received), WireError) << "bit " << bit;
  }
}

TEST(GeometrySeal, RefusesAPayloadOfAnotherMessageType) {
  internal::Replica other;
  other.set_period_s(0.1);
  internal::Sealed sealed;
  seal(other, sealed);
  sealed.set_payload("\xff");
  internal::WorkRequest received;
  EXPECT_THROW(unseal(sealed, received), WireError);
}

TEST(GeometrySeal, NamesBothProtocolVersions) {
  EXPECT_NO_THROW(checkGeometryProtocol(kGeometryProtocolVersion));
  try {
    checkGeometryProtocol(1);
    ADD_FAILURE();
  } catch (const WireError& error) {
    EXPECT_EQ(error.status().error_code(), grpc::StatusCode::FAILED_PRECONDITION);
    EXPECT_STREQ(
        error.what(),
        "the geometry worker uses version 1 of the geometry protocol, the environment version 4; install the same "
        "version of robosim at both ends");
  }
}

}  // namespace
}  // namespace robosim
