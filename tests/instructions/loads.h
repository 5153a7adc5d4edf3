#pragma once
#include <functional>
#include <span>

namespace robosim {

/// Some work, ready to be done and counted.
struct InstructionWork {
  double units = 1;
  std::function<void()> work;
};

/// A small load, the same always, of which the instructions are counted.
struct InstructionLoad {
  const char* name;
  const char* unit;  ///< "robot-step": what instructions are told by
  InstructionWork (*prepare)();
};

std::span<const InstructionLoad> instructionLoads();

}  // namespace robosim

extern "C" {
/// Does the work. Callgrind counts while this runs, and not what comes before and after; it knows it by its name.
void robosimCounted(const std::function<void()>& work);
}
