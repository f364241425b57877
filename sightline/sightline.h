#pragma once
// The front door: a scene in, visibility out. Exact, with certificates, and without a template argument: ids of faces
// and exact points in the file's coordinates. What stands behind it is in kernel/, algorithms/ and io/.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/time_limit.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {

class Scene;

/// How a question is asked. The answer is the same at any number of threads.
struct Asking {
  using Progress = std::function<void(std::size_t done, std::size_t all)>;
  int threads = 0;    ///< 0: as many as there are processors
  Progress progress;  ///< any thread may call it; what it throws ends the question, and comes out of it. A step may
                      ///< count from 0 again; one that waits for another question's is at 0 of 1
  double budget = 0;  ///< seconds; 0: none. What weak visibility has not decided then is undecided; other questions
                      ///< throw Out_of_budget
  bool two_sided = false;  ///< of weak visibility, and along a path: faces seen from behind count too
};

/// Whether the seconds of a question are over, from now on; empty where it has no budget.
std::function<bool()> end_of_budget(const Asking& asking);
/// The question's progress, which ends it by Out_of_budget once its seconds are over, from now on.
Asking::Progress progress_within_budget(const Asking& asking);

/// A face that is not modelled, and why.
struct Left_out {
  Face_id face;
  std::string why;
};

/// A convex part of a face, counterclockwise as seen from the face's front.
struct Part {
  Face_id face;
  std::uint32_t piece;  ///< of the face, 0 for a convex one
  std::vector<Exact_point> corners;

  double area() const;  ///< to about 2^-50
  /// In steradians, of 4 pi; to about 10^-13 of itself, as far as doubles hold it. 0 for an eye in its plane.
  double solid_angle(const Exact_point& eye) const;
};

/// What a scene is made of, and the arithmetic that it takes.
struct Facts {
  std::size_t points_read, points, faces_read, faces, parts;  ///< different points; faces that are modelled
  std::size_t concave, non_planar, with_holes, planes;        ///< supporting planes
  int bits;                                       ///< of the largest coordinate in steps of the scene's grid, from 0
  std::string arithmetic;                         ///< the narrowest exact one that fits
  bool closed;                                    ///< whether the faces close up, as those of solids do; true of none
  std::optional<std::array<Exact_point, 2>> box;  ///< of the points of faces; none: there are none
};

/// A scene made ready, once, for all questions. Copies share it; it never changes, so any threads may ask it, and what
/// it answered keeps it alive. Face ids are places in the input. Exact: yes. Cost: O(n), 1 us a triangle; what a kind
/// of question needs besides (a tree, boxes) is made when it is first asked.
class Model {
 public:
  /// Errors: std::length_error for more than 2^28 points.
  explicit Model(Polygon_soup soup);
  /// Any file that the program reads: its content shows which format it has. Errors: Input_error (io/input.h), a
  /// std::runtime_error that names file, line and column.
  static Model read(const std::filesystem::path& file);
  /// Errors: std::out_of_range for an index that is no point's, std::domain_error for a coordinate that is no number.
  static Model of_triangles(std::span<const std::array<double, 3>> points,
                            std::span<const std::array<std::uint32_t, 3>> triangles);
  /// Polygons of sizes[k] corners each, one after the other. Errors: as of_triangles(); std::invalid_argument where the
  /// sizes do not add up to the corners.
  static Model of_polygons(std::span<const std::array<double, 3>> points, std::span<const std::uint32_t> corners,
                           std::span<const std::uint32_t> sizes);

  std::size_t face_count() const;  ///< of the input
  const std::vector<Left_out>& left_out() const&;
  const std::vector<Part>& parts() const&;  ///< what is modelled: each kept face in convex parts, in order
  /// Of all parts of a face; 0 for one that was left out. Errors: std::out_of_range where there is no such face.
  double area(Face_id face) const;
  const Polygon_soup& soup() const&;
  const Scene& scene()
      const&;           ///< for questions that this header does not ask; as long as a copy of the model is there
  Facts facts() const;  ///< Cost: O(edges), once

  // Of a temporary model none of them, which would refer to what is gone: give it a name.
  void left_out() const&& = delete;
  void parts() const&& = delete;
  void soup() const&& = delete;
  void scene() const&& = delete;

  struct Inside;
  std::shared_ptr<const Inside> inside() const;          ///< for what is behind the door
  explicit Model(std::shared_ptr<const Inside> inside);  ///< the same; its scene is made when it is first asked for

 private:
  std::shared_ptr<const Inside> inside_;
};

/// What every answer can show for itself. It keeps what it needs of the model.
class Answer {
 public:
  using Certify = std::function<std::string(const Asking::Progress&)>;
  Answer() = default;
  explicit Answer(Certify certify) : certify_(std::move(certify)) {}

  /// What verify() and `sightline verify` take, as text. Made when asked for; any thread calls `progress` now and then,
  /// and what that throws ends it: progress_within_budget() has a budget, too. Errors: std::logic_error where no
  /// question made the answer. Cost: its length, where the question does not say more.
  std::string certificate(const Asking::Progress& progress = {}) const;

 private:
  Certify certify_;
};

/// An exact back-to-front order of all faces; where faces cross or hide each other in turn they are cut.
struct Visibility_order : Answer {
  Exact_point eye;
  std::vector<Part> parts;  ///< farthest first: none hides, even in part, one that comes after it
};
Visibility_order order(const Model& model, const Exact_point& eye, const Asking& asking = {});

/// Which faces may obscure which, from anywhere: the strongly connected components of the priority graph of Fuchs,
/// Kedem and Naylor. A part is a place in Model::parts().
struct Priority : Answer {
  std::vector<std::vector<std::uint32_t>> components;  ///< those that may obscure others first
  std::size_t cyclic = 0;                              ///< components of more than one part
};
Priority priority_graph(const Model& model, const Asking& asking = {});

/// The faces that a moving viewpoint is in front of, by Tanimoto's cut-set: a step costs what changes. One tracker is
/// one thread's at a time.
class Tracker {
 public:
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;
  /// The faces that came to be on-view or ceased to be, sorted. A viewpoint in a face's plane is not in front of it.
  std::vector<Face_id> move_to(const Exact_point& viewpoint);
  /// Before the first move: false. Errors: std::out_of_range where there is no such face.
  bool on_view(Face_id face) const;
  std::vector<Face_id> on_view() const;  ///< sorted

 private:
  struct Inside;
  explicit Tracker(std::unique_ptr<Inside> inside);
  friend Tracker track(const Model& model);
  std::unique_ptr<Inside> inside_;
};
Tracker track(const Model& model);

/// What is seen from a point.
struct Seen : Answer {
  Exact_point eye;
  std::vector<Face_id> visible;      ///< from their front, sorted
  std::vector<Face_id> from_behind;  ///< sorted
  struct Visible_part : Part {
    bool from_front;
  };
  /// The visible parts of faces, those seen from behind too. They do not overlap: where several faces lie in one plane
  /// all of them are visible, and the part is of one of them, of one seen from its front if there is one.
  std::vector<Visible_part> parts;
  /// Of a face's parts that are seen from its front. Cost: of all faces when it is first asked; then O(log n), whatever
  /// becomes of `parts`. Errors: std::out_of_range where the model has no such face; std::logic_error where no question
  /// made the answer.
  double area(Face_id face) const;
  double solid_angle(Face_id face) const;  ///< the same in steradians, of 4 pi

  /// An edge of the scene, or a line where faces cross, in the drawing of what is seen.
  struct Line {
    std::array<Exact_point, 2> ends;
    std::string kind;            ///< "boundary", "silhouette", "smooth", "crease"; "intersection": faces cross there
    std::vector<Face_id> faces;  ///< that it bounds; that cross there
    struct Stretch {
      Rational from, to;  ///< from ends[0] + from (ends[1] - ends[0])
      std::optional<Face_id> hidden_by;
    };
    std::vector<Stretch> stretches;  ///< from end to end
  };
  /// Edges of which something is in the view, and what is seen of lines where faces cross. Made when asked for; any
  /// thread tells how much is done, and what `progress` throws ends it. Errors: as area().
  std::vector<Line> lines(const Asking::Progress& progress = {}) const;

  struct Inside;  ///< for what is behind the door

 private:
  std::shared_ptr<const Inside> inside_;
};
Seen see(const Model& model, const Exact_point& eye, const Asking& asking = {});
/// The same within the cone of some rays, three or more, all within less than a half space: counterclockwise around its
/// inside as seen from out there, looking back at the eye (each three in this order are positively oriented). Errors:
/// std::invalid_argument for other rays, and for these in the opposite order.
Seen see_in_field(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
                  const Asking& asking = {});

/// The faces some point of which is seen from some point of the sources. Every kept face is in one list; lists are
/// sorted. It goes on until nothing is undecided, or the budget is spent; what `progress` throws ends it.
struct Weak_visibility : Answer {
  std::vector<Face_id> visible, hidden, undecided;
};
/// From a face, to its front. Errors: std::out_of_range where the model has no such face.
Weak_visibility weakly_visible(const Model& model, Face_id source, const Asking& asking = {});
/// From convex polygons, each counterclockwise as seen from the side that it looks to. Errors: std::invalid_argument,
/// which says what to do, for one that is not planar, not convex or has no area.
Weak_visibility weakly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                               const Asking& asking = {});
/// A quick answer that leaves out nothing: a face is hidden only where one part alone hides it, or it looks away; all
/// others count as visible, and of these there is no certificate. Errors: as weakly_visible(); Out_of_budget.
Weak_visibility possibly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                                 const Asking& asking = {});
/// Both from some point of the inside of solids too: what the surface of one sees outwards, and what is seen from
/// within. Each soup bounds one; inside is where its faces wind round. Errors: std::invalid_argument also where the
/// faces of one do not close up, or enclose nothing.
Weak_visibility weakly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                           const std::vector<std::vector<Exact_point>>& sources = {},
                                           const Asking& asking = {});
Weak_visibility possibly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                             const std::vector<std::vector<Exact_point>>& sources = {},
                                             const Asking& asking = {});
/// The convex parts of a face as sources. Errors: std::out_of_range where the model has no such face.
std::vector<std::vector<Exact_point>> sources_of(const Model& model, Face_id face);

/// What an eye sees that moves straight from one point to another: at the moment t, from 0 to 1, it is at
/// from + t (to - from).
struct Seen_along : Answer {
  /// A face that changes, whether it is seen just before, then, and just after, and why: "horizon", the eye is in its
  /// plane; "contact", on some face; "edge and vertex", in a plane of two edges; "triple", three edges look concurrent.
  struct Change {
    Face_id face;
    bool before, at, after;
    std::string kind;
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< that one ray of the eye meets: a place in Model::parts(), and
                                                      ///< the corner there that the edge begins at
  };
  struct Event {
    Quadratic_root t;
    std::vector<Change> changes;  ///< by face
  };
  std::vector<Event> events;                       ///< in order: all moments at which what is seen changes, exactly
  std::vector<Face_id> at_start, at_end, visible;  ///< at 0, at 1, at some moment between them; sorted
};
/// Its certificate says when each face is seen, and takes more than twice the time of the answer. Errors:
/// std::invalid_argument where the path has no length.
Seen_along see_along(const Model& model, const Exact_point& from, const Exact_point& to, const Asking& asking = {});

/// What each ray meets first: the hits of the least t, by face, none where nothing is met. Faces are closed and met
/// from both sides; a face that holds the origin is passed over, unless `start` is closed. Errors: std::domain_error
/// for a direction that is zero.
std::vector<std::vector<Face_hit>> trace(const Model& model, std::span<const Exact_ray> rays,
                                         Ray_start start = Ray_start::open, const Asking& asking = {});
/// All that each ray meets, by t, then by face.
std::vector<std::vector<Face_hit>> trace_all(const Model& model, std::span<const Exact_ray> rays,
                                             Ray_start start = Ray_start::open, const Asking& asking = {});

/// The first face that a ray meets: the face and the side are exact, t is between the bounds.
struct Nearest_face {
  static constexpr Face_id nothing = ~Face_id{0};
  Face_id face = nothing;
  Met_side side = Met_side::front;
  bool tied = false;  ///< others are met there too
  double low = 0, high = 0;
};
/// The first of trace() for rays in doubles. Cost: about 1 us a ray.
std::vector<Nearest_face> nearest(const Model& model, std::span<const Double_ray> rays,
                                  Ray_start start = Ray_start::open, const Asking& asking = {});

/// A solid made of others, and where its faces come from. Its certificate takes the time of the answer again.
struct Combined : Answer {
  /// Closed, fronts outwards; faces may have holes. It is made ready when it is first asked for more than its soup,
  /// which no budget bounds: where new points have many denominators that takes far longer than the operation.
  Model model;
  std::vector<std::pair<std::uint32_t, Face_id>> faces;  ///< of each face: which solid it was of, and which face there
  Rational volume;
  std::array<double, 2> area() const;  ///< the least and the most; of the soup. Cost: O(n)
};
/// Set operations on solids: "union", "intersection", "difference" (the first less all others) or
/// "symmetric-difference" (in an odd number of them). A solid is where its faces wind round a point a "positive",
/// "nonzero" or "odd" number of times. Errors: std::invalid_argument for other words, and for a model that bounds no
/// solid. Exact: yes.
Combined combine(std::string_view operation, const std::vector<Model>& solids, std::string_view inside = "positive",
                 const Asking& asking = {});

/// What a checker says that shares no code with what made the certificate.
struct Checked {
  bool accepted;
  std::string why;  ///< one line
};
/// Errors: std::invalid_argument for a text that is no certificate.
Checked verify(const Model& model, const std::string& certificate, const Asking& asking = {});
/// The same of a set operation on solids: that it is proved, and that this is the result.
Checked verify(const std::vector<Model>& solids, const Model& result, const std::string& certificate,
               const Asking& asking = {});

}  // namespace sightline
