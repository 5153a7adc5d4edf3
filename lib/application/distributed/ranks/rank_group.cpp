#include "distributed/ranks/rank_group.h"

#include <cstdlib>
#include <deque>
#include <iostream>

namespace robosim {
namespace {

/// A process that was started alone.
class SingleRank final : public RankGroup {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void broadcast(std::string&) override {}
  void gather(std::string_view own, std::vector<std::string>& all) override { allGather(own, all); }
  void allGather(std::string_view own, std::vector<std::string>& all) override {
    all.resize(1);
    all[0].assign(own);
  }
  void exchange(const std::vector<std::string>& to, std::vector<std::string>& from) override { from = to; }
  void barrier() override {}
  void send(int, std::string_view bytes) override { sent_.push_back({0, std::string(bytes)}); }
  std::optional<RankMessage> receive(double) override {
    if (sent_.empty()) return std::nullopt;
    RankMessage first = std::move(sent_.front());
    sent_.pop_front();
    return first;
  }
  [[noreturn]] void abort(int exit_code, const std::string& reason) override {
    std::cerr << "robosim: rank 0: " << reason << std::endl;
    std::_Exit(exit_code);
  }

 private:
  std::deque<RankMessage> sent_;
};

RankGroup& singleRank() {
  static SingleRank alone;
  return alone;
}

RankGroup* the_group = nullptr;

}  // namespace

RankGroup& rankGroup() { return the_group ? *the_group : singleRank(); }
void setRankGroup(RankGroup* group) { the_group = group; }

}  // namespace robosim
