#pragma once
#include <cstddef>
#include <optional>

namespace robosim {

/// Goes on as so many processes, made from this one, which end when it ends. They lie at the same addresses in memory,
/// unlike programs that are started one by one: so what the processor has learned from one of them, of where its
/// branches go, serves the others. Where many share a processor, that halves the time they take. Call before
/// anything starts a thread.
/// @return in each of them, its number; in this one nullopt, once all have come to a good end.
/// @throws std::runtime_error in this one, when some have not.
std::optional<std::size_t> goOnApart(std::size_t processes);

}  // namespace robosim
