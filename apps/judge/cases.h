#pragma once
// The cases that `sightline judge` asks about: families at several distances from their degeneracies, or scenes of a
// folder.

#include <sightline/harness/judge/case.h>

#include <functional>
#include <string>
#include <vector>

namespace sightline::app {

using judge::case_of;
using judge::Case_options;
using Judge_case = judge::Case;

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
  /// the eye, the source or the second solid is moved, askew to the axes.
  std::function<Judge_case(std::uint64_t seed, std::int64_t ulps)> moved;
  std::string file;  ///< of the scene; none: a family's
};

/// What tells a group from others of the same number, for --resume: its name, distance, and the content of its file,
/// and of files that this names.
std::string identity(const Case_group& group);

/// Errors: Usage_error naming the option, Input_error naming the file or the folder.
std::vector<Case_group> groups_of(const Case_choice& choice, const Case_options& options);

}  // namespace sightline::app
