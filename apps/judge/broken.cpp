#include "broken.h"

#include "picture.h"
#include "view.h"

#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/reduce.h>

#include <set>
#include <stdexcept>

namespace sightline::app {

namespace {

using namespace judge;

/// Whether a face has a corner twice.
bool repeats_a_corner(const Polygon_soup& soup) {
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    std::set<Exact_point> corners;
    for (const Point_id p : loop) corners.insert(soup.point(p));
    if (corners.size() < loop.size()) return true;
  }
  return false;
}

/// Whether a case is broken as another one is: the same mark, and faces wrong in no way that is new.
bool broken_alike(const Judged& judged, const Judged& broken) {
  return judged.breaks && judged.mark == broken.mark &&
         (judged.grade.wrong_visible.empty() || !broken.grade.wrong_visible.empty()) &&
         (judged.grade.wrong_hidden.empty() || !broken.grade.wrong_hidden.empty());
}

/// What is drawn of a case.
struct Drawn_case {
  Polygon_soup soup;
  Query query;
  Grade grade;
  Explanation why;
};

/// The same, of coordinates of 1 at most.
Drawn_case made_small(Drawn_case drawn) {
  Rational largest = 0;
  for (Point_id p = 0; p < drawn.soup.point_count(); ++p)
    for (const Rational& x : drawn.soup.point(p)) largest = std::max(largest, Rational(abs(x)));
  if (largest == 0) return drawn;
  const auto shrink = [&](Exact_point& p) {
    for (Rational& x : p) x /= largest;
  };
  drawn.soup = generate::scaled(drawn.soup, Rational(1 / largest));
  shrink(drawn.query.eye);
  for (Exact_point& p : drawn.query.source) shrink(p);
  for (auto& [origin, direction] : drawn.query.rays) {
    shrink(origin);
    shrink(direction);
  }
  for (Wrong_point& wrong : drawn.grade.wrong_points) {
    shrink(wrong.at);
    shrink(wrong.on);
  }
  if (drawn.why.refutation) {
    Refutation& line = *drawn.why.refutation;
    shrink(line.from);
    shrink(line.to);
    if (line.at) shrink(*line.at);
  }
  return drawn;
}

}  // namespace

Json explained(const Judge_arguments& arguments, const Judge_case& asked, const Judged& broken) {
  const Explanation why = explain(asked.soup, asked.query, broken.answer, broken.grade,
                                  arguments.court_options().contract, arguments.budget);
  Json json{{"share", why.share}, {"share_words", why.share_words}, {"line", Json()}};
  if (why.refutation) {
    const Refutation& line = *why.refutation;
    json["line"] = {{"face", line.face},
                    {"from", point_json(line.from)},
                    {"to", point_json(line.to)},
                    {"by", line.by ? Json(*line.by) : Json()},
                    {"words", line.words}};
  }
  const Wrong_words words = words_of_wrong(asked.query.question);
  const auto draw = [&](const Polygon_soup& soup, const Query& query, const Grade& grade, const Explanation& shown) {
    json["picture"] = picture_of(soup, query, grade, shown, words);
    json["view"] = view_of("judge", arguments.query, soup, query, grade, shown, words);
  };
  try {
    draw(asked.soup, asked.query, broken.grade, why);
  } catch (const std::domain_error&) {  // beyond doubles
    const Drawn_case small = made_small({asked.soup, asked.query, broken.grade, why});
    draw(small.soup, small.query, small.grade, small.why);
  }
  return json;
}

void keep_picture(const Judge_arguments& arguments, Json& explained_case, const std::string& stem) {
  if (arguments.keep.empty()) return;
  const std::string file = (std::filesystem::path(arguments.keep) / (stem + ".svg")).string();
  write_file(file, explained_case["explained"]["picture"].get<std::string>());
  explained_case["files"].push_back(file);
}

Json made_smaller(const Judge_arguments& arguments, const Court& court, const Judge_case& asked, const Judged& broken) {
  bool one_ray = false;  // as an eye and a direction
  const auto case_of_smaller = [&](const generate::Posed_scene& smaller) {
    Query query{asked.query.question, smaller.eye,           smaller.source,   asked.query.two_sided,
                asked.query.rays,     asked.query.operation, asked.query.first};
    if (one_ray) query = {query.question, {}, {}, false, {{smaller.eye, smaller.source.at(0)}}};
    return case_of(smaller.soup, query, arguments.case_options());
  };
  const bool repeats = repeats_a_corner(asked.soup);
  const auto fails = [&](const generate::Posed_scene& smaller) {
    const Judge_case other = case_of_smaller(smaller);
    return other.as_given && (repeats || !repeats_a_corner(other.soup)) &&
           broken_alike(court.judge(other, broken.seed), broken);
  };
  Countdown time("reducing", arguments.reduce);
  harness::Reduce_options options;
  options.most_tests = 1000000;
  options.out_of_time = [&] { return time.over(); };
  generate::Posed_scene scene;
  scene.soup = asked.soup;
  scene.eye = asked.query.eye;
  scene.source = asked.query.source;
  // Of rays the first is kept that breaks the contract when asked alone.
  for (const Wrong_ray& wrong : broken.grade.wrong_rays) {
    generate::Posed_scene alone{scene};
    alone.eye = asked.query.rays[wrong.ray].origin;
    alone.source = {asked.query.rays[wrong.ray].direction};
    one_ray = true;
    one_ray = fails(alone);
    if (!one_ray) continue;
    scene = alone;
    break;
  }
  const harness::Reduced reduced = harness::reduce(scene, fails, options);
  const Judge_case left = case_of_smaller(reduced.scene);
  const Judged last = court.judge(left, broken.seed);
  const std::vector<std::string> files = court.keep_files(arguments.keep, "reduced", left, court.said());
  Json json{
      {"faces", last.faces},
      {"runs", reduced.tests},
      {"finished", reduced.finished},
      {"mark", mark_names[static_cast<std::size_t>(last.mark)]},
      {"why", last.why},
      {"files", files},
      {"again", command_again(arguments, "--scenes " + shell_word(files.at(0)) + " --ask " + shell_word(files.at(1)))}};
  if (last.mark == Mark::wrong) {
    json["explained"] = explained(arguments, left, last);
    keep_picture(arguments, json, "reduced");
  }
  return json;
}

std::vector<std::string> guesses(const Judge_arguments& arguments, const Court& court, const Case_group& group,
                                 const Judge_case& asked, const Judged& broken) {
  std::vector<std::string> guesses;
  for (const Reading reading : lists_faces(broken.answer) ? readings_of(asked.query.question) : std::vector<Reading>())
    if (is_right(reading, asked.soup, asked.query, broken.answer, arguments.court_options().truth))
      guesses.push_back("the answer is right read otherwise, " + words_of(reading, asked.query.two_sided));
  std::vector<Neighbour> neighbours{{group.ulps, true}};
  std::vector<std::int64_t> places{0};
  for (const int bits : {0, 12, 22, 32, 44})  // one ulp, 2^-40, 2^-30, 2^-20 and 2^-8 of the size
    for (const std::int64_t sign : {1, -1}) places.push_back(sign * (std::int64_t{1} << bits));
  for (const std::int64_t place : places) {
    if (place == group.ulps) continue;
    const Judged moved = court.judge(group.moved(broken.seed, place), broken.seed);
    if (moved.not_asked.empty() && (moved.mark == Mark::right || moved.mark == Mark::wrong))
      neighbours.push_back({place, moved.mark == Mark::wrong});
  }
  if (neighbours.size() > 1) guesses.push_back(words_of(neighbours, group.exactly));
  return guesses;
}

const std::vector<Reading>& Common_guess::add(const Judge_case& asked, const Judged& wrong,
                                              const Truth_options& options, const std::vector<Reading>* kept) {
  ++wrong_;
  supported_ = supported_ || lists_faces(wrong.answer);
  std::erase_if(readings_, [&](Reading reading) {
    return kept != nullptr ? std::find(kept->begin(), kept->end(), reading) == kept->end()
                           : !is_right(reading, asked.soup, asked.query, wrong.answer, options);
  });
  return readings_;
}

void Common_guess::add(const Kinds& kinds) {
  kinds_.concave_right += kinds.concave_right;
  kinds_.concave_wrong += kinds.concave_wrong;
  kinds_.convex_right += kinds.convex_right;
  kinds_.convex_wrong += kinds.convex_wrong;
}

std::vector<std::string> Common_guess::words() const {
  std::vector<std::string> all;
  for (const Reading reading : supported_ ? readings_ : std::vector<Reading>())
    all.push_back(fmt::format("in {} the answer is right read otherwise, {}",
                              wrong_ == 1 ? "the one wrong case" : fmt::format("all {} wrong cases", wrong_),
                              words_of(reading, two_sided_)));
  if (const std::string kinds = words_of(kinds_); !kinds.empty()) all.push_back(kinds);
  return all;
}

}  // namespace sightline::app
