#pragma once
#include <functional>

namespace robosim {

/// A function without arguments, in the place of ARIA's ArFunctor. It is passed by value.
using Functor = std::function<void()>;

/// Calls a method of an object, in the place of ARIA's ArFunctorC. The object must outlive the functor.
template <typename Object, typename Method>
Functor makeFunctor(Object& object, Method method) {
  return [&object, method] { (object.*method)(); };
}

/// Place of a new entry in a list of callbacks.
struct ListPos {
  enum Pos { FIRST, LAST };
};

}  // namespace robosim
