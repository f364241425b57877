#pragma once
// Handles of oriented planes.

#include <cstdint>

namespace sightline {

/// An oriented plane of a scene by name: which plane, and which of its sides is called the front.
/// Two handles with one `id` are the same plane in space; the converse holds for the planes of a Plane_table (they are
/// interned), and an axis plane has a table's id wherever the table holds it.
class Plane {
 public:
  constexpr Plane() = default;
  constexpr Plane(std::uint32_t id, bool flipped) : code_(id << 1 | static_cast<std::uint32_t>(flipped)) {}
  /// The plane through input point `point` across coordinate axis `axis` (0, 1, 2), its front where that coordinate is
  /// larger. It needs no place in a table, so it can be made in any thread. Pre: point < 2^28.
  static constexpr Plane across(int axis, std::uint32_t point) {
    return {axis_bit | static_cast<std::uint32_t>(axis) << 28 | point, false};
  }

  constexpr std::uint32_t id() const { return code_ >> 1; }
  constexpr bool flipped() const { return (code_ & 1) != 0; }
  constexpr Plane opposite() const { return {id(), !flipped()}; }
  constexpr bool is_axis_plane() const { return (id() & axis_bit) != 0; }
  constexpr int axis() const { return static_cast<int>(id() >> 28 & 3); }
  constexpr std::uint32_t axis_point() const { return id() & (max_axis_point - 1); }
  constexpr bool valid() const { return code_ != none; }

  friend constexpr bool operator==(Plane, Plane) = default;

  static constexpr std::uint32_t max_axis_point = std::uint32_t{1} << 28;
  static constexpr std::uint32_t max_table_planes = std::uint32_t{1} << 30;

 private:
  static constexpr std::uint32_t axis_bit = std::uint32_t{1} << 30;
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint32_t code_ = none;
};

}  // namespace sightline
