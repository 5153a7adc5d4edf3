#include "distributed/ranks/testing/rank_group_checks.h"

namespace robosim {
namespace {

/// Text that one rank sends to another; some are empty, others long.
std::string textFrom(int from, int to) {
  const auto length = static_cast<std::size_t>((from * 7 + to * 13) % 5 == 0 ? 0 : 1 + (from + 3 * to) * 1000);
  std::string text(length, static_cast<char>('a' + (from * 5 + to) % 26));
  if (!text.empty()) text.back() = static_cast<char>('A' + from % 26);
  return text;
}

}  // namespace

std::string faultOf(RankGroup& group) {
  const int rank = group.rank(), size = group.size();
  std::string shared = rank == 0 ? textFrom(0, 1) : "to be replaced";
  group.broadcast(shared);
  if (shared != textFrom(0, 1)) return "broadcast";

  std::vector<std::string> all;
  for (int round = 0; round < 3; ++round) {
    group.allGather(textFrom(rank, round), all);
    if (all.size() != static_cast<std::size_t>(size)) return "number of ranks in allGather";
    for (int i = 0; i < size; ++i) {
      if (all[static_cast<std::size_t>(i)] != textFrom(i, round)) return "allGather from " + std::to_string(i);
    }
  }
  all.assign(1, "unchanged");
  group.gather(textFrom(rank, 4), all);
  if (rank > 0 && (all.size() != 1 || all[0] != "unchanged")) return "gather at another rank than 0";
  for (int i = 0; rank == 0 && i < size; ++i) {
    if (all.at(static_cast<std::size_t>(i)) != textFrom(i, 4)) return "gather from " + std::to_string(i);
  }

  std::vector<std::string> to, from;
  for (int i = 0; i < size; ++i) to.push_back(textFrom(rank, i));
  group.exchange(to, from);
  for (int i = 0; i < size; ++i) {
    if (from.at(static_cast<std::size_t>(i)) != textFrom(i, rank)) return "exchange from " + std::to_string(i);
  }

  for (int round = 0; round < 4; ++round) {
    const bool has_texts_for_all = round != 1;
    const auto for_all = [&](int i) { return has_texts_for_all ? textFrom(i, round) : std::string(); };
    group.exchangeAndGather(to, for_all(rank), from, all);
    for (int i = 0; i < size; ++i) {
      if (from.at(static_cast<std::size_t>(i)) != textFrom(i, rank))
        return "exchangeAndGather from " + std::to_string(i);
      if (all.at(static_cast<std::size_t>(i)) != for_all(i)) return "exchangeAndGather for all of " + std::to_string(i);
    }
  }

  // Two messages of each other rank, in the order sent, answered by one.
  group.barrier();
  constexpr double kLong_s = 60;
  if (rank != 0) {
    group.send(0, textFrom(rank, 0));
    group.send(0, "second of " + std::to_string(rank));
    const auto answer = group.receive(kLong_s);
    if (!answer || answer->from != 0 || answer->bytes != textFrom(0, rank)) return "receive of an answer";
  } else {
    std::vector<int> received(static_cast<std::size_t>(size));
    for (int i = 0; i < 2 * (size - 1); ++i) {
      const auto message = group.receive(kLong_s);
      if (!message) return "receive";
      const int number = received[static_cast<std::size_t>(message->from)]++;
      const auto expected = number == 0 ? textFrom(message->from, 0) : "second of " + std::to_string(message->from);
      if (message->bytes != expected) return "message from " + std::to_string(message->from);
      if (number == 1) group.send(message->from, textFrom(0, message->from));
    }
  }
  group.barrier();
  if (group.receive(0)) return "receive without a message";
  return {};
}

}  // namespace robosim
