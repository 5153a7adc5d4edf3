#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// Bytes that another rank has sent.
struct RankMessage {
  int from = 0;
  std::string bytes;
};

/// The processes that mpirun or srun has started together, called ranks. This interface has no types of MPI; MPI
/// implements it in the library robosim-mpi, which is loaded only in processes that were started so. All functions are
/// called by one thread, and throw std::runtime_error naming the operation when the transport fails; by default the
/// launcher then ends all ranks. Bytes may have any size, also beyond 2 GiB.
class RankGroup {
 public:
  virtual ~RankGroup() = default;
  virtual int rank() const = 0;  ///< of this process, [0, size())
  virtual int size() const = 0;
  bool isFirst() const { return rank() == 0; }

  /// @name Collective operations
  /// Every rank calls the same operations in the same order; each returns when the caller's part is done.
  ///@{
  /// Replaces the bytes of all ranks by those of rank 0.
  virtual void broadcast(std::string& bytes) = 0;
  /// @param all at rank 0: the bytes of each rank; its memory is used again. Elsewhere unchanged
  virtual void gather(std::string_view own, std::vector<std::string>& all) = 0;
  /// @param all the bytes of each rank, at every rank; its memory is used again
  virtual void allGather(std::string_view own, std::vector<std::string>& all) = 0;
  /// @param to for each rank, the bytes for it @param from the bytes from each rank; its memory is used again
  virtual void exchange(const std::vector<std::string>& to, std::vector<std::string>& from) = 0;
  /// exchange() and allGather() in one: between processes, it takes longer than exchange() only if a rank has bytes for
  /// all.
  /// @param own bytes for all ranks @param all the bytes of each rank, at every rank; its memory is used again
  virtual void exchangeAndGather(const std::vector<std::string>& to, std::string_view own,
                                 std::vector<std::string>& from, std::vector<std::string>& all) {
    exchange(to, from);
    allGather(own, all);
  }
  virtual void barrier() = 0;
  ///@}

  /// @name Messages between two ranks
  /// In the order sent, for each sender.
  ///@{
  /// May return before the message is received; large messages wait for the receiver.
  virtual void send(int to, std::string_view bytes) = 0;
  /// The next message from any rank; nullopt when there is none within a time, for which it does not occupy the
  /// processor. @param wait_s [s]; 0: does not wait
  virtual std::optional<RankMessage> receive(double wait_s) = 0;
  ///@}

  /// Ends the processes of all ranks at once, after printing "robosim: rank N: REASON" to standard error.
  [[noreturn]] virtual void abort(int exit_code, const std::string& reason) = 0;
};

/// The ranks of this process. Without setRankGroup(): one rank, this process.
RankGroup& rankGroup();
/// Called once, at the start of the program. @param group must outlive all uses of rankGroup(); null: one rank
void setRankGroup(RankGroup* group);

}  // namespace robosim
