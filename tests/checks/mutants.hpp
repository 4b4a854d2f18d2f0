// What mutants.py puts in front of each source: a mutant is on where the environment has its number in VIEWPROJ_MUTANT.
#pragma once

#include <type_traits>
#include <utility>

extern int viewprojMutant;
#define MUTATED(id) (!__builtin_is_constant_evaluated() && ::viewprojMutant == (id))

namespace mutants {

// `a + Plus<7>{} + b` is a + b, and a - b where mutant 7 is on: of the same precedence, whatever a and b are made of.
// Where a - b is nothing, or of another type, it does not compile, and there is no such mutant.
#define MUTANT_OPERATOR(name, op, other)                                                              \
  template <int id>                                                                                   \
  struct name {};                                                                                     \
  template <class A, int id>                                                                          \
  struct name##Left {                                                                                 \
    A&& a;                                                                                            \
  };                                                                                                  \
  template <class A, int id>                                                                          \
  constexpr name##Left<A, id> operator op(A&& a, name<id>) {                                          \
    return {std::forward<A>(a)};                                                                      \
  }                                                                                                   \
  template <class A, int id, class B>                                                                 \
  requires requires(A & a, B & b) { requires std::is_same_v<decltype(a op b), decltype(a other b)>; } \
  constexpr auto operator op(name##Left<A, id> left, B&& b) {                                         \
    if (MUTATED(id)) return left.a other b;                                                           \
    return left.a op b;                                                                               \
  }
MUTANT_OPERATOR(Plus, +, -)
MUTANT_OPERATOR(Minus, -, +)
MUTANT_OPERATOR(Times, *, /)
MUTANT_OPERATOR(Over, /, *)
MUTANT_OPERATOR(Less, <, <=)
MUTANT_OPERATOR(Greater, >, >=)
MUTANT_OPERATOR(LessOrSame, <=, <)
MUTANT_OPERATOR(GreaterOrSame, >=, >)
MUTANT_OPERATOR(Same, ==, !=)
MUTANT_OPERATOR(Other, !=, ==)

/// f(a, b), or f(b, a). Where that is no call, it does not compile, and there is no such mutant.
template <int id, class F, class A, class B>
requires std::is_same_v<std::invoke_result_t<F, A, B>, std::invoke_result_t<F, B, A>>
constexpr decltype(auto) swapped(F&& f, A&& a, B&& b) {
  if (MUTATED(id)) return f(std::forward<B>(b), std::forward<A>(a));
  return f(std::forward<A>(a), std::forward<B>(b));
}

}  // namespace mutants
