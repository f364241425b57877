#pragma once
// How a program that is judged is asked, and how it answers: the query is JSON, the answer JSON or plain lines. The
// format is described on the page of this folder.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sightline::judge {

using Json = nlohmann::ordered_json;

enum class Question { order, see, weak, trace, boolean };
inline constexpr std::array<std::string_view, 5> question_names{"order", "see", "weak", "trace", "boolean"};

/// What a program is asked about a scene.
struct Query {
  Question question = Question::see;
  Exact_point eye;                   ///< of order and see
  std::vector<Exact_point> source;   ///< of weak: a convex polygon, counterclockwise as seen from the side it looks to
  bool two_sided = false;            ///< faces seen from behind count too; of order, see and weak
  std::vector<Exact_ray> rays = {};  ///< of trace
  Set_operation operation = Set_operation::unite;  ///< of boolean
  std::size_t first = 0;  ///< of boolean: the scene's first so many faces bound one solid, all others the other
};

/// A face in an order: the whole of it, or the convex hull of some points on it.
struct Drawn_face {
  Face_id face = 0;
  std::vector<Exact_point> part;  ///< none: the whole face
};

/// What a program answered. A face that is neither visible nor abstained from is hidden.
struct Answer {
  std::vector<Face_id> visible;               ///< of see and weak; sorted
  std::vector<Drawn_face> order;              ///< of order: farthest first
  std::vector<std::optional<Face_id>> first;  ///< of trace: what each ray meets first, if anything
  std::optional<Polygon_soup> surface;        ///< of boolean; none: abstained
  std::vector<Face_id> abstained;             ///< sorted; of trace: numbers of rays
};

/// A number of JSON: an integer of 64 bits, or the double that it reads as; or a string "p/q". Errors of this and the
/// next two: std::invalid_argument that says what is wrong, in one line that begins with `at`. Exact: yes.
Rational number_from_json(const nlohmann::json& value, const std::string& at);

/// A point [x, y, z].
Exact_point point_from_json(const nlohmann::json& value, const std::string& at);

/// A list of points.
std::vector<Exact_point> points_from_json(const nlohmann::json& value, const std::string& at);

/// The query as a program gets it: {"query": "see", "eye": [0.5, 2, 1], "two_sided": false}, or "source" with a list of
/// points for weak; {"query": "trace", "rays": [{"origin": [0, 0, 1], "direction": [0, 0, -1]}]}; {"query": "boolean",
/// "operation": "union", "first": 6}. Coordinates are JSON numbers where they are doubles, in which case they read as
/// those doubles, else strings "p/q". Exact: yes.
Json to_json(const Query& query);

/// A query as to_json() writes it. Errors: std::invalid_argument that says what is wrong. Exact: yes.
Query query_from_json(const nlohmann::json& value);

/// Readers of JSON round integers beyond 64 bits, as decimals, to a double. Errors: std::invalid_argument where a text,
/// which is JSON, has one.
void check_integers(const std::string& text);

/// What a program wrote, about a scene of so many faces and so many rays. Text that begins with { is JSON, all other
/// text has a face a line; an empty one sees nothing. Of trace each line is of a ray: a face, `none` or `abstained`. Of
/// boolean it is OFF, with coordinates p/q where it has a /, or `abstained`.
/// Errors: std::invalid_argument that says in one line what is wrong: unknown faces, a face twice in an order, one both
/// answered and abstained from, integers beyond 64 bits. Exact: yes.
Answer read_answer(const std::string& text, Question question, std::size_t faces, std::size_t rays = 0);

}  // namespace sightline::judge
