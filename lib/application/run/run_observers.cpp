#include "run/run_observers.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "base/text_table.h"
#include "base/type_choice.h"

namespace robosim {
namespace {

/// Calls a function of an observer, and replaces its exceptions.
template <typename Function>
auto guarded(const std::string& choice, const Function& function) {
  const std::string prefix = "observer '" + choice + "' threw an exception: ";
  try {
    return function();
  } catch (const std::exception& error) {
    throw ObserverError(prefix + error.what());
  } catch (...) {
    throw ObserverError(prefix + "an object that is not a std::exception");
  }
}

}  // namespace

void checkObservers(const std::vector<std::string>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) {
    observers().parametersOf(choice);
    names.push_back(TypeChoice::parse(choice).name);
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      throw ConfigError("observer '" + names.back() + "' is given twice; keep one");
    }
  }
}

bool readPictures(const std::vector<std::string>& choices) {
  return std::any_of(choices.begin(), choices.end(),
                     [](const std::string& choice) { return observers().typeOf(choice).reads_pictures; });
}

bool anySupervises(const std::vector<std::string>& choices) {
  return std::any_of(choices.begin(), choices.end(),
                     [](const std::string& choice) { return observers().typeOf(choice).supervises; });
}

RunObservers::RunObservers(const std::vector<std::string>& choices, std::uint64_t seed, bool is_logging,
                           bool is_supervising)
    : seed_(seed), is_logging_(is_logging), is_supervising_(is_supervising) {
  checkObservers(choices);
  for (const auto& choice : choices) {
    const std::string name = TypeChoice::parse(choice).name;
    const ObserverSetup setup = makeSetup(name);
    const ParameterValues values = observers().parametersOf(choice);
    auto observer = guarded(choice, [&] { return observers().typeOf(choice).make(setup, values); });
    if (!observer) throw ObserverError("observer '" + choice + "': its type has made none");
    observers_.push_back({choice, name, std::move(observer), observers().typeOf(choice).supervises});
  }
}

RunObservers::RunObservers(Fork fork)
    : seed_(fork.original.seed_),
      is_logging_(fork.original.is_logging_),
      is_supervising_(fork.original.is_supervising_),
      now_s_(fork.original.now_s_),
      end_(fork.original.end_) {
  for (const auto& one : fork.original.observers_) {
    auto copy = guarded(one.choice, [&] { return one.observer->clone(makeSetup(one.name)); });
    if (!copy) {
      throw ConfigError("observer '" + one.choice + "': has no clone(), so that its run cannot be forked; add " +
                        "Observer::clone() to it, or run without it");
    }
    observers_.push_back({one.choice, one.name, std::move(copy), one.supervises});
  }
}

ObserverSetup RunObservers::makeSetup(const std::string& name) {
  if (!is_logging_) return {seed_, [](const std::string&) {}};
  return {seed_, [this, name](const std::string& line) { logInfo(name, "at " + fixed(now_s_, 3) + " s: " + line); }};
}

void RunObservers::observe(const Environment& environment) {
  now_s_ = environment.time().seconds();
  for (const auto& one : observers_) {
    std::string reason = guarded(one.choice, [&] {
      one.observer->observe(environment);
      return one.observer->endReason();
    });
    if (!end_ && !reason.empty()) end_ = {one.name, std::move(reason)};
  }
}

void RunObservers::supervise(Environment& environment) {
  if (!is_supervising_) return;
  for (const auto& one : observers_) {
    if (!one.supervises) continue;
    Supervisor supervisor(environment, "observer " + one.name);
    guarded(one.choice, [&] { one.observer->supervise(supervisor); });
  }
}

std::vector<Metric> RunObservers::metrics() const {
  std::vector<Metric> all;
  for (const auto& one : observers_) {
    for (Metric& metric : guarded(one.choice, [&] { return one.observer->metrics(); })) {
      metric.name = one.name + "." + metric.name;
      all.push_back(std::move(metric));
    }
  }
  return all;
}

}  // namespace robosim
