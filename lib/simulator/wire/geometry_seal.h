#pragma once
#include <cstdint>

#include "robosim/internal/geometry.pb.h"

namespace robosim {

/// @file
/// Checksums of the messages of the Geometry service. They detect transmission errors, not manipulation; TLS protects
/// against the latter.

/// Protocol version that both ends must use.
constexpr std::uint32_t kGeometryProtocolVersion = 4;
/// @throws WireError unless `version` is kGeometryProtocolVersion.
void checkGeometryProtocol(std::uint32_t version);

void seal(const google::protobuf::Message& message, internal::Sealed& out);
/// @throws WireError with the code DATA_LOSS when the checksum does not match or the payload has another message type.
void unseal(const internal::Sealed& in, google::protobuf::Message& message);

}  // namespace robosim
