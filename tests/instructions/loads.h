#pragma once
#include <functional>
#include <vector>

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
  bool is_in_short_form = true;
};

/// The short form of ./dev test counts the shapes of beams, all errors together, a batch, a run and a load of a world;
/// the long form also each error by itself, and longer rays.
enum class Form { brief, whole };
std::vector<InstructionLoad> instructionLoads(Form form = Form::whole);

}  // namespace robosim

extern "C" {
/// Does the work. Callgrind counts only inside this function, which it finds by name.
void robosimCounted(const std::function<void()>& work);
}
