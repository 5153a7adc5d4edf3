#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "base/printable_text.h"

namespace robosim {

/// A JSON document for standard output, indented by two spaces: printableJson(), with invalid UTF-8 replaced.
inline std::string jsonText(const nlohmann::ordered_json& json) {
  return printableJson(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace robosim
