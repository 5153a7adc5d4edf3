#pragma once
#include <memory>

#include "net/dial.h"
#include "world/world.h"

namespace robosim {

/// Works for an environment elsewhere: keeps a replica of its world, and does its share of each step.
class GeometryWorker {
 public:
  GeometryWorker(const DialOptions& dial_options, int threads);
  ~GeometryWorker();
  GeometryWorker(const GeometryWorker&) = delete;
  GeometryWorker& operator=(const GeometryWorker&) = delete;

  /// Joins, and builds a replica of the world that it is sent. Again, when the connection has broken.
  /// @throws ConnectionError when nobody answers, or the environment hangs up; ConfigError for a world that cannot be
  /// built here.
  void connect();
  /// Works until the run is over. @throws as connect()
  void work();

  const World& world() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace robosim
