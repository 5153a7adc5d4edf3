#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Messages of ROS 2, as of Iron and later, with the names and the order of their fields in common_interfaces 5.4.2.
/// Each describes itself: kType is its name, and describe() visits its fields in order. Encoding, decoding (cdr.h), the
/// text of its definition and its hash (message_type.h) derive from that. Units and frames are those of REP 103: SI,
/// x forward, y left, z up.
namespace robosim::ros {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static constexpr const char* kType = "builtin_interfaces/msg/Time";
  static void describe(auto& self, auto&& visit) {
    visit("sec", self.sec);
    visit("nanosec", self.nanosec);
  }
  bool operator==(const Time&) const = default;
};

struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static constexpr const char* kType = "builtin_interfaces/msg/Duration";
  static void describe(auto& self, auto&& visit) {
    visit("sec", self.sec);
    visit("nanosec", self.nanosec);
  }
  bool operator==(const Duration&) const = default;
};

struct Clock {
  Time clock;
  static constexpr const char* kType = "rosgraph_msgs/msg/Clock";
  static void describe(auto& self, auto&& visit) { visit("clock", self.clock); }
  bool operator==(const Clock&) const = default;
};

struct Header {
  Time stamp;
  std::string frame_id;  ///< without a leading slash
  static constexpr const char* kType = "std_msgs/msg/Header";
  static void describe(auto& self, auto&& visit) {
    visit("stamp", self.stamp);
    visit("frame_id", self.frame_id);
  }
  bool operator==(const Header&) const = default;
};

struct String {
  std::string data;
  static constexpr const char* kType = "std_msgs/msg/String";
  static void describe(auto& self, auto&& visit) { visit("data", self.data); }
  bool operator==(const String&) const = default;
};

struct ColorRGBA {
  float r = 0, g = 0, b = 0, a = 0;
  static constexpr const char* kType = "std_msgs/msg/ColorRGBA";
  static void describe(auto& self, auto&& visit) {
    visit("r", self.r);
    visit("g", self.g);
    visit("b", self.b);
    visit("a", self.a);
  }
  bool operator==(const ColorRGBA&) const = default;
};

struct MultiArrayDimension {
  std::string label;
  std::uint32_t size = 0;
  std::uint32_t stride = 0;  ///< number of elements of this dimension and those after it
  static constexpr const char* kType = "std_msgs/msg/MultiArrayDimension";
  static void describe(auto& self, auto&& visit) {
    visit("label", self.label);
    visit("size", self.size);
    visit("stride", self.stride);
  }
  bool operator==(const MultiArrayDimension&) const = default;
};

struct MultiArrayLayout {
  std::vector<MultiArrayDimension> dim;
  std::uint32_t data_offset = 0;
  static constexpr const char* kType = "std_msgs/msg/MultiArrayLayout";
  static void describe(auto& self, auto&& visit) {
    visit("dim", self.dim);
    visit("data_offset", self.data_offset);
  }
  bool operator==(const MultiArrayLayout&) const = default;
};

struct UInt8MultiArray {
  MultiArrayLayout layout;
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "std_msgs/msg/UInt8MultiArray";
  static void describe(auto& self, auto&& visit) {
    visit("layout", self.layout);
    visit("data", self.data);
  }
  bool operator==(const UInt8MultiArray&) const = default;
};

struct Float64MultiArray {
  MultiArrayLayout layout;
  std::vector<double> data;
  static constexpr const char* kType = "std_msgs/msg/Float64MultiArray";
  static void describe(auto& self, auto&& visit) {
    visit("layout", self.layout);
    visit("data", self.data);
  }
  bool operator==(const Float64MultiArray&) const = default;
};

struct Vector3 {
  double x = 0, y = 0, z = 0;
  static constexpr const char* kType = "geometry_msgs/msg/Vector3";
  static void describe(auto& self, auto&& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
  }
  bool operator==(const Vector3&) const = default;
};

struct Point {
  double x = 0, y = 0, z = 0;
  static constexpr const char* kType = "geometry_msgs/msg/Point";
  static void describe(auto& self, auto&& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
  }
  bool operator==(const Point&) const = default;
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  static constexpr const char* kType = "geometry_msgs/msg/Quaternion";
  static void describe(auto& self, auto&& visit) {
    visit("x", self.x);
    visit("y", self.y);
    visit("z", self.z);
    visit("w", self.w);
  }
  bool operator==(const Quaternion&) const = default;
};

struct Pose {
  Point position;
  Quaternion orientation;
  static constexpr const char* kType = "geometry_msgs/msg/Pose";
  static void describe(auto& self, auto&& visit) {
    visit("position", self.position);
    visit("orientation", self.orientation);
  }
  bool operator==(const Pose&) const = default;
};

struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};  ///< row-major: x, y, z, rotations about X, Y, Z
  static constexpr const char* kType = "geometry_msgs/msg/PoseWithCovariance";
  static void describe(auto& self, auto&& visit) {
    visit("pose", self.pose);
    visit("covariance", self.covariance);
  }
  bool operator==(const PoseWithCovariance&) const = default;
};

struct PoseWithCovarianceStamped {
  Header header;
  PoseWithCovariance pose;
  static constexpr const char* kType = "geometry_msgs/msg/PoseWithCovarianceStamped";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("pose", self.pose);
  }
  bool operator==(const PoseWithCovarianceStamped&) const = default;
};

struct Twist {
  Vector3 linear;   ///< [m/s]
  Vector3 angular;  ///< [rad/s]
  static constexpr const char* kType = "geometry_msgs/msg/Twist";
  static void describe(auto& self, auto&& visit) {
    visit("linear", self.linear);
    visit("angular", self.angular);
  }
  bool operator==(const Twist&) const = default;
};

struct TwistStamped {
  Header header;
  Twist twist;
  static constexpr const char* kType = "geometry_msgs/msg/TwistStamped";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("twist", self.twist);
  }
  bool operator==(const TwistStamped&) const = default;
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};
  static constexpr const char* kType = "geometry_msgs/msg/TwistWithCovariance";
  static void describe(auto& self, auto&& visit) {
    visit("twist", self.twist);
    visit("covariance", self.covariance);
  }
  bool operator==(const TwistWithCovariance&) const = default;
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;
  static constexpr const char* kType = "geometry_msgs/msg/Transform";
  static void describe(auto& self, auto&& visit) {
    visit("translation", self.translation);
    visit("rotation", self.rotation);
  }
  bool operator==(const Transform&) const = default;
};

/// Pose of the child frame in the header's.
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  static constexpr const char* kType = "geometry_msgs/msg/TransformStamped";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("child_frame_id", self.child_frame_id);
    visit("transform", self.transform);
  }
  bool operator==(const TransformStamped&) const = default;
};

struct TFMessage {
  std::vector<TransformStamped> transforms;
  static constexpr const char* kType = "tf2_msgs/msg/TFMessage";
  static void describe(auto& self, auto&& visit) { visit("transforms", self.transforms); }
  bool operator==(const TFMessage&) const = default;
};

/// The pose is in the header's frame, the twist in the child frame.
struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  static constexpr const char* kType = "nav_msgs/msg/Odometry";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("child_frame_id", self.child_frame_id);
    visit("pose", self.pose);
    visit("twist", self.twist);
  }
  bool operator==(const Odometry&) const = default;
};

struct MapMetaData {
  Time map_load_time;
  float resolution = 0;  ///< side of a cell [m]
  std::uint32_t width = 0, height = 0;
  Pose origin;  ///< of the lower left corner of the first cell
  static constexpr const char* kType = "nav_msgs/msg/MapMetaData";
  static void describe(auto& self, auto&& visit) {
    visit("map_load_time", self.map_load_time);
    visit("resolution", self.resolution);
    visit("width", self.width);
    visit("height", self.height);
    visit("origin", self.origin);
  }
  bool operator==(const MapMetaData&) const = default;
};

struct OccupancyGrid {
  Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;  ///< row by row from the lowest y: 0 free to 100 occupied, -1 unknown
  static constexpr const char* kType = "nav_msgs/msg/OccupancyGrid";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("info", self.info);
    visit("data", self.data);
  }
  bool operator==(const OccupancyGrid&) const = default;
};

/// Ranges by REP 117: +infinity for no echo, -infinity for an object nearer than range_min, NaN for an invalid one.
struct LaserScan {
  Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0;  ///< about z, 0 along x, counter-clockwise [rad]
  float time_increment = 0, scan_time = 0;                  ///< [s]
  float range_min = 0, range_max = 0;                       ///< [m]
  std::vector<float> ranges;                                ///< [m]
  std::vector<float> intensities;                           ///< as many as ranges, or none
  static constexpr const char* kType = "sensor_msgs/msg/LaserScan";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("angle_min", self.angle_min);
    visit("angle_max", self.angle_max);
    visit("angle_increment", self.angle_increment);
    visit("time_increment", self.time_increment);
    visit("scan_time", self.scan_time);
    visit("range_min", self.range_min);
    visit("range_max", self.range_max);
    visit("ranges", self.ranges);
    visit("intensities", self.intensities);
  }
  bool operator==(const LaserScan&) const = default;
};

struct Range {
  static constexpr std::uint8_t kUltrasound = 0, kInfrared = 1;
  Header header;
  std::uint8_t radiation_type = kUltrasound;
  float field_of_view = 0;                        ///< full angle [rad]
  float min_range = 0, max_range = 0, range = 0;  ///< [m], as LaserScan::ranges
  float variance = 0;                             ///< [m²]; 0 for unknown
  static constexpr const char* kType = "sensor_msgs/msg/Range";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("radiation_type", self.radiation_type);
    visit("field_of_view", self.field_of_view);
    visit("min_range", self.min_range);
    visit("max_range", self.max_range);
    visit("range", self.range);
    visit("variance", self.variance);
  }
  bool operator==(const Range&) const = default;
};

/// Range of Humble, which has no variance; with the bytes of both, as those behind the last field are ignored.
struct HumbleRange {
  Header header;
  std::uint8_t radiation_type = Range::kUltrasound;
  float field_of_view = 0, min_range = 0, max_range = 0, range = 0;  ///< as of Range
  static constexpr const char* kType = Range::kType;
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("radiation_type", self.radiation_type);
    visit("field_of_view", self.field_of_view);
    visit("min_range", self.min_range);
    visit("max_range", self.max_range);
    visit("range", self.range);
  }
  bool operator==(const HumbleRange&) const = default;
};

/// What is not measured is NaN.
struct BatteryState {
  static constexpr std::uint8_t kDischarging = 2;
  Header header;
  float voltage = 0, temperature = 0, current = 0, charge = 0, capacity = 0, design_capacity = 0;
  float percentage = 0;  ///< [0, 1]
  std::uint8_t power_supply_status = 0, power_supply_health = 0, power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage, cell_temperature;
  std::string location, serial_number;
  static constexpr const char* kType = "sensor_msgs/msg/BatteryState";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("voltage", self.voltage);
    visit("temperature", self.temperature);
    visit("current", self.current);
    visit("charge", self.charge);
    visit("capacity", self.capacity);
    visit("design_capacity", self.design_capacity);
    visit("percentage", self.percentage);
    visit("power_supply_status", self.power_supply_status);
    visit("power_supply_health", self.power_supply_health);
    visit("power_supply_technology", self.power_supply_technology);
    visit("present", self.present);
    visit("cell_voltage", self.cell_voltage);
    visit("cell_temperature", self.cell_temperature);
    visit("location", self.location);
    visit("serial_number", self.serial_number);
  }
  bool operator==(const BatteryState&) const = default;
};

struct Temperature {
  Header header;
  double temperature = 0;  ///< [°C]
  double variance = 0;     ///< 0 for unknown
  static constexpr const char* kType = "sensor_msgs/msg/Temperature";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("temperature", self.temperature);
    visit("variance", self.variance);
  }
  bool operator==(const Temperature&) const = default;
};

/// A first covariance of -1 means that the quantity is not measured.
struct Imu {
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;  ///< [rad/s]
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;  ///< [m/s²]
  std::array<double, 9> linear_acceleration_covariance{};
  static constexpr const char* kType = "sensor_msgs/msg/Imu";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("orientation", self.orientation);
    visit("orientation_covariance", self.orientation_covariance);
    visit("angular_velocity", self.angular_velocity);
    visit("angular_velocity_covariance", self.angular_velocity_covariance);
    visit("linear_acceleration", self.linear_acceleration);
    visit("linear_acceleration_covariance", self.linear_acceleration_covariance);
  }
  bool operator==(const Imu&) const = default;
};

struct NavSatStatus {
  static constexpr std::int8_t kNoFix = -1, kFix = 0;
  static constexpr std::uint16_t kGps = 1;
  std::int8_t status = kNoFix;
  std::uint16_t service = kGps;
  static constexpr const char* kType = "sensor_msgs/msg/NavSatStatus";
  static void describe(auto& self, auto&& visit) {
    visit("status", self.status);
    visit("service", self.service);
  }
  bool operator==(const NavSatStatus&) const = default;
};

struct NavSatFix {
  Header header;
  NavSatStatus status;
  double latitude = 0, longitude = 0;  ///< [degrees], WGS 84
  double altitude = 0;                 ///< [m] above the ellipsoid
  std::array<double, 9> position_covariance{};
  std::uint8_t position_covariance_type = 0;  ///< 0: unknown
  static constexpr const char* kType = "sensor_msgs/msg/NavSatFix";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("status", self.status);
    visit("latitude", self.latitude);
    visit("longitude", self.longitude);
    visit("altitude", self.altitude);
    visit("position_covariance", self.position_covariance);
    visit("position_covariance_type", self.position_covariance_type);
  }
  bool operator==(const NavSatFix&) const = default;
};

struct CompressedImage {
  Header header;       ///< of the optical frame: z forward, x right, y down
  std::string format;  ///< "jpeg" or "png"
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "sensor_msgs/msg/CompressedImage";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("format", self.format);
    visit("data", self.data);
  }
  bool operator==(const CompressedImage&) const = default;
};

struct Image {
  Header header;  ///< of the optical frame
  std::uint32_t height = 0, width = 0;
  std::string encoding;  ///< "rgb8", "mono8", …
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  ///< bytes of a row
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "sensor_msgs/msg/Image";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("height", self.height);
    visit("width", self.width);
    visit("encoding", self.encoding);
    visit("is_bigendian", self.is_bigendian);
    visit("step", self.step);
    visit("data", self.data);
  }
  bool operator==(const Image&) const = default;
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
  static constexpr const char* kType = "sensor_msgs/msg/RegionOfInterest";
  static void describe(auto& self, auto&& visit) {
    visit("x_offset", self.x_offset);
    visit("y_offset", self.y_offset);
    visit("height", self.height);
    visit("width", self.width);
    visit("do_rectify", self.do_rectify);
  }
  bool operator==(const RegionOfInterest&) const = default;
};

struct CameraInfo {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;  ///< "plumb_bob"
  std::vector<double> d;         ///< distortion: k1, k2, t1, t2, k3
  std::array<double, 9> k{};     ///< intrinsic matrix, row by row
  std::array<double, 9> r{};     ///< rectification matrix
  std::array<double, 12> p{};    ///< projection matrix, 3 × 4
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;
  static constexpr const char* kType = "sensor_msgs/msg/CameraInfo";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("height", self.height);
    visit("width", self.width);
    visit("distortion_model", self.distortion_model);
    visit("d", self.d);
    visit("k", self.k);
    visit("r", self.r);
    visit("p", self.p);
    visit("binning_x", self.binning_x);
    visit("binning_y", self.binning_y);
    visit("roi", self.roi);
  }
  bool operator==(const CameraInfo&) const = default;
};

struct PointField {
  static constexpr std::uint8_t kFloat32 = 7, kFloat64 = 8;
  std::string name;
  std::uint32_t offset = 0;  ///< from the start of a point [bytes]
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
  static constexpr const char* kType = "sensor_msgs/msg/PointField";
  static void describe(auto& self, auto&& visit) {
    visit("name", self.name);
    visit("offset", self.offset);
    visit("datatype", self.datatype);
    visit("count", self.count);
  }
  bool operator==(const PointField&) const = default;
};

struct PointCloud2 {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;  ///< [bytes]
  std::vector<std::uint8_t> data;
  bool is_dense = false;  ///< no point is invalid
  static constexpr const char* kType = "sensor_msgs/msg/PointCloud2";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("height", self.height);
    visit("width", self.width);
    visit("fields", self.fields);
    visit("is_bigendian", self.is_bigendian);
    visit("point_step", self.point_step);
    visit("row_step", self.row_step);
    visit("data", self.data);
    visit("is_dense", self.is_dense);
  }
  bool operator==(const PointCloud2&) const = default;
};

struct UVCoordinate {
  float u = 0, v = 0;
  static constexpr const char* kType = "visualization_msgs/msg/UVCoordinate";
  static void describe(auto& self, auto&& visit) {
    visit("u", self.u);
    visit("v", self.v);
  }
  bool operator==(const UVCoordinate&) const = default;
};

struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "visualization_msgs/msg/MeshFile";
  static void describe(auto& self, auto&& visit) {
    visit("filename", self.filename);
    visit("data", self.data);
  }
  bool operator==(const MeshFile&) const = default;
};

struct Marker {
  static constexpr std::int32_t kArrow = 0, kCube = 1, kSphere = 2, kCylinder = 3, kLineList = 5, kText = 9;  ///< type
  static constexpr std::int32_t kAdd = 0, kDelete = 2, kDeleteAll = 3;  ///< action
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
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  static constexpr const char* kType = "visualization_msgs/msg/Marker";
  static void describe(auto& self, auto&& visit) {
    visit("header", self.header);
    visit("ns", self.ns);
    visit("id", self.id);
    visit("type", self.type);
    visit("action", self.action);
    visit("pose", self.pose);
    visit("scale", self.scale);
    visit("color", self.color);
    visit("lifetime", self.lifetime);
    visit("frame_locked", self.frame_locked);
    visit("points", self.points);
    visit("colors", self.colors);
    visit("texture_resource", self.texture_resource);
    visit("texture", self.texture);
    visit("uv_coordinates", self.uv_coordinates);
    visit("text", self.text);
    visit("mesh_resource", self.mesh_resource);
    visit("mesh_file", self.mesh_file);
    visit("mesh_use_embedded_materials", self.mesh_use_embedded_materials);
  }
  bool operator==(const Marker&) const = default;
};

struct MarkerArray {
  std::vector<Marker> markers;
  static constexpr const char* kType = "visualization_msgs/msg/MarkerArray";
  static void describe(auto& self, auto&& visit) { visit("markers", self.markers); }
  bool operator==(const MarkerArray&) const = default;
};

}  // namespace robosim::ros
