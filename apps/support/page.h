#pragma once
// Pages to look at: a scene and what a command found in it, as one file that a browser opens from disk, without a
// network. What stands in the page's block of data: apps/page/README.md.

#include "common.h"

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sightline::app {

/// Numbers as a page holds them, in few bytes: {"type": "u8" | "u16" | "u32" | "f32", "base64": ...}, little-endian;
/// whole ones in the smallest type that holds them all.
Json packed(const std::vector<std::uint32_t>& numbers);
Json packed(const std::vector<float>& numbers);
/// Bits, the first the lowest of its byte: {"type": "u8", ...}.
Json packed(const std::vector<bool>& bits);

/// What stands at the end of a page of another kind, so that its scenes can be turned around: the text of pages, once,
/// and what puts data() of Page into it where a button with `data-view="N"` asks for the N-th of the array in the
/// element `views`.
std::string scenes_within();

/// What stands under `doubles` in a page: what `ask` makes of an exact answer in plain doubles, while a bar of its own
/// says how far it is. Once the limit, that of the exact answer, is over, what `ask` tells ends it, and the page says
/// so instead, as where it throws std::domain_error: the exact answer stands.
Json asked_of_doubles(const Time_limit& limit, const std::function<Json(const Report& report)>& ask);
/// The same where doubles are not asked: why, in words that go on "Not asked: ".
Json doubles_left_out(const std::string& why);

/// A page as it is put together. Its places are (x - middle) / size for the middle of the scene's box and a power of
/// two, so that scenes far away, and of any size, keep what a float can hold.
/// Post: a file of at most 1 MB and 40 bytes a triangle, and what the command adds. Of more than most_triangles it
/// shows the largest polygons, sources and groups that come first before others, and says so. Exact: in its texts; what
/// is drawn is rounded, to 2^-24 of the scene's size or, where that would take too many bytes, to 2^-16, and where
/// exact coordinates would, they are left out.
class Page {
 public:
  static constexpr std::size_t most_triangles = 400000;
  static constexpr std::uint32_t no_face = ~std::uint32_t{0};

  /// Of more triangles than these it shows the largest polygons.
  Page(const std::string& command, const Scene& scene, std::size_t triangles = most_triangles);

  /// A line of the page's table.
  void add_fact(const std::string& name, const std::string& value) { facts_.push_back({name, value}); }
  /// What is left out, rounded or thinned, in a sentence.
  void add_note(const std::string& note) { notes_.push_back(note); }
  /// What polygons may be, in the order of their numbers; `role` names the colour: seen, hidden, open, source, new,
  /// other, or one a face. Of too many polygons those of groups that come first stay before larger ones.
  void add_group(const std::string& name, const std::string& role, bool comes_first = false) {
    if (comes_first) first_groups_.insert(static_cast<std::uint32_t>(groups_.size()));
    groups_.push_back({name, role});
  }
  /// The next polygon: convex, counterclockwise as seen from its front. `face` may be no_face: then it may be anywhere,
  /// is clipped beyond 10^6 sizes of the scene, and drawn nearer where all of it is beyond.
  void add_polygon(std::uint32_t face, const std::vector<Exact_point>& corners, std::uint32_t group = 0);
  /// All pieces of a scene; the n-th polygon is its n-th piece.
  void add_pieces(const Scene& scene, const std::function<std::uint32_t(std::uint32_t piece)>& group_of = {});
  std::size_t polygons() const { return added_; }

  /// A point as three numbers of the page. Beyond 10^30 it is brought near, in its direction from the middle.
  Json place(const Exact_point& p) const;
  /// The same beside others, as floats, and beyond 10^6.
  void append_place(std::vector<float>& to, const Exact_point& p) const;
  /// The two ends of each side of a polygon.
  void append_sides(std::vector<float>& to, const std::vector<Exact_point>& polygon) const;
  /// "1/2, 3, 4".
  static std::string text(const Exact_point& p);
  /// Where one looks from: the page begins there.
  void set_eye(const Exact_point& eye);
  /// What the command has to say, by its own keys.
  Json& more() { return more_; }

  /// What stands in its block of data. Post: nothing is to be added.
  Json data();
  /// Writes it, whole or not at all. Errors: as write_file.
  void write(const std::string& file);

 private:
  struct Polygon {
    std::uint32_t number, face, group, first, size;  // number: among all that were added; first: in places_, exact_
    double area;
  };
  static constexpr double farthest_drawn = 1e6;  // sources and viewpoints may be out of all proportion

  /// A place of the page; beyond that of the same direction from the middle.
  std::array<double, 3> near_place(const Exact_point& p, double farthest) const;
  /// What of a convex polygon is in the cube of what is drawn.
  std::vector<Exact_point> clipped(std::vector<Exact_point> polygon) const;
  /// A polygon of the same shape and direction, as far away as that cube.
  std::vector<Exact_point> brought_near(std::vector<Exact_point> polygon) const;
  void add_polygon(std::uint32_t face, const std::vector<Exact_point>& corners, const std::vector<Exact_point>& drawn,
                   std::uint32_t group);
  void keep_the_largest(std::size_t triangles);
  Json polygons_json() const;

  std::string command_, scene_;
  std::size_t most_triangles_;
  Exact_point middle_;
  Rational size_ = 1;
  std::vector<std::array<std::string, 2>> facts_, groups_;
  std::vector<std::string> notes_;
  std::set<std::uint32_t> first_groups_;
  std::vector<Polygon> kept_;
  std::vector<float> places_;
  std::vector<std::uint32_t> exact_;  // the place of a corner's text, while texts are kept
  std::map<std::string, std::uint32_t> texts_;
  bool keeps_texts_ = true, is_clipped_ = false, is_brought_near_ = false;
  std::size_t text_bytes_ = 0, triangles_ = 0, added_ = 0;
  Json more_ = Json::object();
};

}  // namespace sightline::app
