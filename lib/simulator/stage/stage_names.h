#pragma once
#include <set>
#include <string>

namespace robosim::stage {

/// A name for a robot or an object that no other has, with the characters that a world file allows.
class UniqueNames {
 public:
  std::string make(const std::string& wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace robosim::stage
