// What keeps a pointer to what it was made of takes no temporary for it: that would be gone before the first question.
// And what is kept in something is not to be had of a temporary.

#include <sightline/algorithms/baseline/doubles_search.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/algorithms/image/image_faces.h>
#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/hidden_lines.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/separation.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/weak_visibility/along/along_scene.h>
#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/harness/compare/visible_errors.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/lockstep_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <span>
#include <type_traits>
#include <utility>

namespace sightline {

/// Whether a Class is made of a thing that stays (and what comes after it), and of no temporary.
template <class Class, class Kept, class... Others>
inline constexpr bool keeps = std::is_constructible_v<Class, const Kept&, const Others&...>&&
                                  std::is_constructible_v<Class, Kept&, const Others&...> &&
                              !std::is_constructible_v<Class, Kept, const Others&...>;
/// The same of the second of two things.
template <class Class, class First, class Kept, class... Others>
inline constexpr bool keeps_second = !std::is_constructible_v<Class, const First&, Kept, const Others&...>;

/// Whether a call to what stays compiles, and none to a temporary: what it returns would refer to that.
template <class Of, class Call>
inline constexpr bool stays = std::is_invocable_v<Call, const Of&>&& std::is_invocable_v<Call, Of&> &&
                              !std::is_invocable_v<Call, Of> && !std::is_invocable_v<Call, const Of>;

TEST(Temporaries, are_not_taken_by_what_keeps_a_pointer) {
  using Doubles = Point_traits<CGAL::Simple_cartesian<double>>;
  using Both = Lockstep_traits<Exact_traits, Doubles>;
  using Relation = Priority_relation<Exact_traits>;

  // kernel/
  static_assert(keeps<Exact_traits, Scene>);
  static_assert(keeps<Doubles, Scene>);
  static_assert(keeps<Face_graph, Scene>);
  static_assert(keeps<Line_table, Grid_points>);
  static_assert(keeps<Both, Exact_traits, Doubles> && keeps_second<Both, Exact_traits, Doubles>);
  static_assert(keeps<Predicates, Grid_points, Plane_table, Point_planes> &&
                keeps_second<Predicates, Grid_points, Plane_table, Point_planes>);
  static_assert(!std::is_constructible_v<Predicates, const Grid_points&, const Plane_table&, Point_planes>);

  // algorithms/
  static_assert(keeps<Exact_view, Scene, Exact_point>);
  static_assert(keeps<Number_view<double>, Scene, Exact_point>);
  static_assert(keeps<Occluders, Scene>);
  static_assert(keeps<Edge_lines, Occluders>);
  static_assert(keeps<Hidden_lines, Exact_view, Visible_surface<Exact_view>> &&
                keeps_second<Hidden_lines, Exact_view, Visible_surface<Exact_view>>);
  static_assert(keeps<Separation_finder<Exact_traits>, Exact_traits>);
  static_assert(keeps<Relation, Exact_traits>);
  static_assert(keeps<Relation, Exact_traits, std::span<const Relation::Polygon>>);
  static_assert(keeps<Priority_index<Exact_traits>, Relation>);
  static_assert(keeps<Implicit_priority_graph<Relation>, Relation>);
  static_assert(keeps<Region_relation<Exact_traits>, Relation, View_region>);
  static_assert(keeps<Ray_relation<Exact_traits>, Relation, Exact_point, Exact_point>);
  static_assert(keeps<On_view<Exact_traits>, Exact_traits, Face_graph> &&
                keeps_second<On_view<Exact_traits>, Exact_traits, Face_graph>);
  static_assert(keeps<Cut_set_tracker<Exact_traits>, Exact_traits, Face_graph> &&
                keeps_second<Cut_set_tracker<Exact_traits>, Exact_traits, Face_graph>);
  static_assert(keeps<Cut_set_1977<Exact_traits>, Exact_traits, Face_graph, Viewpoint, Reading_1977> &&
                keeps_second<Cut_set_1977<Exact_traits>, Exact_traits, Face_graph, Viewpoint, Reading_1977>);
  static_assert(keeps<Doubles_search, Occluders, Doubles_search_options> &&
                keeps_second<Doubles_search, Occluders, Doubles_search_options>);

  static_assert(keeps<Light_partitioner, Scene>);
  static_assert(keeps<Along_scene, Occluders, Exact_point, Exact_point, std::function<void()>>);
  static_assert(keeps<Ray_tracer, Scene>);
  static_assert(keeps<Pvs_search, Level_cells> && keeps<Pvs_search, Level_cells, Pvs_options>);
  static_assert(keeps<Cell_pvs_search, Level_cells> && keeps<Cell_pvs_search, Level_cells, Pvs_options>);
  static_assert(keeps<image_detail::Image_faces, Exact_view, Pixel_view, Image_options> &&
                keeps<image_detail::Image_faces, Scene, Pixel_view, Image_kernel, Image_options>);

  // harness/
  static_assert(keeps<Visible_reference, Exact_view, Visible_surface<Exact_view>>);
}

#define SIGHTLINE_CALL(...)                                               \
  [](auto&& of) -> decltype(std::forward<decltype(of)>(of).__VA_ARGS__) { \
    return std::forward<decltype(of)>(of).__VA_ARGS__;                    \
  }

TEST(Temporaries, give_nothing_that_refers_to_them) {
  const auto of_scene = [](auto call) { static_assert(stays<Scene, decltype(call)>); };
  of_scene(SIGHTLINE_CALL(file()));
  of_scene(SIGHTLINE_CALL(points()));
  of_scene(SIGHTLINE_CALL(planes()));
  of_scene(SIGHTLINE_CALL(pieces()));
  of_scene(SIGHTLINE_CALL(corners(Piece())));
  of_scene(SIGHTLINE_CALL(set_aside()));
  of_scene(SIGHTLINE_CALL(non_planar()));
  of_scene(SIGHTLINE_CALL(concave()));
  of_scene(SIGHTLINE_CALL(counters()));
  of_scene(SIGHTLINE_CALL(incidences()));
  of_scene(SIGHTLINE_CALL(predicates()));
  const auto of_soup = [](auto call) { static_assert(stays<Polygon_soup, decltype(call)>); };
  of_soup(SIGHTLINE_CALL(loop(0)));
  of_soup(SIGHTLINE_CALL(loop(0, 1)));
  const auto of_graph = [](auto call) { static_assert(stays<Face_graph, decltype(call)>); };
  of_graph(SIGHTLINE_CALL(mesh()));
  of_graph(SIGHTLINE_CALL(edges()));
  of_graph(SIGHTLINE_CALL(edges_of(0)));
  of_graph(SIGHTLINE_CALL(components()));
}

#undef SIGHTLINE_CALL

}  // namespace sightline
