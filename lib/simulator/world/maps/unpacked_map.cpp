#include "world/maps/unpacked_map.h"

#include <array>

#include <isa-l/igzip_lib.h>

#include "base/error_list.h"

namespace robosim {

std::optional<std::string> unpackedMap(const std::string& bytes, const std::string& path, std::size_t max_bytes) {
  if (!bytes.starts_with("\x1f\x8b")) return std::nullopt;
  inflate_state state;
  isal_inflate_init(&state);
  state.crc_flag = ISAL_GZIP;
  state.next_in = reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));  // only read
  state.avail_in = static_cast<std::uint32_t>(bytes.size());
  std::string out;
  std::array<std::uint8_t, 1 << 16> block;
  while (state.block_state != ISAL_BLOCK_FINISH) {
    state.next_out = block.data();
    state.avail_out = block.size();
    const int status = isal_inflate(&state);
    out.append(reinterpret_cast<const char*>(block.data()), block.size() - state.avail_out);
    if (status != ISAL_DECOMP_OK && status != ISAL_END_INPUT) {
      throw ConfigError(path + ": is damaged: it cannot be decompressed beyond byte " + std::to_string(out.size()));
    }
    if (out.size() > max_bytes) {
      throw ConfigError(path + ": holds more than " + std::to_string(max_bytes >> 20) +
                        " MiB once it is decompressed; no map has so many cells");
    }
    if (state.block_state != ISAL_BLOCK_FINISH && state.avail_out == block.size() && state.avail_in == 0) {
      throw ConfigError(path + ": is cut off: the compressed part has no end");
    }
  }
  return out;
}

}  // namespace robosim
