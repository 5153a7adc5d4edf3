#include "ros/message_type.h"

#include <algorithm>
#include <map>

#include <openssl/evp.h>

namespace robosim::ros {
namespace {

/// The types in a message at any depth, each once, depth first in the order of the fields.
void collectNested(const MessageType& type, std::vector<const MessageType*>& all) {
  for (const MessageType* nested : type.nested) {
    if (std::find(all.begin(), all.end(), nested) != all.end()) continue;
    all.push_back(nested);
    collectNested(*nested, all);
  }
}

/// "geometry_msgs/msg/Pose" as "geometry_msgs/Pose".
std::string withoutFolder(const std::string& name) {
  const std::size_t at = name.find("/msg/");
  return at == std::string::npos ? name : name.substr(0, at) + name.substr(at + 4);
}

/// Added to the id of an element's type.
int idOffset(FieldType::Repetition repetition) {
  switch (repetition) {
    case FieldType::Repetition::one:
      return 0;
    case FieldType::Repetition::array:
      return 48;
    case FieldType::Repetition::sequence:
      return 144;
  }
  return 0;
}

std::string jsonOf(const MessageType& type) {
  std::string json = R"({"type_name": ")" + type.name + R"(", "fields": [)";
  const char* separator = "";
  for (const auto& field : type.fields) {
    const bool is_nested = field.type.id == 1;
    json += separator;
    json += R"({"name": ")" + field.name + R"(", "type": {"type_id": )" +
            std::to_string(field.type.id + idOffset(field.type.repetition)) + R"(, "capacity": )" +
            std::to_string(field.type.capacity) + R"(, "string_capacity": 0, "nested_type_name": ")" +
            (is_nested ? field.type.name : "") + R"("}})";
    separator = ", ";
  }
  return json + "]}";
}

std::string sha256(const std::string& text) {
  unsigned char hash[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), hash, &size, EVP_sha256(), nullptr);
  std::string digits;
  for (unsigned i = 0; i < size; ++i) {
    digits += "0123456789abcdef"[hash[i] >> 4];
    digits += "0123456789abcdef"[hash[i] & 15];
  }
  return digits;
}

}  // namespace

void addNested(MessageType& type, const MessageType* nested) {
  if (nested == nullptr) return;
  if (std::find(type.nested.begin(), type.nested.end(), nested) == type.nested.end()) type.nested.push_back(nested);
}

std::string MessageType::text() const {
  std::string lines;
  for (const auto& field : fields) {
    lines += withoutFolder(field.type.name);
    if (field.type.repetition == FieldType::Repetition::sequence) lines += "[]";
    if (field.type.repetition == FieldType::Repetition::array) lines += "[" + std::to_string(field.type.capacity) + "]";
    lines += " " + field.name + "\n";
  }
  return lines;
}

std::string MessageType::definition() const {
  std::vector<const MessageType*> all;
  collectNested(*this, all);
  std::string texts = text();
  for (const MessageType* one : all) {
    texts += std::string(80, '=') + "\nMSG: " + withoutFolder(one->name) + "\n" + one->text();
  }
  return texts;
}

std::string MessageType::hash() const {
  std::vector<const MessageType*> all;
  collectNested(*this, all);
  std::map<std::string, const MessageType*> by_name;
  for (const MessageType* one : all) by_name[one->name] = one;
  std::string json = R"({"type_description": )" + jsonOf(*this) + R"(, "referenced_type_descriptions": [)";
  const char* separator = "";
  for (const auto& [type_name, one] : by_name) {
    json += separator + jsonOf(*one);
    separator = ", ";
  }
  return "RIHS01_" + sha256(json + "]}");
}

}  // namespace robosim::ros
