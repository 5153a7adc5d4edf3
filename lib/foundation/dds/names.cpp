#include "dds/names.h"

namespace robosim::dds {

std::string ddsTopicName(const std::string& topic) { return "rt" + topic; }

std::string ddsTypeName(const std::string& message_type) {
  std::string name;
  const auto last = message_type.rfind('/');
  for (std::size_t i = 0; i < message_type.size(); ++i) {
    if (message_type[i] != '/') {
      name += message_type[i];
    } else {
      name += i == last ? "::dds_::" : "::";
    }
  }
  return name + "_";
}

}  // namespace robosim::dds
