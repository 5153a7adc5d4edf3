#include "distributed/run_identity.h"

#include <algorithm>
#include <span>

#include "base/digest.h"
#include "base/error_list.h"
#include "distributed/distributed_run.h"
#include "environment/state_stream.h"

namespace robosim {
namespace {

void addText(Digest& digest, const std::string& text) {
  digest.add(text.size());
  digest.addBytes(text.data(), text.size());
}

/// Of the robots with which the run began: on rank 0, observers may have added others.
std::uint64_t digestOfControllers(const Model& model, const std::string& instead) {
  Digest digest;
  const std::span<const FleetRobot> robots = model.fleet.robots;
  for (const FleetRobot& robot : robots.first(robots.size() - model.additions.size())) {
    addText(digest, controllerOf(*robot.controller, instead));
    addText(digest, robot.info.neighbour);
    addText(digest, robot.info.type->model);
  }
  return digest.value();
}

std::uint64_t digestOfOptions(const RunOptions& options, const DistributionOptions& distribution) {
  Digest digest;
  digest.add(options.breakdown_mean_s);
  digest.add(options.observers.empty());
  digest.add(distribution.first_needs_readings);
  digest.add(distribution.first_needs_poses);
  digest.add(distribution.balance_steps);
  digest.add(distribution.exchange);
  return digest.value();
}

constexpr std::size_t kDigests = 3;
constexpr std::size_t kVersionAt = kDigests * sizeof(std::uint64_t);  ///< after the digests

}  // namespace

std::string describeIdentity(const Model& model, const RunOptions& options, const DistributionOptions& distribution) {
  StateWriter identity;
  identity.addNumber(digestOfStart(model));
  identity.addNumber(digestOfControllers(model, options.controller));
  identity.addNumber(digestOfOptions(options, distribution));
  identity.bytes += ROBOSIM_VERSION;
  return std::move(identity.bytes);
}

void requireSameRun(std::string_view own, std::string_view first) {
  const auto version = [](std::string_view identity) {
    return std::string(identity.substr(std::min(kVersionAt, identity.size())));
  };
  if (version(own) != version(first)) {
    throw ConfigError("this process is RoboSim " + version(own) + ", and rank 0 is RoboSim " + version(first) +
                      "; use the same version on all machines");
  }
  constexpr const char* kDifferences[kDigests] = {
      "this process has read another world than rank 0, or was given another seed or time step; give all machines the "
      "same files and options",
      "this process has read a world with other controllers, neighbours or types of robots than rank 0, or was given "
      "another controller; give all machines the same files and options",
      "this process was given other options than rank 0; give all the same ones"};
  for (std::size_t i = 0; i < kDigests; ++i) {
    const std::size_t at = i * sizeof(std::uint64_t);
    if (own.substr(at, sizeof(std::uint64_t)) != first.substr(at, sizeof(std::uint64_t)))
      throw ConfigError(kDifferences[i]);
  }
}

}  // namespace robosim
