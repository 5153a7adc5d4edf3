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

RunObservers::RunObservers(const std::vector<std::string>& choices, std::uint64_t seed, bool is_logging) {
  checkObservers(choices);
  for (const auto& choice : choices) {
    const std::string name = TypeChoice::parse(choice).name;
    ObserverSetup setup;
    setup.seed = seed;
    setup.log = [](const std::string&) {};
    if (is_logging) {
      setup.log = [this, name](const std::string& line) { logInfo(name, "at " + fixed(now_s_, 3) + " s: " + line); };
    }
    const ParameterValues values = observers().parametersOf(choice);
    auto observer = guarded(choice, [&] { return observers().typeOf(choice).make(setup, values); });
    if (!observer) throw ObserverError("observer '" + choice + "': its type has made none");
    observers_.push_back({choice, name, std::move(observer)});
  }
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
