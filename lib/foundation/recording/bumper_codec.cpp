#include <algorithm>
#include <cassert>

#include <mrpt/obs/CObservationRawDAQ.h>

#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationRawDAQ;

/// Bumper: CObservationRawDAQ, segment i is digital input i (bit i % 8 of byte i / 8).
class BumperCodec : public CodecOf<CObservationRawDAQ, Contacts> {
  void init(CObservationRawDAQ& bumper, const SensorInfo& sensor) const override {
    bumper.DIN.resize((sensor.beams.size() + 7) / 8);
  }

  void set(CObservationRawDAQ& bumper, const SensorInfo&, const Contacts& contacts, float) const override {
    assert((contacts.pressed.size() + 7) / 8 == bumper.DIN.size());
    std::fill(bumper.DIN.begin(), bumper.DIN.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < contacts.pressed.size(); ++i) {
      if (contacts.pressed[i]) bumper.DIN[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    }
  }

  Contacts get(const CObservationRawDAQ& bumper, const SensorInfo& sensor, float) const override {
    checkSize(bumper, sensor, bumper.DIN.size(), (sensor.beams.size() + 7) / 8);
    Contacts contacts;
    for (std::size_t i = 0; i < sensor.beams.size(); ++i) {
      contacts.pressed.push_back((bumper.DIN[i / 8] >> (i % 8)) & 1u);
    }
    return contacts;
  }
};

}  // namespace

const Codec& bumperCodec() { return theCodec<BumperCodec>(); }

}  // namespace robosim
