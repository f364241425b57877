#pragma once
// What was found of a scene, as polygons in groups, for programs that draw: glTF, VTK, PLY and OBJ.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace sightline {

/// Convex polygons, counterclockwise as seen from their fronts, each of a face, or of none, and in a group. Corners are
/// rounded to doubles; those that are then the same are one point.
class Grouped_polygons {
 public:
  static constexpr Face_id no_face = ~Face_id{0};
  using Point = std::array<double, 3>;
  struct Group {
    std::string name;
    std::array<std::uint8_t, 3> colour;  ///< red, green, blue, as on a screen
  };
  struct Polygon {
    std::uint32_t group;
    Face_id face;
    std::size_t end;  ///< of its corners; they begin where those of the polygon before end
  };
  /// A whole number for each polygon, beside its face and group.
  struct Column {
    std::string name;
    std::vector<std::uint32_t> values;
  };

  std::uint32_t add_group(std::string name, std::array<std::uint8_t, 3> colour);
  /// Pre: the group was added. Errors: std::overflow_error where a coordinate is too large for a double.
  void add_polygon(std::uint32_t group, Face_id face, const std::vector<Exact_point>& corners);
  /// Pre: when it is written, it has a value for each polygon.
  void add_column(std::string name, std::vector<std::uint32_t> values);

  const std::vector<Group>& groups() const { return groups_; }
  const std::vector<Polygon>& polygons() const { return polygons_; }
  const std::vector<std::uint32_t>& corners() const { return corners_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Column>& columns() const { return columns_; }

 private:
  struct Hash {
    std::size_t operator()(const Point& p) const;
  };
  std::vector<Group> groups_;
  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> corners_;  // of all polygons
  std::vector<Point> points_;
  std::vector<Column> columns_;
  std::unordered_map<Point, std::uint32_t, Hash> known_;
};

/// obj: groups and materials, no faces' ids. ply: binary; of each face its id, group (named in comments), columns and
/// colour. vtp, vtu: cell data of these names, groups named in comments. glb: a primitive with a material for
/// each group; ids as the attribute _FACE, columns likewise, floats as the format wants it: whole to 2^24; positions as
/// floats about the middle, which stands in the node, so that a scene far away keeps its shape.
enum class Drawing_format { obj, ply, glb, vtp, vtu };

inline constexpr const char* drawing_formats = ".glb .vtp .vtu .ply .obj";
/// The format that a file name's ending names, upper or lower case; nothing for any other ending.
std::optional<Drawing_format> drawing_format_of_ending(const std::filesystem::path& path);

/// The bytes of a file. Cost: linear. Exact: no, rounded as above.
std::string drawing_bytes(const Grouped_polygons& polygons, Drawing_format format);

}  // namespace sightline
