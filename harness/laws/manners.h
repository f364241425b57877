#pragma once
// The manners in which a question may be asked: by so many threads, with somebody who is told how far it is, and who
// may give up. The answer is the same in all of them.

#include <sightline/harness/laws/subject.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sightline::harness {

struct Manner {
  int threads = 1;
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// A question of a command. Its answer is text, all that it says; `choice` draws what it leaves open.
struct Question {
  std::string name;
  std::string (*ask)(const Posed_scene& posed, const Manner& manner, std::uint64_t choice);
  bool is_for_crowds = false;  ///< asked of many copies of a scene, too
  bool always_tells = false;   ///< of progress, where the scene has faces that are not set aside
};

/// Of one scene in eight, if it has up to 40 faces: one of the questions is answered the same by several threads, with
/// progress told, which is never more than all, nor nothing where a question always tells; and where who is told
/// throws, that comes out, and nothing else.
Check manners_check(std::vector<Question> questions);

}  // namespace sightline::harness
