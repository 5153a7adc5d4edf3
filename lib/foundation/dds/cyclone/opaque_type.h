#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

namespace robosim::dds {

/// A type of messages of ROS 2 for Cyclone DDS, which it transports as encoded: without a key, final, XCDR1, and
/// without a description of its fields, so that types match by name as those of rmw_cyclonedds do.
/// @param name "sensor_msgs::msg::dds_::LaserScan_" @return with one reference, for dds_create_topic_sertype()
ddsi_sertype* newOpaqueType(const std::string& name);

/// A message of an opaque type, for dds_writecdr(), which takes the reference. @param encoded with the header of CDR
ddsi_serdata* newOpaqueMessage(const ddsi_sertype* type, std::vector<std::uint8_t> encoded);

/// The bytes of a message of an opaque type, with the header of CDR.
std::span<const std::uint8_t> encodedMessage(const ddsi_serdata* message);

}  // namespace robosim::dds
