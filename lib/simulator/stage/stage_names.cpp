#include "stage/stage_names.h"

namespace robosim::stage {

std::string UniqueNames::make(const std::string& wanted) {
  std::string name;
  for (const char c : wanted) name += c > ' ' && c < 0x7f && c != '/' ? c : '_';
  if (name.empty()) name = "model";
  std::string unique = name;
  for (int i = 2; !taken_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
  return unique;
}

}  // namespace robosim::stage
