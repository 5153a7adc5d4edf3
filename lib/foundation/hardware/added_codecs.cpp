#include "hardware/added_codecs.h"

namespace robosim {

std::vector<const Codec*>& addedCodecs() {
  static std::vector<const Codec*> codecs;
  return codecs;
}

}  // namespace robosim
