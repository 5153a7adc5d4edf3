#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/observer.h"

namespace robosim {

/// Checks names and parameters of observers, given as TypeChoice::text(). @throws ConfigError
void checkObservers(const std::vector<std::string>& choices);

/// Whether one of the observers reads pictures (ObserverType::reads_pictures). @throws ConfigError for an unknown one
bool readPictures(const std::vector<std::string>& choices);

/// Whether one of the observers changes the run (ObserverType::supervises). @throws ConfigError for an unknown one
bool anySupervises(const std::vector<std::string>& choices);

/// The observers of one run.
class RunObservers {
 public:
  /// @param choices as TypeChoice::text(), each at most once
  /// @param is_logging whether ObserverSetup::log prints
  /// @param is_supervising whether Observer::supervise() is called, of those that have ObserverType::supervises
  /// @throws ConfigError for an unknown observer or an invalid parameter
  /// @throws ObserverError for an exception of an observer's constructor
  RunObservers(const std::vector<std::string>& choices, std::uint64_t seed, bool is_logging = true,
               bool is_supervising = true);
  /// Copies that continue independently, for a fork of the run.
  struct Fork {
    const RunObservers& original;
  };
  /// @throws ConfigError naming an observer that cannot be copied
  explicit RunObservers(Fork fork);
  RunObservers(const RunObservers&) = delete;
  RunObservers& operator=(const RunObservers&) = delete;

  /// Lets all observe the present state, one after the other. @throws ObserverError
  void observe(const Environment& environment);
  /// Lets those that supervise change the run, after all have observed, so that metrics depend neither on the
  /// observers' order nor on who makes the changes. @throws ObserverError
  void supervise(Environment& environment);
  /// The first observer that ends the run; nullopt to continue.
  const std::optional<ObserverEnd>& end() const { return end_; }
  /// The metrics of all, "OBSERVER.METRIC". @throws ObserverError
  std::vector<Metric> metrics() const;

 private:
  struct Named {
    std::string choice, name;
    std::unique_ptr<Observer> observer;
    bool supervises = false;
  };
  ObserverSetup makeSetup(const std::string& name);

  std::uint64_t seed_;
  bool is_logging_;
  bool is_supervising_;
  double now_s_ = 0;  ///< simulated time of the present observation, for log lines
  std::optional<ObserverEnd> end_;
  std::vector<Named> observers_;
};

}  // namespace robosim
