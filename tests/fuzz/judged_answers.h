#pragma once
// Answers as programs write them, in lines and in JSON: each is read as it was meant, or refused where it was made
// wrong; and solids that wind, or close up, otherwise than the judge can take.

#include "judged_cases.h"
#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/io/exact_text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace fuzz::judged_laws {

/// An answer, how it is written, and where it was made wrong, in words of which a refusal has the first one.
class Told_answer {
 public:
  Told_answer(Question question, Random& random)
      : question_(question), random_(random), is_json_(random.chance(1, 2)), faces_(1 + random.below(6)) {
    if (question == Question::trace) tell_rays();
    else tell_faces();
    if (question != Question::order) {
      std::sort(meant_.visible.begin(), meant_.visible.end());
      meant_.visible.erase(std::unique(meant_.visible.begin(), meant_.visible.end()), meant_.visible.end());
    }
  }

  /// Read as it was meant, unless it was made wrong; then the place of what is wrong is named, where it has one.
  void check() const {
    judge::Answer read;
    std::string said;
    try {
      read = judge::read_answer(text(), question_, faces_, rays_);
    } catch (const std::invalid_argument& error) {
      said = error.what();
    }
    require(said.empty() != is_wrong_, "answers are read, or refused, as they are right or wrong");
    require(said.find('\n') == std::string::npos && names(said, wrong_at_), "a refusal is a line, and names the place");
    if (is_wrong_) return;
    require(read.visible == meant_.visible && read.abstained == meant_.abstained && read.first == meant_.first,
            "answers are read as they were meant");
    require(std::equal(read.order.begin(), read.order.end(), meant_.order.begin(), meant_.order.end(),
                       [](const judge::Drawn_face& a, const judge::Drawn_face& b) {
                         return a.face == b.face && a.part == b.part;
                       }),
            "orders are read as they were meant");
  }

 private:
  std::string key() const {
    return question_ == Question::order ? "order" : question_ == Question::trace ? "first" : "visible";
  }
  std::string text() const {
    std::string all;
    if (!is_json_) {
      for (const std::string& line : entries_) all += line + (random_.chance(1, 9) ? " \r\n\n" : "\n");
      return all;
    }
    const auto list = [](const std::vector<std::string>& of) {
      std::string joined;
      for (const std::string& entry : of) joined += (joined.empty() ? "" : ", ") + entry;
      return '[' + joined + ']';
    };
    all = "{\"" + key() + "\": " + list(entries_);
    if (!abstained_.empty()) all += ", \"abstained\": " + list(abstained_);
    return all + '}';
  }

  std::string some_wrong_entry() {
    const std::string beyond = std::to_string(faces_ + random_.below(3));
    if (!is_json_ && question_ != Question::trace && random_.chance(1, 4))
      return random_.chance(1, 2) ? "none" : "abstained none";  // which rays have alone
    if (!is_json_) return std::array<std::string, 6>{beyond, "-1", "1.5", "x", "0 0", "abstained -1"}[random_.below(6)];
    const std::array<std::string, 7> wrong{beyond, "-1", "1.5", "true", "[]", "{}", "{\"face\": 0}"};
    return wrong[random_.below(wrong.size())];
  }
  /// One entry more that is none, and what a refusal names.
  void add_wrong_entry() {
    is_wrong_ = true;
    wrong_at_ = is_json_ ? key() + '[' + std::to_string(entries_.size()) + ']' : "line ";
    entries_.push_back(some_wrong_entry());
  }

  void tell_faces() {
    std::vector<Face_id> all(faces_);
    std::iota(all.begin(), all.end(), Face_id{0});
    for (std::size_t k = all.size(); k > 1; --k) std::swap(all[k - 1], all[random_.below(k)]);
    const bool goes_wrong = random_.chance(1, 3);
    for (const Face_id face : all) {
      if (goes_wrong && !is_wrong_ && random_.chance(1, 3)) go_wrong(face);
      switch (random_.below(4)) {
        case 0: break;  // hidden
        case 1: abstain_from(face); break;
        default: show(face);
      }
    }
    std::sort(meant_.abstained.begin(), meant_.abstained.end());
  }
  void show(Face_id face) {
    if (question_ != Question::order) {
      for (std::uint64_t times = random_.chance(1, 6) ? 2 : 1; times > 0; --times)
        entries_.push_back(std::to_string(face));
      meant_.visible.push_back(face);
    } else if (is_json_ && random_.chance(1, 3)) {
      for (std::uint64_t parts = 1 + random_.below(2); parts > 0; --parts) show_part(face, 3 + random_.below(3));
    } else {
      entries_.push_back(std::to_string(face));
      meant_.order.push_back({face, {}});
    }
  }
  void show_part(Face_id face, std::size_t corners) {
    judge::Drawn_face& part = meant_.order.emplace_back();
    part.face = face;
    std::string list;
    for (std::size_t k = 0; k < corners; ++k) {
      Exact_point& p = part.part.emplace_back();
      list += k == 0 ? "[" : ", [";
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis] = Rational(random_.between(-20, 20), random_.chance(1, 2) ? 4 : 3);
        p[axis].canonicalize();
        const bool is_double = p[axis].get_den() != 3;
        list += (axis == 0 ? "" : ", ") +
                (is_double && random_.chance(2, 3) ? std::to_string(p[axis].get_d()) : '"' + to_string(p[axis]) + '"');
      }
      list += "]";
    }
    entries_.push_back("{\"face\": " + std::to_string(face) + ", \"vertices\": [" + list + "]}");
  }
  void abstain_from(Face_id face) {
    if (is_json_) abstained_.push_back(std::to_string(face));
    else entries_.push_back("abstained " + std::to_string(face));
    meant_.abstained.push_back(face);
  }
  /// An entry that is none; a face both answered and left open; in an order one twice, or whole and in parts, or a part
  /// of too few corners.
  void go_wrong(Face_id face) {
    const std::uint64_t kind = random_.below(question_ == Question::order ? 5 : 3);
    if (kind == 0) return add_wrong_entry();
    is_wrong_ = true;
    if (kind == 1 || (kind > 2 && !is_json_)) {
      entries_.push_back(std::to_string(face));
      abstain_from(face);
    } else if (kind == 2) {
      if (!is_json_ || random_.chance(1, 2)) return add_wrong_entry();
      abstained_.push_back(std::array<std::string, 3>{std::to_string(faces_), "\"0\"", "null"}[random_.below(3)]);
      wrong_at_ = "abstained[" + std::to_string(abstained_.size() - 1) + ']';
    } else if (kind == 3) {
      entries_.push_back(std::to_string(face));
      if (random_.chance(1, 2)) entries_.push_back(std::to_string(face));
      else show_part(face, 3);
    } else {
      wrong_at_ = "order[" + std::to_string(entries_.size()) + ']';
      show_part(face, random_.below(3));
    }
  }

  void tell_rays() {
    rays_ = random_.below(7);
    for (std::size_t ray = 0; ray < rays_; ++ray) {
      if (!is_wrong_ && random_.chance(1, 16)) {
        add_wrong_entry();
        continue;
      }
      switch (random_.below(3)) {
        case 0:
          entries_.push_back(is_json_ ? "null" : "none");
          meant_.first.emplace_back();
          break;
        case 1:
          entries_.push_back(is_json_ ? "\"abstained\"" : "abstained");
          meant_.first.emplace_back();
          meant_.abstained.push_back(static_cast<Face_id>(ray));
          break;
        default:
          meant_.first.emplace_back(static_cast<Face_id>(random_.below(faces_)));
          entries_.push_back(std::to_string(*meant_.first.back()));
      }
    }
    if (is_wrong_ || random_.chance(7, 8)) return;
    is_wrong_ = true;  // a ray more or less than are asked about
    if (random_.chance(1, 2)) ++rays_;
    else entries_.push_back("0");
  }

  Question question_;
  Random& random_;
  bool is_json_, is_wrong_ = false;
  std::size_t faces_, rays_ = 0;
  std::vector<std::string> entries_, abstained_;
  judge::Answer meant_;
  std::string wrong_at_;
};

inline void try_told_answer(Random& random) {
  static constexpr std::array<Question, 4> questions{Question::order, Question::see, Question::weak, Question::trace};
  Told_answer(questions[random.below(questions.size())], random).check();
}

/// All is abstained from, in any of four ways; and then nothing may be answered.
inline void try_told_nothing(Random& random) {
  const Question question = std::array{Question::order, Question::see, Question::trace}[random.below(3)];
  const std::size_t faces = 1 + random.below(5), rays = question == Question::trace ? random.below(5) : 0;
  const bool as_json = random.chance(1, 2), answers = random.chance(1, 3);
  const std::string key = question == Question::order ? "order" : question == Question::see ? "visible" : "first";
  const bool lists_nothing = as_json && !answers && question != Question::trace && random.chance(1, 2);
  const std::string list = answers ? "[0]" : "[]";
  const std::string text =
      as_json ? "{" + (answers || lists_nothing ? "\"" + key + "\": " + list + ", " : "") + "\"abstained\": \"all\"}"
              : std::string(answers ? "0\n" : "") + "abstained all\n";
  judge::Answer read;
  const bool refused =
      is_refused<std::invalid_argument>([&] { read = judge::read_answer(text, question, faces, rays); });
  require(refused == answers, "who abstains from all answers nothing");
  if (refused) return;
  std::vector<Face_id> all(question == Question::trace ? rays : faces);
  std::iota(all.begin(), all.end(), Face_id{0});
  require(read.abstained == all && read.visible.empty() && read.order.empty(), "who abstains from all leaves all open");
}

/// A box, perhaps with one in it, in that again one, and one beside: a solid where fronts look away from what is inside
/// and all boxes have their faces, once, else none.
struct Boxes {
  Polygon_soup soup;
  bool is_solid = true;

  explicit Boxes(Random& random) {
    const bool has_flaw = random.chance(1, 2);
    const auto add = [&](std::int64_t low, std::int64_t size, bool is_hollow) {
      const bool is_open = has_flaw && random.chance(1, 6), is_turned = has_flaw && random.chance(1, 4),
                 is_twice = has_flaw && random.chance(1, 6);
      is_solid = is_solid && !is_open && !is_turned && !is_twice;
      const generate::Points top{exact_point(low, low, low + size), exact_point(low + size, low, low + size),
                                 exact_point(low + size, low + size, low + size),
                                 exact_point(low, low + size, low + size)};
      Polygon_soup box;
      generate::add_prism(box, top, exact_point(0, 0, -size));
      if (is_turned != is_hollow) box = generate::faces_reversed(box);
      for (Face_id face = is_open ? 1 : 0; face < box.face_count(); ++face) {
        generate::Points corners;
        for (const Point_id p : box.loop(face, 0)) corners.push_back(box.point(p));
        for (int times = is_twice ? 2 : 1; times > 0; --times) soup.add_face(generate::added(soup, corners));
      }
    };
    add(0, 12, false);
    if (random.chance(1, 2)) {
      add(2, 8, true);
      if (random.chance(1, 2)) add(3, 4, false);
    }
    if (random.chance(1, 2)) add(20, 3, false);
  }

 private:
  static Exact_point exact_point(std::int64_t x, std::int64_t y, std::int64_t z) {
    return {Rational(x), Rational(y), Rational(z)};
  }
};

inline void try_flaw_of_solids(Random& random) {
  const Boxes a(random), b(random);
  const generate::Solid_pair solids{a.soup, b.soup};
  const std::string flaw = judge::flaw_of_solids(generate::joined(solids), solids[0].face_count());
  require(flaw.empty() == (a.is_solid && b.is_solid), "solids close up and wind once round their inside, or are none");
}

}  // namespace fuzz::judged_laws
