#include "control/controller.h"

#include "base/error_list.h"

namespace robosim {

std::unique_ptr<Controller> cloneController(const Controller& controller, const std::string& name,
                                            const std::string& robot) {
  auto copy = controller.clone();
  if (copy) return copy;
  throw ConfigError("robot '" + robot + "': its controller " + name +
                    " cannot be copied, so that its run cannot be forked; implement Controller::clone(), or use "
                    "another controller");
}

}  // namespace robosim
