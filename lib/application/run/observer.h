#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control/parameters.h"
#include "control/type_registry.h"
#include "environment/environment.h"

namespace robosim {

/// A figure of a whole run.
struct Metric {
  std::string name;  ///< with its unit as suffix, like a parameter: "covered_percent"
  double value = 0;  ///< NaN when the run has none, such as the time of an event that did not happen
};

/// What an observer may use.
struct ObserverSetup {
  std::uint64_t seed = 1;  ///< of the run
  /// Prints a line with the simulated time and the observer's name to standard error.
  std::function<void(const std::string& line)> log;
};

/// Changes a run between two steps, for an observer.
class Supervisor {
 public:
  /// @param author of its interventions
  Supervisor(Environment& environment, std::string author) : environment_(environment), author_(std::move(author)) {}

  const Environment& environment() const { return environment_; }
  /// Applies a change, which the recording contains with the observer's name.
  /// @return what is wrong, and how to fix it, without a change; empty when it is applied
  [[nodiscard]] std::string apply(const Change& change) { return environment_.apply({author_, change}); }

 private:
  Environment& environment_;
  std::string author_;
};

/// Watches a run from outside the robots, with access to the true state of the world: computes metrics, ends the run
/// on a condition of its own, logs, and may change the run (supervise()).
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called before the first step (step 0) and after each step.
  virtual void observe(const Environment& environment) = 0;
  /// Called after all observers' observe(), to change the run: moves objects, ends it with an outcome. A repetition of
  /// the run from its recording makes the recorded changes, and does not call this. Requires ObserverType::supervises.
  virtual void supervise(Supervisor& /*supervisor*/) {}
  /// Why the run should end now, as a phrase: "90 % covered"; empty to continue. Called after each observe().
  virtual std::string endReason() const { return {}; }
  /// At the end of the run; always the same names in the same order.
  virtual std::vector<Metric> metrics() const { return {}; }
  /// A copy that continues independently from the same state, for a fork of the run. Null, the default, for an observer
  /// that cannot be copied, whose run cannot be forked. @param setup of the copy
  virtual std::unique_ptr<Observer> clone(const ObserverSetup& /*setup*/) const { return nullptr; }
};

/// The end of a run by an observer.
struct ObserverEnd {
  std::string observer;  ///< its name
  std::string reason;    ///< Observer::endReason()
};

/// A kind of observer.
struct ObserverType {
  using Setup = ObserverSetup;
  static constexpr const char* kKind = "observer";

  std::string name;  ///< on the command line; of letters, digits and '_'
  std::string help;  ///< one sentence
  std::vector<Parameter> parameters;
  std::function<std::unique_ptr<Observer>(const ObserverSetup&, const ParameterValues&)> make;
  bool supervises = false;      ///< whether it changes the run: Observer::supervise() is called
  bool reads_pictures = false;  ///< whether it reads the pictures of cameras, which are otherwise not taken for it
};

using ObserverRegistry = TypeRegistry<ObserverType>;

/// The observers of this program.
ObserverRegistry& observers();

/// An exception of an observer.
class ObserverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace robosim
