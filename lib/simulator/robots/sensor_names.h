#pragma once
#include <vector>

#include "base/xml_reader.h"
#include "hardware/sensor_info.h"

namespace robosim {

/// Checks the `id`s and `label`s of one robot's sensors. Reports duplicate ids and labels, and labels that recordings
/// cannot hold (sensorLabelError()).
void checkSensorNames(std::vector<XmlReader>& sensors);

/// Makes labels unique. Keeps the labels given in the file; appends _2, _3, … to other sensors' labels, the names of
/// their kinds, where they are taken.
void makeLabelsUnique(std::vector<SensorInfo>& sensors, const std::vector<bool>& labelled);

}  // namespace robosim
