#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "hardware/measurement.h"

/// @file
/// Functions on any kind of measurement, derived from its Description. The pattern of one description per type that
/// every encoding visits is that of Drake's `Serialize(Archive*)`.
namespace robosim {

/// The records of a kind of measurement, and how many numbers each has.
template <typename M>
using RecordOf = std::remove_cvref_t<decltype(Description<M>::records(std::declval<M&>())[0])>;
template <typename M>
inline constexpr std::size_t kFieldCount = std::tuple_size_v<std::remove_cvref_t<decltype(Description<M>::fields)>>;

template <typename M>
inline constexpr bool kIsFile = requires(M m) {
  Description<M>::file(m);
};
template <typename M>
inline constexpr bool kIsReproducible = !requires {
  Description<M>::is_reproducible;
};
/// Whether a measurement is one record, without a list of records.
template <typename M>
inline constexpr bool kIsSingle = Description<M>::record_name[0] == '\0';

/// Calls visit(field, number, index of the record) for each number of a measurement, record by record.
template <typename M, typename Visit>
void forNumbers(M& measurement, const Visit& visit) {
  std::size_t index = 0;
  for (auto& record : Description<std::remove_const_t<M>>::records(measurement)) {
    std::apply([&](const auto&... field) { (visit(field, field.get(record), index), ...); },
               Description<std::remove_const_t<M>>::fields);
    ++index;
  }
}

/// Type of a field's number.
template <typename M, typename Get>
using NumberOf = std::remove_cvref_t<std::invoke_result_t<Get, RecordOf<M>&>>;

/// Whether all numbers of a kind of measurement have the type T.
template <typename M, typename T>
inline constexpr bool kConsistsOf =
    kFieldCount<M> != 0 &&
    std::apply([]<typename... Get>(const Field<Get>&...) { return (std::is_same_v<NumberOf<M, Get>, T> && ...); },
               Description<M>::fields);

/// Whether a record consists of nothing but its numbers, so that its bytes may be hashed.
template <typename M>
inline constexpr bool kIsDense = std::apply(
    []<typename... Get>(const Field<Get>&...) { return (sizeof(NumberOf<M, Get>) + ... + 0) == sizeof(RecordOf<M>); },
    Description<M>::fields);

/// Whether the sensor measured something in this step.
template <typename M>
bool isPresent(const M& measurement) {
  if constexpr (requires { Description<M>::isPresent(measurement); }) {
    return Description<M>::isPresent(measurement);
  } else {
    return true;
  }
}

/// Whether a sensor measures nothing in some steps.
inline bool isIntermittent(const SensorInfo& sensor) {
  return std::visit([](const auto& blank) { return !isPresent(blank); }, blankMeasurement(sensor));
}

/// Whether a number is finite and within its field's bounds.
template <typename Get, typename Number>
bool isPermitted(const Field<Get>& field, Number value) {
  if (field.max == std::numeric_limits<double>::max()) return std::isfinite(value);
  return static_cast<double>(value) >= field.min && static_cast<double>(value) <= field.max;
}

/// Why a number is not permitted: "a pressed of 2; it must lie in [0, 1]".
std::string faultOf(const char* name, const Unit& unit, double min, double max, double value);

/// Why the numbers of a measurement are impossible; empty for valid ones.
/// @param numbers as many as the measurement has
template <typename M, typename Number>
std::string faultOf(M& measurement, std::span<const Number> numbers) {
  std::string fault;
  auto next = numbers.begin();
  forNumbers(measurement, [&](const auto& field, const auto&, std::size_t index) {
    const Number value = *next++;
    if (!fault.empty() || isPermitted(field, value)) return;
    fault = kIsSingle<M> ? "" : Description<M>::record_name + (' ' + std::to_string(index)) + ": ";
    fault += faultOf(field.name, field.unit, field.min, field.max, static_cast<double>(value));
  });
  return fault;
}

/// Replaces the numbers of a measurement, of the sensor's kind and size, and marks it as present.
/// @param numbers as many as the measurement has
/// @returns why the numbers are impossible; empty for valid ones
template <typename M, typename Number>
std::string setNumbers(M& measurement, std::span<const Number> numbers) {
  using D = Description<M>;
  bool are_permitted = true;
  const Number* next = numbers.data();
  forNumbers(measurement, [&](const auto& field, auto& number, std::size_t) {
    using Target = std::remove_reference_t<decltype(number)>;
    const Number value = *next++;
    const bool is_permitted = isPermitted(field, value);
    are_permitted &= is_permitted;
    // An integer cannot hold every number that is not permitted.
    number = std::is_integral_v<Target> && !is_permitted ? Target{} : static_cast<Target>(value);
  });
  if (!are_permitted) return faultOf(measurement, numbers);
  if constexpr (requires { D::faultOf(*D::records(measurement).begin()); }) {
    for (const auto& record : D::records(measurement)) {
      if (const char* why = D::faultOf(record)) return why;
    }
  }
  if constexpr (requires { D::isPresent(measurement) = true; }) D::isPresent(measurement) = true;
  return "";
}

}  // namespace robosim
