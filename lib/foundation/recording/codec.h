#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <mrpt/obs/CObservation.h>

#include "hardware/measurement_fields.h"
#include "recording/observed_numbers.h"

namespace robosim {

/// Converts the measurements of one kind of sensor to stock MRPT observations and back. codecs.h lists all codecs.
class Codec {
 public:
  /// Bytes in memory that also occur in the serialised observation (SerializedTemplate::Number).
  using Number = std::span<const std::byte>;

  virtual ~Codec() = default;

  /// Whether the measurements of a sensor are recorded by this codec.
  virtual bool encodes(const SensorInfo&) const = 0;
  /// An observation with all constant data of the sensor.
  virtual mrpt::obs::CObservation::Ptr make(const SensorInfo&) const = 0;
  /// Sets a step's measurement in an observation of make().
  /// @param pan_rad pan angle of the panning sensors
  virtual void fill(mrpt::obs::CObservation&, const SensorInfo&, const Measurement&, float pan_rad) const = 0;
  /// The inverse of fill().
  /// @param pictures folder of external images
  /// @throws RecordingError when the observation's class or size does not match the sensor.
  virtual Measurement measurementFrom(const mrpt::obs::CObservation&, const SensorInfo&, float pan_rad,
                                      const std::filesystem::path& pictures) const = 0;
  /// The numbers that fill() changes, if MRPT serialises them unchanged and there are no others; empty otherwise.
  virtual std::vector<Number> changingNumbers(mrpt::obs::CObservation&) const { return {}; }
  /// Appends the numbers of an observation of this codec's class, of any program.
  /// @returns false for other classes
  virtual bool appendNumbers(const mrpt::obs::CObservation&, ObservedNumbers&) const { return false; }
};

/// @throws RecordingError with the reason why the observation is not of the sensor.
[[noreturn]] void refuse(const mrpt::obs::CObservation&, const SensorInfo&, const std::string& why);

/// @throws RecordingError unless the observation holds the expected number of values.
void checkSize(const mrpt::obs::CObservation&, const SensorInfo&, std::size_t recorded, std::size_t expected);

/// The pose of a sensor with a single value.
mrpt::math::TPose3D mountOf(const SensorInfo&);

/// The bytes of a number, which must outlive them.
template <typename T>
Codec::Number bytesOf(const T& number) {
  return std::as_bytes(std::span(&number, 1));
}
template <typename T>
Codec::Number bytesOf(const T&&) = delete;

/// Base of a codec from measurements M to the observation class Class. A codec implements init() (if the class has
/// constant data), set(), get(), and optionally numbers() and append().
template <typename Class, typename M>
class CodecOf : public Codec {
 public:
  using Observation = Class;

  bool encodes(const SensorInfo& sensor) const override {
    for (const auto kind : Description<M>::kinds) {
      if (kind == sensor.kind) return true;
    }
    return false;
  }
  mrpt::obs::CObservation::Ptr make(const SensorInfo& sensor) const final {
    auto observation = std::make_shared<Class>();
    init(*observation, sensor);
    return observation;
  }
  void fill(mrpt::obs::CObservation& observation, const SensorInfo& sensor, const Measurement& measurement,
            float pan_rad) const final {
    set(static_cast<Class&>(observation), sensor, std::get<M>(measurement), pan_rad);
  }
  Measurement measurementFrom(const mrpt::obs::CObservation& observation, const SensorInfo& sensor, float pan_rad,
                              const std::filesystem::path&) const override {
    const auto* const typed = dynamic_cast<const Class*>(&observation);
    if (!typed) {
      refuse(observation, sensor, std::string("the class should be ") + Class::GetRuntimeClassIdStatic().className);
    }
    return get(*typed, sensor, pan_rad);
  }
  std::vector<Number> changingNumbers(mrpt::obs::CObservation& observation) const final {
    return numbers(static_cast<Class&>(observation));
  }
  bool appendNumbers(const mrpt::obs::CObservation& observation, ObservedNumbers& all) const final {
    const auto* const typed = dynamic_cast<const Class*>(&observation);
    return typed && append(*typed, all);
  }

 private:
  virtual void init(Class&, const SensorInfo&) const {}
  virtual void set(Class&, const SensorInfo&, const M&, float pan_rad) const = 0;
  virtual M get(const Class&, const SensorInfo&, float pan_rad) const = 0;
  virtual std::vector<Number> numbers(Class&) const { return {}; }
  virtual bool append(const Class&, ObservedNumbers&) const { return false; }
};

/// The only instance of a codec.
template <typename C>
const Codec& theCodec() {
  static const C codec;
  return codec;
}

}  // namespace robosim
