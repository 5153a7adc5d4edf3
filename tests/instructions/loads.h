#pragma once
#include <functional>
#include <span>

namespace robosim {

/// A prepared piece of work whose instructions are counted.
struct InstructionWork {
  double units = 1;
  std::function<void()> work;
};

/// A small fixed load whose instructions are counted.
struct InstructionLoad {
  const char* name;
  const char* unit;  ///< "robot-step": unit of work
  InstructionWork (*prepare)();
};

std::span<const InstructionLoad> instructionLoads();

}  // namespace robosim

extern "C" {
/// Does the work. Callgrind counts only inside this function, which it finds by name.
void robosimCounted(const std::function<void()>& work);
}
