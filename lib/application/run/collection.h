#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "run/observer.h"

namespace robosim {

struct CollectionOptions {
  double x_m = 0, y_m = 0;  ///< centre of the nest, world frame
  double radius_m = 1.2;    ///< of the nest
  double end_percent = 0;   ///< ends the run when so many objects are in the nest; 0: never
};

/// How many movable objects are in a nest, a disc on the floor: those whose centres are in it.
class Collection : public Observer {
 public:
  explicit Collection(const CollectionOptions& options) : options_(options) {}

  void observe(const Environment& environment) override;
  std::string endReason() const override;
  /// collected, collected_percent; half_collected_s, all_collected_s: when so many were in the nest for the first time.
  std::vector<Metric> metrics() const override;
  std::unique_ptr<Observer> clone(const ObserverSetup&) const override { return std::make_unique<Collection>(*this); }

 private:
  double percent() const;

  CollectionOptions options_;
  std::size_t objects_ = 0, collected_ = 0;
  std::optional<double> half_s_, all_s_;
};

ObserverType collectionType();

}  // namespace robosim
