#pragma once

namespace robosim {

/// Loads gRPC's library for reflection, which this program is not linked to: it adds the service to all servers whose
/// grpc::ServerBuilder is created from then on.
/// @throws std::runtime_error with how to fix it when the library is not installed.
void enableReflection();

}  // namespace robosim
