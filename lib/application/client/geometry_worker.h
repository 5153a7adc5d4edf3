#pragma once
#include <memory>

#include "net/connect.h"
#include "world/world.h"

namespace robosim {

/// Client of the Geometry service: keeps a replica of a remote environment, and computes the range measurements of some
/// of its robots in each step.
class GeometryWorker {
 public:
  GeometryWorker(const ConnectOptions& connect_options, int threads);
  ~GeometryWorker();
  GeometryWorker(const GeometryWorker&) = delete;
  GeometryWorker& operator=(const GeometryWorker&) = delete;

  /// Connects, and builds a replica of the world received. May be called again after the connection has broken.
  /// @throws ConnectionError when the server does not answer or closes the connection; ConfigError for a world that
  /// cannot be built.
  void connect();
  /// Processes tasks until the run is over. @throws as connect()
  void work();

  const World& world() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
