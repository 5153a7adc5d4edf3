#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Messages of ROS 2 for Fast DDS, written from the .msg files of common_interfaces, geometry2 and rcl_interfaces,
/// apart from lib/foundation/ros: the tests compare both on the wire. fields() visits the fields in order.
namespace fast {

#define FAST_MESSAGE(type, ...)                 \
  static constexpr const char* kDdsType = type; \
  template <typename Visit>                     \
  void fields(Visit&& visit) {                  \
    visit(__VA_ARGS__);                         \
  }

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  FAST_MESSAGE("builtin_interfaces::msg::dds_::Time_", sec, nanosec)
};
struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  FAST_MESSAGE("builtin_interfaces::msg::dds_::Duration_", sec, nanosec)
};
struct Header {
  Time stamp;
  std::string frame_id;
  FAST_MESSAGE("std_msgs::msg::dds_::Header_", stamp, frame_id)
};
struct Clock {
  Time clock;
  FAST_MESSAGE("rosgraph_msgs::msg::dds_::Clock_", clock)
};
struct String {
  std::string data;
  FAST_MESSAGE("std_msgs::msg::dds_::String_", data)
};
struct ColorRGBA {
  float r = 0, g = 0, b = 0, a = 0;
  FAST_MESSAGE("std_msgs::msg::dds_::ColorRGBA_", r, g, b, a)
};
struct MultiArrayDimension {
  std::string label;
  std::uint32_t size = 0, stride = 0;
  FAST_MESSAGE("std_msgs::msg::dds_::MultiArrayDimension_", label, size, stride)
};
struct MultiArrayLayout {
  std::vector<MultiArrayDimension> dim;
  std::uint32_t data_offset = 0;
  FAST_MESSAGE("std_msgs::msg::dds_::MultiArrayLayout_", dim, data_offset)
};
struct UInt8MultiArray {
  MultiArrayLayout layout;
  std::vector<std::uint8_t> data;
  FAST_MESSAGE("std_msgs::msg::dds_::UInt8MultiArray_", layout, data)
};
struct Float64MultiArray {
  MultiArrayLayout layout;
  std::vector<double> data;
  FAST_MESSAGE("std_msgs::msg::dds_::Float64MultiArray_", layout, data)
};
struct Vector3 {
  double x = 0, y = 0, z = 0;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Vector3_", x, y, z)
};
struct Point {
  double x = 0, y = 0, z = 0;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Point_", x, y, z)
};
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 0;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Quaternion_", x, y, z, w)
};
struct Pose {
  Point position;
  Quaternion orientation;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Pose_", position, orientation)
};
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};
  FAST_MESSAGE("geometry_msgs::msg::dds_::PoseWithCovariance_", pose, covariance)
};
struct PoseWithCovarianceStamped {
  Header header;
  PoseWithCovariance pose;
  FAST_MESSAGE("geometry_msgs::msg::dds_::PoseWithCovarianceStamped_", header, pose)
};
struct Twist {
  Vector3 linear, angular;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Twist_", linear, angular)
};
struct TwistStamped {
  Header header;
  Twist twist;
  FAST_MESSAGE("geometry_msgs::msg::dds_::TwistStamped_", header, twist)
};
struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};
  FAST_MESSAGE("geometry_msgs::msg::dds_::TwistWithCovariance_", twist, covariance)
};
struct Transform {
  Vector3 translation;
  Quaternion rotation;
  FAST_MESSAGE("geometry_msgs::msg::dds_::Transform_", translation, rotation)
};
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  FAST_MESSAGE("geometry_msgs::msg::dds_::TransformStamped_", header, child_frame_id, transform)
};
struct TFMessage {
  std::vector<TransformStamped> transforms;
  FAST_MESSAGE("tf2_msgs::msg::dds_::TFMessage_", transforms)
};
struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  FAST_MESSAGE("nav_msgs::msg::dds_::Odometry_", header, child_frame_id, pose, twist)
};
struct MapMetaData {
  Time map_load_time;
  float resolution = 0;
  std::uint32_t width = 0, height = 0;
  Pose origin;
  FAST_MESSAGE("nav_msgs::msg::dds_::MapMetaData_", map_load_time, resolution, width, height, origin)
};
struct OccupancyGrid {
  Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;
  FAST_MESSAGE("nav_msgs::msg::dds_::OccupancyGrid_", header, info, data)
};
struct LaserScan {
  Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0, time_increment = 0, scan_time = 0, range_min = 0,
        range_max = 0;
  std::vector<float> ranges, intensities;
  FAST_MESSAGE("sensor_msgs::msg::dds_::LaserScan_", header, angle_min, angle_max, angle_increment, time_increment,
               scan_time, range_min, range_max, ranges, intensities)
};
struct Range {
  Header header;
  std::uint8_t radiation_type = 0;
  float field_of_view = 0, min_range = 0, max_range = 0, range = 0, variance = 0;
  FAST_MESSAGE("sensor_msgs::msg::dds_::Range_", header, radiation_type, field_of_view, min_range, max_range, range,
               variance)
};
struct BatteryState {
  Header header;
  float voltage = 0, temperature = 0, current = 0, charge = 0, capacity = 0, design_capacity = 0, percentage = 0;
  std::uint8_t power_supply_status = 0, power_supply_health = 0, power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage, cell_temperature;
  std::string location, serial_number;
  FAST_MESSAGE("sensor_msgs::msg::dds_::BatteryState_", header, voltage, temperature, current, charge, capacity,
               design_capacity, percentage, power_supply_status, power_supply_health, power_supply_technology, present,
               cell_voltage, cell_temperature, location, serial_number)
};
struct Temperature {
  Header header;
  double temperature = 0, variance = 0;
  FAST_MESSAGE("sensor_msgs::msg::dds_::Temperature_", header, temperature, variance)
};
struct Imu {
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};
  FAST_MESSAGE("sensor_msgs::msg::dds_::Imu_", header, orientation, orientation_covariance, angular_velocity,
               angular_velocity_covariance, linear_acceleration, linear_acceleration_covariance)
};
struct NavSatStatus {
  std::int8_t status = 0;
  std::uint16_t service = 0;
  FAST_MESSAGE("sensor_msgs::msg::dds_::NavSatStatus_", status, service)
};
struct NavSatFix {
  Header header;
  NavSatStatus status;
  double latitude = 0, longitude = 0, altitude = 0;
  std::array<double, 9> position_covariance{};
  std::uint8_t position_covariance_type = 0;
  FAST_MESSAGE("sensor_msgs::msg::dds_::NavSatFix_", header, status, latitude, longitude, altitude, position_covariance,
               position_covariance_type)
};
struct CompressedImage {
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;
  FAST_MESSAGE("sensor_msgs::msg::dds_::CompressedImage_", header, format, data)
};
struct RegionOfInterest {
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
  FAST_MESSAGE("sensor_msgs::msg::dds_::RegionOfInterest_", x_offset, y_offset, height, width, do_rectify)
};
struct CameraInfo {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;
  FAST_MESSAGE("sensor_msgs::msg::dds_::CameraInfo_", header, height, width, distortion_model, d, k, r, p, binning_x,
               binning_y, roi)
};
struct PointField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
  FAST_MESSAGE("sensor_msgs::msg::dds_::PointField_", name, offset, datatype, count)
};
struct PointCloud2 {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::vector<PointField> field_list;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;
  FAST_MESSAGE("sensor_msgs::msg::dds_::PointCloud2_", header, height, width, field_list, is_bigendian, point_step,
               row_step, data, is_dense)
};
struct UVCoordinate {
  float u = 0, v = 0;
  FAST_MESSAGE("visualization_msgs::msg::dds_::UVCoordinate_", u, v)
};
struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;
  FAST_MESSAGE("visualization_msgs::msg::dds_::MeshFile_", filename, data)
};
struct Marker {
  Header header;
  std::string ns;
  std::int32_t id = 0, type = 0, action = 0;
  Pose pose;
  Vector3 scale;
  ColorRGBA color;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text, mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  FAST_MESSAGE("visualization_msgs::msg::dds_::Marker_", header, ns, id, type, action, pose, scale, color, lifetime,
               frame_locked, points, colors, texture_resource, texture, uv_coordinates, text, mesh_resource, mesh_file,
               mesh_use_embedded_materials)
};
struct MarkerArray {
  std::vector<Marker> markers;
  FAST_MESSAGE("visualization_msgs::msg::dds_::MarkerArray_", markers)
};

#undef FAST_MESSAGE

template <typename T>
concept Message = requires {
  T::kDdsType;
};

}  // namespace fast
