#include "distributed/mpi/mpi_ranks.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include <mpi.h>

#include "base/seconds.h"

namespace robosim {
namespace {

constexpr int kSizeTag = 1;      ///< sizes of messages between two ranks
constexpr int kPieceTag = 2;     ///< their bytes
constexpr int kExchangeTag = 3;  ///< bytes of gather() and exchange()

void check(int result, const char* operation) {
  if (result == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  MPI_Error_string(result, text, &length);
  throw std::runtime_error(std::string(operation) +
                           " between the ranks failed: " + std::string(text, static_cast<std::size_t>(length)));
}

class MpiRanks final : public RankGroup {
 public:
  explicit MpiRanks(std::size_t piece_bytes) : piece_bytes_(piece_bytes) {
    int provided = 0;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
    if (provided < MPI_THREAD_FUNNELED) throw std::runtime_error("this MPI does not permit threads; use another one");
    // A failed operation throws here; by default MPI would end the process without an error of RoboSim.
    check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void broadcast(std::string& bytes) override {
    std::uint64_t size = bytes.size();
    check(MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD), "broadcast");
    bytes.resize(size);
    broadcastPieces(bytes, 0);
  }

  void gather(std::string_view own, std::vector<std::string>& all) override {
    const std::uint64_t size = own.size();
    sizes_.resize(static_cast<std::size_t>(size_));
    check(MPI_Gather(&size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, 0, MPI_COMM_WORLD), "gather");
    if (rank_ != 0) {
      startSending(own, 0);
    } else {
      all.resize(sizes_.size());
      all[0].assign(own);
      for (int from = 1; from < size_; ++from) startReceiving(all[at(from)], sizes_[at(from)], from);
    }
    finish("gather");
  }

  void allGather(std::string_view own, std::vector<std::string>& all) override {
    const std::uint64_t size = own.size();
    sizes_.resize(static_cast<std::size_t>(size_));
    check(MPI_Allgather(&size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD), "allgather");
    gatherSized(own, all);
  }

  void exchange(const std::vector<std::string>& to, std::vector<std::string>& from) override {
    std::vector<std::uint64_t> to_sizes(static_cast<std::size_t>(size_));
    for (std::size_t i = 0; i < to_sizes.size(); ++i) to_sizes[i] = to[i].size();
    sizes_.resize(to_sizes.size());
    check(MPI_Alltoall(to_sizes.data(), 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD), "exchange");
    startExchange(to, from);
    finish("exchange");
  }

  void exchangeAndGather(const std::vector<std::string>& to, std::string_view own, std::vector<std::string>& from,
                         std::vector<std::string>& all) override {
    using SizePair = std::array<std::uint64_t, 2>;  // of the bytes for one rank, and of those for all
    std::vector<SizePair> to_sizes(static_cast<std::size_t>(size_)), from_sizes(to_sizes.size());
    for (std::size_t i = 0; i < to_sizes.size(); ++i) to_sizes[i] = {to[i].size(), own.size()};
    check(MPI_Alltoall(to_sizes.data(), 2, MPI_UINT64_T, from_sizes.data(), 2, MPI_UINT64_T, MPI_COMM_WORLD),
          "exchange");
    const auto take = [&](std::size_t which) {
      sizes_.clear();
      for (const SizePair& sizes : from_sizes) sizes_.push_back(sizes[which]);
    };
    take(0);
    startExchange(to, from);
    take(1);
    gatherSized(own, all);
    finish("exchange");
  }

  void barrier() override { check(MPI_Barrier(MPI_COMM_WORLD), "barrier"); }

  void send(int to, std::string_view bytes) override {
    const std::uint64_t size = bytes.size();
    check(MPI_Send(&size, 1, MPI_UINT64_T, to, kSizeTag, MPI_COMM_WORLD), "send");
    forPieces(bytes.size(), [&](std::size_t begin, int count) {
      check(MPI_Send(bytes.data() + begin, count, MPI_BYTE, to, kPieceTag, MPI_COMM_WORLD), "send");
    });
  }

  std::optional<RankMessage> receive(double wait_s) override {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + Seconds(wait_s);
    std::chrono::microseconds nap(20);
    int is_there = 0;
    MPI_Status status;
    for (;;) {
      check(MPI_Iprobe(MPI_ANY_SOURCE, kSizeTag, MPI_COMM_WORLD, &is_there, &status), "receive");
      if (is_there) break;
      if (Clock::now() >= end) return std::nullopt;
      std::this_thread::sleep_for(nap);
      nap = std::min(2 * nap, std::chrono::microseconds(1000));
    }
    RankMessage message{status.MPI_SOURCE, {}};
    std::uint64_t size = 0;
    check(MPI_Recv(&size, 1, MPI_UINT64_T, message.from, kSizeTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE), "receive");
    message.bytes.resize(size);
    forPieces(size, [&](std::size_t begin, int count) {
      check(MPI_Recv(message.bytes.data() + begin, count, MPI_BYTE, message.from, kPieceTag, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE),
            "receive");
    });
    return message;
  }

  [[noreturn]] void abort(int exit_code, const std::string& reason) override {
    std::fprintf(stderr, "robosim: rank %d: %s\n", rank_, reason.c_str());
    std::fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  static std::size_t at(int rank) { return static_cast<std::size_t>(rank); }

  template <typename Function>
  void forPieces(std::size_t size, const Function& function) const {
    for (std::size_t begin = 0; begin < size; begin += piece_bytes_)
      function(begin, static_cast<int>(std::min(piece_bytes_, size - begin)));
  }

  void broadcastPieces(std::string& bytes, int from) {
    forPieces(bytes.size(), [&](std::size_t begin, int count) {
      check(MPI_Bcast(bytes.data() + begin, count, MPI_BYTE, from, MPI_COMM_WORLD), "broadcast");
    });
  }

  /// Sends to all others, and receives, what sizes_ has the sizes of; until finish().
  void startExchange(const std::vector<std::string>& to, std::vector<std::string>& from) {
    from.resize(sizes_.size());
    from[at(rank_)] = to[at(rank_)];
    for (int other = 0; other < size_; ++other) {
      if (other == rank_) continue;
      startReceiving(from[at(other)], sizes_[at(other)], other);
      startSending(to[at(other)], other);
    }
  }

  /// allGather() of bytes whose sizes are in sizes_.
  void gatherSized(std::string_view own, std::vector<std::string>& all) {
    all.resize(sizes_.size());
    const auto total = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
    if (total <= piece_bytes_) {
      allGatherAtOnce(own, total, all);
      return;
    }
    for (int from = 0; from < size_; ++from) {
      std::string& bytes = all[at(from)];
      if (from == rank_) {
        bytes.assign(own);
      } else {
        bytes.resize(sizes_[at(from)]);
      }
      broadcastPieces(bytes, from);
    }
  }

  void allGatherAtOnce(std::string_view own, std::uint64_t total, std::vector<std::string>& all) {
    counts_.assign(sizes_.begin(), sizes_.end());
    begins_.resize(counts_.size());
    std::exclusive_scan(counts_.begin(), counts_.end(), begins_.begin(), 0);
    joined_.resize(total);
    if (total == 0) {
      for (auto& bytes : all) bytes.clear();
      return;
    }
    check(MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_BYTE, joined_.data(), counts_.data(),
                         begins_.data(), MPI_BYTE, MPI_COMM_WORLD),
          "allgather");
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].assign(joined_, static_cast<std::size_t>(begins_[i]), static_cast<std::size_t>(counts_[i]));
  }

  void startSending(std::string_view bytes, int to) {
    forPieces(bytes.size(), [&](std::size_t begin, int count) {
      check(
          MPI_Isend(bytes.data() + begin, count, MPI_BYTE, to, kExchangeTag, MPI_COMM_WORLD, &requests_.emplace_back()),
          "send");
    });
  }
  void startReceiving(std::string& bytes, std::size_t size, int from) {
    bytes.resize(size);
    forPieces(size, [&](std::size_t begin, int count) {
      check(MPI_Irecv(bytes.data() + begin, count, MPI_BYTE, from, kExchangeTag, MPI_COMM_WORLD,
                      &requests_.emplace_back()),
            "receive");
    });
  }
  void finish(const char* operation) {
    check(MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE), operation);
    requests_.clear();
  }

  std::size_t piece_bytes_;
  int rank_ = 0, size_ = 1;
  std::vector<std::uint64_t> sizes_;
  std::vector<int> counts_, begins_;  ///< of allGatherAtOnce()
  std::string joined_;
  std::vector<MPI_Request> requests_;
};

}  // namespace

std::unique_ptr<RankGroup> connectMpiRanks(std::size_t piece_bytes) { return std::make_unique<MpiRanks>(piece_bytes); }

}  // namespace robosim

robosim::RankGroup* robosimConnectMpiRanks() { return robosim::connectMpiRanks().release(); }
