#include "dds/cyclone/opaque_type.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include <dds/ddsi/q_radmin.h>

namespace robosim::dds {
namespace {

/// Cyclone DDS counts references, and calls the functions below. Exceptions must not pass through it: that of memory
/// ends the program, as in Cyclone DDS itself.
struct OpaqueMessage : ddsi_serdata {
  OpaqueMessage(const ddsi_sertype* message_type, ddsi_serdata_kind message_kind) : ddsi_serdata{} {
    ddsi_serdata_init(this, message_type, message_kind);
  }
  std::vector<std::uint8_t> bytes;
  std::uint32_t size = 0;  ///< without the padding to a multiple of four, which is sent
};

struct OpaqueType : ddsi_sertype {};

const OpaqueMessage* of(const ddsi_serdata* message) { return static_cast<const OpaqueMessage*>(message); }

OpaqueMessage* withSize(const ddsi_sertype* type, ddsi_serdata_kind kind, std::size_t size) {
  auto message = std::make_unique<OpaqueMessage>(type, kind);
  message->size = static_cast<std::uint32_t>(size);
  message->bytes.resize((size + 3) / 4 * 4);
  return message.release();
}

bool equalKeys(const ddsi_serdata*, const ddsi_serdata*) { return true; }
std::uint32_t sizeOf(const ddsi_serdata* message) { return of(message)->size; }

ddsi_serdata* fromFragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                            std::size_t size) {
  OpaqueMessage* const message = withSize(type, kind, size);
  std::uint32_t end = 0;  // fragments may overlap
  for (; fragment; fragment = fragment->nextfrag) {
    if (fragment->maxp1 <= end || fragment->maxp1 > size) continue;
    const unsigned char* const payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    std::memcpy(message->bytes.data() + end, payload + (end - fragment->min), fragment->maxp1 - end);
    end = fragment->maxp1;
  }
  return message;
}

ddsi_serdata* fromParts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                        const ddsrt_iovec_t* parts, std::size_t size) {
  OpaqueMessage* const message = withSize(type, kind, size);
  std::size_t at = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && at < size; ++i) {
    const std::size_t part = std::min<std::size_t>(parts[i].iov_len, size - at);
    std::memcpy(message->bytes.data() + at, parts[i].iov_base, part);
    at += part;
  }
  return message;
}

ddsi_serdata* fromKeyHash(const ddsi_sertype* type, const ddsi_keyhash*) { return withSize(type, SDK_KEY, 0); }

/// Of dispose and unregister only: messages are written by dds_writecdr().
ddsi_serdata* fromSample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void*) {
  return withSize(type, kind, 0);
}

void copyBytes(const ddsi_serdata* message, std::size_t offset, std::size_t size, void* to) {
  if (size > 0) std::memcpy(to, of(message)->bytes.data() + offset, size);
}

ddsi_serdata* referBytes(const ddsi_serdata* message, std::size_t offset, std::size_t size, ddsrt_iovec_t* part) {
  part->iov_base = const_cast<std::uint8_t*>(of(message)->bytes.data()) + offset;
  part->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(message);
}

void releaseBytes(ddsi_serdata* message, const ddsrt_iovec_t*) { ddsi_serdata_unref(message); }

/// Messages are read by dds_takecdr().
bool toSample(const ddsi_serdata*, void*, void**, void*) { return false; }

ddsi_serdata* toUntyped(const ddsi_serdata* message) {
  ddsi_serdata* const made = withSize(message->type, SDK_KEY, 0);
  made->type = nullptr;
  return made;
}

bool untypedToSample(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return true; }
void freeMessage(ddsi_serdata* message) { delete static_cast<OpaqueMessage*>(message); }

std::size_t printMessage(const ddsi_sertype*, const ddsi_serdata* message, char* text, std::size_t size) {
  return static_cast<std::size_t>(std::snprintf(text, size, "%u bytes", static_cast<unsigned>(of(message)->size)));
}

void keyHash(const ddsi_serdata*, ddsi_keyhash* hash, bool) { std::memset(hash, 0, sizeof *hash); }

const ddsi_serdata_ops kMessageFunctions = [] {
  ddsi_serdata_ops made{};
  made.eqkey = equalKeys;
  made.get_size = sizeOf;
  made.from_ser = fromFragments;
  made.from_ser_iov = fromParts;
  made.from_keyhash = fromKeyHash;
  made.from_sample = fromSample;
  made.to_ser = copyBytes;
  made.to_ser_ref = referBytes;
  made.to_ser_unref = releaseBytes;
  made.to_sample = toSample;
  made.to_untyped = toUntyped;
  made.untyped_to_sample = untypedToSample;
  made.free = freeMessage;
  made.print = printMessage;
  made.get_keyhash = keyHash;
  return made;  // shared memory is not configured
}();

void freeType(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<OpaqueType*>(type);
}
void zeroSamples(const ddsi_sertype*, void*, std::size_t) {}
void reallocateSamples(void** samples, const ddsi_sertype*, void*, std::size_t, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) samples[i] = nullptr;
}
void freeSamples(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}
bool equalTypes(const ddsi_sertype*, const ddsi_sertype*) { return true; }  // their names are equal
std::uint32_t hashOfType(const ddsi_sertype*) { return 0; }

const ddsi_sertype_ops kTypeFunctions = [] {
  ddsi_sertype_ops made{};
  made.version = ddsi_sertype_v0;
  made.free = freeType;
  made.zero_samples = zeroSamples;
  made.realloc_samples = reallocateSamples;
  made.free_samples = freeSamples;
  made.equal = equalTypes;
  made.hash = hashOfType;
  return made;  // without a description of its fields
}();

}  // namespace

ddsi_sertype* newOpaqueType(const std::string& name) {
  auto type = std::make_unique<OpaqueType>();
  ddsi_sertype_init_flags(type.get(), name.c_str(), &kTypeFunctions, &kMessageFunctions,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type.release();
}

ddsi_serdata* newOpaqueMessage(const ddsi_sertype* type, std::vector<std::uint8_t> encoded) {
  auto message = std::make_unique<OpaqueMessage>(type, SDK_DATA);
  message->size = static_cast<std::uint32_t>(encoded.size());
  encoded.resize((encoded.size() + 3) / 4 * 4);
  message->bytes = std::move(encoded);
  return message.release();
}

std::span<const std::uint8_t> encodedMessage(const ddsi_serdata* message) {
  return std::span(of(message)->bytes).first(of(message)->size);
}

}  // namespace robosim::dds
