#include "wire/geometry_seal.h"

#include "base/digest.h"
#include "net/wire_error.h"

namespace robosim {
namespace {

std::uint64_t computeChecksum(const std::string& bytes) {
  Digest digest;
  digest.addBytes(bytes.data(), bytes.size());
  return digest.value();
}

}  // namespace

void checkGeometryProtocol(std::uint32_t version) {
  if (version == kGeometryProtocolVersion) return;
  throw WireError("the geometry worker uses version " + std::to_string(version) +
                      " of the geometry protocol, the environment version " + std::to_string(kGeometryProtocolVersion) +
                      "; install the same version of robosim at both ends",
                  v1::ERROR_REASON_PROTOCOL_VERSION);
}

void seal(const google::protobuf::Message& message, internal::Sealed& out) {
  message.SerializeToString(out.mutable_payload());
  out.set_checksum(computeChecksum(out.payload()));
}

void unseal(const internal::Sealed& in, google::protobuf::Message& message) {
  if (computeChecksum(in.payload()) != in.checksum()) {
    throw WireError("a message whose checksum does not match: it was corrupted in transit; connect again",
                    v1::ERROR_REASON_CORRUPTED_MESSAGE);
  }
  if (!message.ParseFromString(in.payload())) {
    throw WireError("a payload that is no " + message.GetTypeName(), v1::ERROR_REASON_CORRUPTED_MESSAGE);
  }
}

}  // namespace robosim
