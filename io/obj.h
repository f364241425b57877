#pragma once
// Wavefront OBJ.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <ostream>
#include <string_view>
#include <vector>

namespace sightline {

namespace detail {

/// Reads OBJ line by line. Statements are `v` and `f` (or `fo`, its old name); what only dresses them is passed over;
/// anything else is an error, so that no surface is lost unseen.
class Obj_reader {
 public:
  Obj_reader(const Input& input, const Read_options& options)
      : text_(input, Text_reader::Comments::hash, Text_reader::Continuation::backslash), options_(options) {}

  Polygon_soup read();

 private:
  /// v x y z, then nothing, w, r g b, or w r g b. The weight w bends only curves and surfaces, so it may only be 1.
  void read_vertex();

  /// f, then any number of v, v/vt, v//vn, v/vt/vn.
  void read_face();

  Point_id read_corner(std::string_view token);

  /// Whether text is what may follow "v/": [vt] or [vt]/[vn]. The numbers themselves are of no interest.
  static bool is_attributes(std::string_view text);

  void check_ignored(std::string_view statement);

  [[noreturn]] void fail_out_of_range(std::string_view token);

  struct Forward {
    std::int64_t index;
    std::string_view token;
  };

  Text_reader text_;
  const Read_options& options_;
  Polygon_soup soup_;
  std::vector<Point_id> corners_;
  std::vector<Forward> forward_;
};

}  // namespace detail

/// Reads OBJ: `v` and `f`; texture coordinates, normals, groups, materials, lines and points are passed over.
/// Throws Input_error. Exact: yes. Cost: one pass.
inline Polygon_soup read_obj(const Input& input, const Read_options& options = {}) {
  return detail::Obj_reader(input, options).read();
}

/// Writes OBJ. Throws Not_representable where a coordinate is no finite decimal or a face has holes. Exact: yes.
void write_obj(const Polygon_soup& soup, std::ostream& out);

}  // namespace sightline
