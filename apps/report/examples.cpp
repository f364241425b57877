// The smallest scene that shows an error.

#include "examples.h"

#include "../judge/picture.h"
#include "../judge/view.h"

#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/reduce.h>
#include <sightline/io/write.h>

#include <cstdint>
#include <set>
#include <sstream>

namespace sightline::app {

namespace {

/// A file's name of a contender.
std::string stem_of(const report::Contender& who) {
  std::string stem;
  for (const char c : who.question + ' ' + who.method + ' ' + who.kernel) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain) stem += c;
    else if (!stem.empty() && stem.back() != '-') stem += '-';
  }
  constexpr std::size_t longest = 80;
  if (stem.size() <= longest) return stem;
  std::uint32_t hash = 0;  // of two that are cut off alike
  for (const char c : stem) hash = 131 * hash + static_cast<unsigned char>(c);
  return stem.substr(0, longest) + fmt::format("-{:08x}", hash);
}

bool repeats_a_point(const Polygon_soup& soup) {
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::set<Exact_point> corners;
    for (const Point_id p : soup.loop(f)) corners.insert(soup.point(p));
    if (corners.size() < soup.loop(f).size()) return true;
  }
  return false;
}

/// One contender, asked about one scene after another.
class Witness {
 public:
  Witness(const report::Row& row, const Example_options& options)
      : row_(row), options_(options), question_(report_question(row.who.question)) {
    for (const Report_program& program : options.programs)
      if (program.question == row.who.question && program.name() == row.who.method && row.who.kernel == "program")
        program_ = &program;
  }

  Compare_arguments arguments(const Judge_case& asked) const {
    Compare_arguments a = question_.arguments(asked, options_.effort);
    a.common.seed = row_.smallest->seed;
    a.common.threads = 1;
    a.common.budget = options_.limits.seconds;
    a.says = true;
    return a;
  }

  /// The answer to a case, and the contender's name as its trial has it.
  Report_verdict ask(const std::shared_ptr<const Judge_case>& asked, Json& name) const {
    if (program_ != nullptr) {
      const Contestant contestant = contestant_of(*program_, asked, row_.smallest->seed);
      name = contestant.name;
      return verdict_of(question_, Trial{}, contestant, asked->soup.face_count(), options_.limits);
    }
    const std::unique_ptr<Trial> trial = question_.trial(arguments(*asked), asked->soup);
    for (const Contestant& contestant : trial->contestants) {
      if (contestant.name["kernel"] != row_.who.kernel || method_of(contestant.name) != row_.who.method) continue;
      name = contestant.name;
      return verdict_of(question_, *trial, contestant, asked->soup.face_count(), options_.limits);
    }
    return {};
  }

  /// The command that asks it again about a file.
  std::string again(const Judge_case& asked, const Json& name, const std::string& stem) const {
    if (program_ != nullptr)
      return fmt::format("sightline judge --program {} --query {} --contract exact --scenes {}.off --ask {}.json",
                         shell_word(program_->command), row_.who.question, stem, stem);
    const std::string options = question_.again(arguments(asked), name);
    return fmt::format("sightline {} {}.off {}{} --seed {}", options.starts_with("--") ? "report" : "compare", stem,
                       options, asks_by_file() ? " --ask " + stem + ".json" : "", row_.smallest->seed);
  }

  /// Whether what is asked stands in a file beside the scene.
  bool asks_by_file() const {
    return program_ != nullptr || row_.who.question == "boolean" ||
           (row_.who.question == "trace" && options_.effort.own_query);
  }

 private:
  const report::Row& row_;
  const Example_options& options_;
  const Report_question& question_;
  const Report_program* program_ = nullptr;
};

/// An answer as the judge has it.
judge::Answer answer_of(judge::Question question, std::size_t faces, const Json& said) {
  judge::Answer answer;
  if (question == judge::Question::trace)
    return judge::read_answer(Json{{"first", said}}.dump(), question, faces, said.size());
  if (question == judge::Question::boolean) return judge::read_answer(said.get<std::string>(), question, faces);
  if (question != judge::Question::order) {
    answer.visible = said.get<std::vector<Face_id>>();
    return answer;
  }
  for (const Json& item : said)
    answer.order.push_back({item[0].get<Face_id>(), judge::points_from_json(nlohmann::json(item[1]), "said")});
  return answer;
}

/// Faces that are wrong, of a question that `judge` does not ask, and its line, if it has one.
void take_wrong_faces(const Json& wrong, judge::Query& query, judge::Grade& grade, judge::Explanation& why,
                      Wrong_words& words) {
  grade.wrong_hidden = wrong["missing"]["faces"].get<std::vector<Face_id>>();
  grade.wrong_visible = wrong["extra"]["faces"].get<std::vector<Face_id>>();
  words = {wrong["missing"]["name"].get<std::string>(), wrong["extra"]["name"].get<std::string>()};
  const auto point = [](const Json& at) { return judge::point_from_json(nlohmann::json(at), "wrong_faces"); };
  if (wrong.contains("at")) query.eye = point(wrong["at"]);
  if (!wrong.contains("line")) return;
  judge::Refutation& line = why.refutation.emplace();
  line.face = wrong["line"]["face"].get<Face_id>();
  line.from = point(wrong["line"]["from"]);
  line.to = point(wrong["line"]["to"]);
  line.words = wrong["words"].get<std::string>();
}

/// Why no face is marked where something is wrong.
std::string words_of_nothing_marked(const std::string& question) {
  if (question == "order")
    return "no face is marked: what is wrong is less than 2^-20 of a face, which no picture shows";
  if (question == "see")
    return "no face is marked: the faces that it names are right, and shares of its picture are not";
  return "no face is marked: what is wrong is not about single faces";
}

/// Draws a wrong case, with the line that refutes the answer where one does, and tells of it.
void explain_case(const Judge_case& asked, const Report_verdict& verdict, report::Example& example) {
  judge::Query query = asked.query;
  judge::Grade grade;
  judge::Explanation why;
  Wrong_words words = words_of_wrong(query.question);
  try {
    if (!verdict.said.is_null()) {
      const judge::Answer answer = answer_of(query.question, asked.soup.face_count(), verdict.said);
      grade = judge::grade(judge::truth_of(asked.soup, query, {1, 20, true}), answer);
      if (grade.wrong()) why = judge::explain(asked.soup, query, answer, grade, judge::Contract::exact);
    } else if (!verdict.wrong_faces.is_null()) {
      take_wrong_faces(verdict.wrong_faces, query, grade, why, words);
      example.why = verdict.wrong_faces["words"].get<std::string>();
    }
    if (why.refutation) example.why = why.refutation->words;
    else if (example.why.empty() && !grade.wrong()) example.why = words_of_nothing_marked(example.who.question);
    example.picture = picture_of(asked.soup, query, grade, why, words);
    Polygon_soup named = asked.soup;
    named.file = example.file;
    example.view = view_of("report", example.who.question, named, query, grade, why, words);
  } catch (const std::exception&) {
    example.picture.clear();  // nothing to see: no point, or numbers beyond those of a picture
  }
}

}  // namespace

std::optional<report::Example> example_of(const report::Row& row, const Judge_case& asked,
                                          const Example_options& options) {
  const Witness witness(row, options);
  const Case_options as_programs_get_it{case_question(row.who.question), false, true};
  const auto case_of_smaller = [&](const generate::Posed_scene& smaller) {
    judge::Query query = asked.query;
    query.question = as_programs_get_it.question;
    query.eye = smaller.eye;
    query.source = smaller.source;
    return std::make_shared<const Judge_case>(case_of(smaller.soup, query, as_programs_get_it));
  };
  const bool repeats = repeats_a_point(asked.soup);
  Json name;
  Report_verdict last;
  const auto fails = [&](const generate::Posed_scene& smaller) {
    try {
      const std::shared_ptr<const Judge_case> other = case_of_smaller(smaller);
      if (!other->not_asked.empty() || !other->as_given || (!repeats && repeats_a_point(other->soup))) return false;
      const Report_verdict verdict = witness.ask(other, name);
      if (verdict.kind == Report_verdict::wrong) last = verdict;
      return verdict.kind == Report_verdict::wrong;
    } catch (const std::exception&) {
      return false;  // a scene that cannot be asked about
    }
  };

  // 1. Smaller, and rounder.
  generate::Posed_scene scene;
  scene.soup = asked.soup;
  scene.eye = asked.query.eye;
  scene.source = asked.query.source;
  if (!fails(scene)) return std::nullopt;
  harness::Reduce_options reduce;
  reduce.most_tests = options.tests;
  reduce.out_of_time = Time_limit(options.seconds).end();
  const harness::Reduced reduced = harness::reduce(scene, fails, reduce);
  const std::shared_ptr<const Judge_case> left = case_of_smaller(reduced.scene);

  // 2. What is told of it.
  report::Example example;
  example.who = row.who;
  example.family = row.family;
  example.distance = row.distance;
  example.size = row.size;
  example.seed = row.smallest->seed;
  example.faces_before = asked.soup.face_count();
  example.faces = left->soup.face_count();
  example.error = last.error;
  const std::string stem = stem_of(row.who);
  std::ostringstream text;
  write_scene(left->soup, text, Format::off);
  example.file = stem + ".off";
  example.scene = text.str();
  if (witness.asks_by_file()) example.query = judge::to_json(left->query).dump() + "\n";
  example.again = witness.again(*left, name, stem);
  explain_case(*left, last, example);
  return example;
}

}  // namespace sightline::app
