#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <pybind11/pybind11.h>

namespace robosim {

/// A text as a template's argument.
template <std::size_t kSize>
struct ArgumentText {
  char text[kSize];
  // NOLINTNEXTLINE(google-explicit-constructor): converts a literal
  consteval ArgumentText(const char (&of)[kSize]) { std::copy(of, of + kSize, text); }
};

/// A whole number as a function's argument. The errors for another type or a number out of range name the argument and
/// the range, which those of pybind11 do not.
/// @tparam kRange of the function, if that is narrower than of the type: in texts only
template <ArgumentText kName, typename Number, ArgumentText kRange = "">
struct WholeNumber {
  static_assert(std::is_integral_v<Number>);
  Number value{};
  // NOLINTNEXTLINE(google-explicit-constructor): is used as the number
  operator Number() const { return value; }
};

using Seed = WholeNumber<"the seed", std::uint64_t>;

}  // namespace robosim

namespace pybind11::detail {

template <robosim::ArgumentText kName, typename Number, robosim::ArgumentText kRange>
struct type_caster<robosim::WholeNumber<kName, Number, kRange>> {
  using Type = robosim::WholeNumber<kName, Number, kRange>;
  PYBIND11_TYPE_CASTER(Type, const_name("int"));

  /// @throws type_error, std::invalid_argument
  bool load(handle source, bool /*convert*/) {
    const std::string argument = kName.text;
    if (!PyIndex_Check(source.ptr()) || PyBool_Check(source.ptr())) {
      throw type_error(argument + " must be a whole number, not " +
                       str(type::handle_of(source).attr("__name__")).cast<std::string>() + "; it must be " + range() +
                       ", for example 1");
    }
    const auto number = reinterpret_steal<object>(PyNumber_Index(source.ptr()));
    if (!number) throw error_already_set();
    if constexpr (std::is_same_v<Number, std::uint64_t>) {
      value.value = PyLong_AsUnsignedLongLong(number.ptr());
      if (!PyErr_Occurred()) return true;
      PyErr_Clear();
      refuse(number);
    } else {
      using Limits = std::numeric_limits<Number>;
      int is_beyond = 0;
      const long long given = PyLong_AsLongLongAndOverflow(number.ptr(), &is_beyond);
      if (is_beyond || given < Limits::min() || given > Limits::max()) {
        refuse(number);
      }
      value.value = static_cast<Number>(given);
      return true;
    }
  }

 private:
  static std::string range() {
    using Limits = std::numeric_limits<Number>;
    if (kRange.text[0] != '\0') return kRange.text;
    if (std::is_same_v<Number, std::uint64_t>) return "0 to 2^64 - 1";
    return std::to_string(Limits::min()) + " to " + std::to_string(Limits::max());
  }
  [[noreturn]] static void refuse(const object& number) {
    throw std::invalid_argument(std::string(kName.text) + " is " + str(number).cast<std::string>() + "; it must be " +
                                range() + ", for example 1");
  }
};

}  // namespace pybind11::detail
