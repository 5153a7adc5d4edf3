#include "aria/robot_list.h"

#include <cmath>
#include <optional>
#include <unordered_set>

#include "base/xml_reader.h"

namespace robosim {
namespace {

std::vector<RobotAddress> readFrom(XmlReader root) {
  if (root.name() != "RobotInfo") {
    root.error("is not a robot list; the first element of one is <RobotInfo>");
    return {};
  }
  std::vector<RobotAddress> list;
  std::unordered_set<std::string> names;
  std::optional<std::string> primary;
  for (auto& robot : root.all("robot")) {
    RobotAddress address;
    address.hostname = robot.word("hostname");
    const double port = robot.number("port", {1, 65535});
    if (port != std::floor(port)) robot.errorAt("port", "must be a whole number");
    address.port = static_cast<std::uint16_t>(port);
    address.name = robot.word("name");
    if (!address.name.empty() && !names.insert(address.name).second) {
      robot.errorAt("name", "is in the list already; keep one of the two");
    }
    if (!robot.has("primary")) robot.error("<primary> is missing; write 1 or 0 there");
    address.primary = robot.flag("primary", false);
    if (address.primary && primary) {
      robot.errorAt("primary", "'" + *primary + "' is primary already; write 0 for all robots but one");
    }
    if (address.primary && !primary) primary = address.name;
    robot.finish();
    list.push_back(std::move(address));
  }
  if (!primary) root.error("no robot is primary; write <primary>1</primary> for the one to be driven first");
  root.finish();
  return list;
}

}  // namespace

std::vector<RobotAddress> readRobotList(const std::filesystem::path& file, ErrorList& errors) {
  try {
    return robotListFrom(readXmlFile(file), file.string(), errors);
  } catch (const ConfigError& error) {
    errors.add(error);
    return {};
  }
}

std::vector<RobotAddress> robotListFrom(const XmlElement& root, const std::string& file, ErrorList& errors) {
  return readFrom(XmlReader(root, file, errors));
}

}  // namespace robosim
