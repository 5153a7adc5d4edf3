#include "recording/analogue_codec.h"
#include "recording/codecs.h"

namespace robosim {

const Codec& valuesCodec() { return theCodec<AnalogueCodec<Values>>(); }

}  // namespace robosim
