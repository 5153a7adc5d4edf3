#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

struct Mount;

/// Reads <imu>: a gyro about the vertical axis and three accelerometers in the middle of the robot, InertialReading.
/// Each measures the mean over a step: the change of the velocity in the world, as seen in the robot's frame in the
/// middle of the step, by its duration. Errors, as data sheets give them: white noise of a density N per √Hz, of which
/// the mean over T has the standard deviation N / √(2 T), since its equivalent bandwidth is 1 / (2 T); a bias that is
/// constant in a run, normal; and an error of scale of the gyro, normal. Omitted: random walk of the bias, temperature,
/// tilt, vibration, and cross-axis errors.
std::unique_ptr<Sensor> readImu(XmlReader&, const Mount&);

}  // namespace robosim
