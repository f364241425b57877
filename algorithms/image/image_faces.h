#pragma once
// The faces that an eye sees, in the numbers of a kernel: as cones of directions, and by how near they are at pixel
// centres. What all methods that ask at centres decide by.

#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <tuple>
#include <vector>

namespace sightline::image_detail {

/// 1 / t of a face at a centre, up to `bound`.
struct Nearness {
  static constexpr std::uint32_t nothing = Piece_image::nothing;

  double value = 0, bound = 0;
  std::uint32_t face = nothing;
};

/// The pieces in whose plane the eye is not, numbered as their cones are. In floats and doubles those are left out that
/// the numbers cannot hold, or flatten; their planes are rounded, and from there all is in doubles, in which equal is
/// equal. Exact: as the kernel is.
class Image_faces {
 public:
  /// Pre: they outlive the faces, and view.eye() is pixels.eye. Errors: as centres(). Parallel.
  Image_faces(const Exact_view& view, const Pixel_view& pixels, const Image_options& options);
  Image_faces(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel, const Image_options& options);
  Image_faces(Exact_view&&, const Pixel_view&, const Image_options&) = delete;
  Image_faces(Scene&&, const Pixel_view&, Image_kernel, const Image_options&) = delete;
  Image_faces(const Image_faces&) = delete;
  Image_faces& operator=(const Image_faces&) = delete;

  std::size_t size() const { return faces_.size(); }
  const Pixel_centres& centres() const { return centres_; }
  const Pixel_cones& cones() const { return cones_; }
  std::uint32_t piece(std::uint32_t face) const { return faces_[face].piece; }
  const Pixel_form& nearness(std::uint32_t face) const { return faces_[face].nearness; }
  /// What is drawn, and what is not.
  Image_counters counters() const;
  /// An image that shows nothing yet.
  Piece_image empty_image() const;

  Nearness nearness(std::uint32_t face, std::int64_t x, std::int64_t y) const {
    const Pixel_form& form = faces_[face].nearness;
    return {form.a * centres_.across(x) + form.at_row(centres_.upwards(y)), form.bound, face};
  }
  /// 1 where the plane of the first is nearer at a centre than that of the other, 0 where both are met at once.
  int nearer(const Nearness& a, const Nearness& b, std::int64_t x, std::int64_t y, Image_counters& counters) const {
    const double more = a.value - b.value, bound = a.bound + b.bound;
    if (more > bound) return 1;
    if (more < -bound) return -1;
    return exact_nearer(a.face, b.face, x, y, counters);
  }
  /// The same by integers alone.
  int exact_nearer(std::uint32_t a, std::uint32_t b, std::int64_t x, std::int64_t y, Image_counters& counters) const;
  /// Of faces met at once the one seen from its front, then by face id, then by number.
  bool before(std::uint32_t a, std::uint32_t b) const { return faces_[a].rank < faces_[b].rank; }

  /// Which of several faces, all of which are there, is first at a centre.
  template <class Items, class Face_of = std::identity>
  Nearness first_of(const Items& among, std::int64_t x, std::int64_t y, Image_counters& counters,
                    Face_of face_of = {}) const {
    Nearness first;
    for (const auto& item : among) {
      const std::uint32_t face = std::invoke(face_of, item);
      const Nearness here = nearness(face, x, y);
      const int sign = first.face == Nearness::nothing ? 1 : nearer(here, first, x, y, counters);
      if (sign > 0 || (sign == 0 && before(face, first.face))) first = here;
    }
    counters.centres += among.size();
    return first;
  }

 private:
  struct Face {
    std::uint32_t piece;
    Pixel_form nearness;
    std::tuple<bool, Face_id, std::uint32_t> rank;
  };
  /// The normal of the plane in front of which face a is nearer than face b; zero where they are in one plane.
  using Exact_crossing = std::function<std::array<Integer, 3>(std::uint32_t a, std::uint32_t b)>;

  void add_all(const Exact_view& view, const Image_options& options);
  template <class Number>
  void add_all_in(const Image_options& options);
  void add_face(std::uint32_t piece, const Pixel_form& nearness, bool from_behind);

  const Scene& scene_;
  std::unique_ptr<const Exact_view> own_;
  Pixel_centres centres_;
  std::vector<Face> faces_;
  Pixel_cones cones_;
  Exact_crossing exact_crossing_;
};

}  // namespace sightline::image_detail
