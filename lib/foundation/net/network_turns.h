#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace robosim {

/// Order in which waiting connections have their turn: their networks (PeerAddress::network()) one after the other, so
/// that a network with many delays only its own; of a network the newest, which is the least likely to have been given
/// up.
class NetworkTurns {
 public:
  using Number = std::uint64_t;  ///< in the order of acceptance

  void add(Number number, const std::string& network) {
    networks_[network].insert(number);
    network_of_[number] = network;
  }
  /// No effect for a connection that does not wait.
  void remove(Number number) {
    const auto found = network_of_.find(number);
    if (found == network_of_.end()) return;
    const auto network = networks_.find(found->second);
    network->second.erase(number);
    if (network->second.empty()) networks_.erase(network);
    network_of_.erase(found);
  }
  bool isEmpty() const { return network_of_.empty(); }
  /// Removes the next one. @return nullopt for none
  std::optional<Number> next() {
    if (networks_.empty()) return std::nullopt;
    auto network = networks_.upper_bound(last_);
    if (network == networks_.end()) network = networks_.begin();
    last_ = network->first;
    const Number number = *network->second.rbegin();
    remove(number);
    return number;
  }

 private:
  std::map<std::string, std::set<Number>> networks_;  ///< none is empty
  std::map<Number, std::string> network_of_;
  std::string last_;  ///< that has had its turn
};

}  // namespace robosim
