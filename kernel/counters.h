#pragma once
// Structs of counters that list what they count: sums and reports are made from that list.

#include <algorithm>

namespace sightline {

/// Marks a counter of which the largest is kept, where others are added.
struct Largest {};

/// A struct with `each(visit)`, which calls visit(key, member), or visit(key, member, Largest{}), for each counter that
/// several runs have in common. `key`: its name in reports, "" where it is not reported. Members are numbers, or such
/// structs.
template <class Type>
concept Counters = requires {
  Type::each([](const char*, auto, auto...) {});
};

/// Adds the counters of another run. What is not listed stays.
template <Counters Type>
Type& operator+=(Type& sum, const Type& other) {
  Type::each([&](const char*, auto member, auto... kept) {
    if constexpr (sizeof...(kept) == 0) sum.*member += other.*member;
    else sum.*member = std::max(sum.*member, other.*member);
  });
  return sum;
}

}  // namespace sightline
