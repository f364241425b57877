#pragma once
// The cases that `sightline judge` asks about: families at several distances from their degeneracies, or scenes of a
// folder.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/judge/truth.h>

#include <functional>
#include <string>
#include <vector>

namespace sightline::app {

struct Case_options {
  judge::Question question = judge::Question::see;
  bool two_sided = false;
  bool doubles = true;  ///< coordinates are rounded to doubles, which any program reads
};

/// A scene and a query about it, or why there is none.
struct Judge_case {
  Polygon_soup soup;
  judge::Query query;
  std::vector<Face_id> visible, hidden;  ///< what construction knows of a weak query, where it is as given
  bool as_given = true;                  ///< nothing was rounded, no face cut
  std::string not_asked;
};

/// A case of a family. Where weak visibility is asked and the family names no source, a face of the scene looks. The
/// same arguments give the same case.
Judge_case case_of(const generate::Family& family, const generate::Family_parameters& parameters,
                   const Case_options& options);

/// A query about a scene.
Judge_case case_of(const Polygon_soup& scene, const judge::Query& query, const Case_options& options);

/// A case of a scene of somebody's: an eye in or about its box, or a small square there that looks along an axis.
Judge_case case_of(const Polygon_soup& scene, std::uint64_t seed, const Case_options& options);

/// Which cases are wanted.
struct Case_choice {
  std::vector<std::string> families;  ///< none: all
  std::vector<std::string> ulps;      ///< whole numbers, or `far`
  std::size_t size = 0;               ///< of families' scenes; 0: small
  std::string scenes, ask;  ///< instead of families, a folder or a file; and a file with the one query about it,
                            ///< instead of queries of our own
};

/// What all cases of a family have in common at one distance, or all of a scene, and how to make them.
struct Case_group {
  std::string family, distance;
  std::string again;  ///< the options that ask one of these cases again, but for its seed
  std::function<Judge_case(std::uint64_t seed)> make;
  std::int64_t ulps = 0;  ///< where they are
  std::string exactly;    ///< what they are at 0 ulps: "exactly degenerate", or as the scene's file is
  /// The same case so many ulps of its size from there: a family's as far from its degeneracy; of a scene of somebody's
  /// the eye, or the source, is moved, askew to the axes.
  std::function<Judge_case(std::uint64_t seed, std::int64_t ulps)> moved;
};

/// Errors: Usage_error naming the option.
std::vector<Case_group> groups_of(const Case_choice& choice, const Case_options& options);

}  // namespace sightline::app
