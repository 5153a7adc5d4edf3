#include "recording/analogue_codec.h"
#include "recording/codecs.h"

namespace robosim {

const Codec& blobCodec() { return theCodec<AnalogueCodec<Blobs>>(); }

}  // namespace robosim
