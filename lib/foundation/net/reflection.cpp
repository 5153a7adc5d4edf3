#include "net/reflection.h"

#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace robosim {

void enableReflection() {
  if (dlopen(ROBOSIM_GRPC_REFLECTION, RTLD_NOW)) return;
  throw std::runtime_error("cannot load " ROBOSIM_GRPC_REFLECTION ", which --reflection requires (" +
                           std::string(dlerror()) + "); install it, or serve without --reflection");
}

}  // namespace robosim
