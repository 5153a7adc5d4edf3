#include <cmath>

#include <mrpt/obs/CObservationGPS.h>

#include "hardware/gnss_fix.h"
#include "recording/codecs.h"

namespace robosim {
namespace {

using mrpt::obs::gnss::Message_NMEA_GGA;

/// GNSS: CObservationGPS with a GGA message; its fix quality is 1 for a fix and 0 for none.
class GnssCodec : public CodecOf<mrpt::obs::CObservationGPS, Values> {
 public:
  bool encodes(const SensorInfo& sensor) const override {
    return sensor.kind == SensorKind::values && GnssFix::isOf(sensor);
  }

 private:
  void init(Observation& observation, const SensorInfo& sensor) const override {
    observation.sensorPose = mrpt::poses::CPose3D(mountOf(sensor));
    observation.setMsg(Message_NMEA_GGA());
  }
  void set(Observation& observation, const SensorInfo&, const Values& measured, float) const override {
    const GnssFix fix = GnssFix::from(measured);
    auto& fields = observation.getMsgByClass<Message_NMEA_GGA>().fields;
    fields.fix_quality = fix.is_valid ? 1 : 0;
    fields.latitude_degrees = fix.latitude_deg;
    fields.longitude_degrees = fix.longitude_deg;
    fields.altitude_meters = fix.altitude_m;
  }
  Values get(const Observation& observation, const SensorInfo& sensor, float) const override {
    if (!observation.hasMsgClass<Message_NMEA_GGA>()) refuse(observation, sensor, "it has no GGA message");
    const auto& fields = observation.getMsgByClass<Message_NMEA_GGA>().fields;
    const GnssFix fix{fields.fix_quality != 0, fields.latitude_degrees, fields.longitude_degrees,
                      fields.altitude_meters};
    for (const double value : {fix.latitude_deg, fix.longitude_deg, fix.altitude_m}) {
      if (!std::isfinite(value)) refuse(observation, sensor, "a coordinate is not finite");
    }
    return fix.values();
  }
};

}  // namespace

const Codec& gnssCodec() { return theCodec<GnssCodec>(); }

}  // namespace robosim
