#include "distributed/ranks/testing/thread_ranks.h"

#include <chrono>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/seconds.h"

namespace robosim {
namespace {

/// What the ranks share.
struct Shared {
  explicit Shared(int ranks) : barrier(ranks), posted(static_cast<std::size_t>(ranks)), mailboxes(posted.size()) {}

  std::barrier<> barrier;
  std::vector<const std::vector<std::string>*> posted;  ///< by rank, between two barriers
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<std::deque<RankMessage>> mailboxes;
};

class ThreadRank final : public RankGroup {
 public:
  ThreadRank(Shared& shared, int rank) : shared_(shared), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(shared_.posted.size()); }

  void broadcast(std::string& bytes) override {
    std::vector<std::string> all;
    allGather(bytes, all);
    bytes = all[0];
  }
  void gather(std::string_view own, std::vector<std::string>& all) override {
    std::vector<std::string> gathered;
    allGather(own, gathered);
    if (rank_ == 0) all = std::move(gathered);
  }
  void allGather(std::string_view own, std::vector<std::string>& all) override {
    exchange(std::vector<std::string>(shared_.posted.size(), std::string(own)), all);
  }
  void exchange(const std::vector<std::string>& to, std::vector<std::string>& from) override {
    shared_.posted[own()] = &to;
    barrier();
    from.resize(shared_.posted.size());
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = (*shared_.posted[i])[own()];
    barrier();
  }
  void barrier() override { shared_.barrier.arrive_and_wait(); }

  void send(int to, std::string_view bytes) override {
    const std::lock_guard lock(shared_.mutex);
    shared_.mailboxes[static_cast<std::size_t>(to)].push_back({rank_, std::string(bytes)});
    shared_.arrived.notify_all();
  }
  std::optional<RankMessage> receive(double wait_s) override {
    std::unique_lock lock(shared_.mutex);
    auto& mailbox = shared_.mailboxes[own()];
    const auto has_mail = [&] { return !mailbox.empty(); };
    if (!shared_.arrived.wait_for(lock, Seconds(wait_s), has_mail)) return std::nullopt;
    RankMessage first = std::move(mailbox.front());
    mailbox.pop_front();
    return first;
  }
  [[noreturn]] void abort(int, const std::string& reason) override { throw std::logic_error("abort: " + reason); }

 private:
  std::size_t own() const { return static_cast<std::size_t>(rank_); }

  Shared& shared_;
  int rank_;
};

}  // namespace

void runThreadRanks(int ranks, const std::function<void(RankGroup& group)>& function) {
  Shared shared(ranks);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(ranks));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank) {
    threads.emplace_back([&, rank] {
      try {
        ThreadRank group(shared, rank);
        function(group);
      } catch (...) {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
        shared.barrier.arrive_and_drop();
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace robosim
