// What judges Python's functions: scenes of families, the exact truth about them, and laws.

#include "bindings.h"

#include <sightline/harness/judge/case.h>
#include <sightline/harness/judge/explain.h>
#include <sightline/harness/judge/guess.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/reduce.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace sightline::python {

namespace {

using judge::Case;
using judge::Case_options;
using judge::Contract;
using judge::Question;
using judge::Truth;

template <std::size_t n>
std::size_t place_of(const std::string& name, const std::array<std::string_view, n>& names, const std::string& what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string all;
  for (const std::string_view one : names) all += (all.empty() ? "" : ", ") + std::string(one);
  throw py::value_error(what + " is one of " + all + ", not " + sightline::quoted(name));
}
Question question_of(const std::string& name) {
  return static_cast<Question>(place_of(name, judge::question_names, "query"));
}
Contract contract_of(const std::string& name) {
  return static_cast<Contract>(place_of(name, judge::contract_names, "contract"));
}

/// Passes through what catches errors of the standard library: what Python raised to end everything.
struct Interrupted {
  std::exception_ptr raised;
};
void check_signals() {
  if (PyErr_CheckSignals() != 0) {
    try {
      throw py::error_already_set();
    } catch (...) {
      throw Interrupted{std::current_exception()};
    }
  }
}

std::function<bool()> end_after(double seconds) {
  return [watch = Stopwatch(), seconds] {
    check_signals();
    return watch.seconds() >= seconds;
  };
}

/// Runs what may be interrupted.
template <class Work>
auto interruptible(Work work) {
  try {
    return work();
  } catch (const Interrupted& interrupted) {
    std::rethrow_exception(interrupted.raised);
  }
}

// ---- Points of a query

py::list fractions(const std::vector<Exact_point>& points) {
  py::list all;
  for (const Exact_point& p : points) all.append(python::fractions(p));
  return all;
}

/// What is asked, as a function gets it: the eye, (3,), the source, (k, 3), the rays, (r, 2, 3), or the operation and
/// how many faces are the first solid's.
py::object looker_of(const judge::Query& query, bool exact) {
  if (query.question == Question::boolean) return py::make_tuple(name(query.operation), query.first);
  if (query.question == Question::trace) {
    std::vector<Exact_point> ends;
    for (const Exact_ray& ray : query.rays) ends.insert(ends.end(), {ray.origin, ray.direction});
    if (!exact) return rounded(ends).attr("reshape")(-1, 2, 3);
    py::list rays;
    for (const Exact_ray& ray : query.rays) rays.append(fractions({ray.origin, ray.direction}));
    return rays;
  }
  const bool is_weak = query.question == Question::weak;
  if (exact) return is_weak ? py::object(fractions(query.source)) : py::object(python::fractions(query.eye));
  if (is_weak) return rounded(query.source);
  return rounded({query.eye}).attr("reshape")(3);
}

// ---- Families

py::list families() {
  py::list all;
  for (const generate::Family& family : generate::families())
    all.append(py::make_tuple(family.name, family.what, family.size_means, family.small_size, family.holes));
  return all;
}

generate::Family_parameters parameters_of(std::uint64_t seed, std::size_t size, std::int64_t ulps) {
  generate::Family_parameters parameters;
  parameters.seed = seed;
  parameters.size = size;
  parameters.ulps = ulps;
  return parameters;
}

py::tuple posed(const std::string& name, std::uint64_t seed, std::size_t size, std::int64_t ulps,
                const py::object& offset, const py::object& scale) {
  generate::Family_parameters parameters = parameters_of(seed, size, ulps);
  parameters.offset = point_of(offset, "offset");
  parameters.scale = rational_of(scale, "scale");
  if (sgn(parameters.scale) <= 0) throw py::value_error("scale has to be above 0");
  const generate::Family& family = generate::family(name);
  const auto [scene, model] = answer_to(plain_question(), [&family, parameters](const Asking&) {  // families stay
    generate::Posed_scene made = family.make(parameters);
    made.soup.file = made.name;
    Model of_soup(std::move(made.soup));
    return std::pair(std::move(made), std::move(of_soup));
  });
  return py::make_tuple(model, python::fractions(scene.eye), fractions(scene.source), ids(scene.visible),
                        ids(scene.hidden), scene.first);
}

// ---- A case

Case make_case(const std::string& family, std::uint64_t seed, std::size_t size, std::int64_t ulps,
               const Case_options& options) {
  const generate::Family& of = generate::family(family);
  const py::gil_scoped_release released;
  return judge::case_of(of, parameters_of(seed, size > 0 ? size : of.small_size, ulps), options);
}

Truth truth_of(const Case& asked, bool cycles, const python::Question& question) {
  return answer_to(question, [asked, cycles](const Asking& asking) {
    judge::Truth_options options;
    options.threads = asking.threads;
    options.cycles = cycles;
    if (asking.budget > 0) options.seconds = asking.budget;
    return judge::truth_of(asked.soup, asked.query, options);
  });
}

/// An answer as the protocol has it, graded: its mark, whether it breaks the contract, and which faces are wrong.
struct Graded {
  judge::Answer answer;
  judge::Grade grade;
  judge::Mark mark;
};

Graded graded(const Case& asked, const Truth& truth, const std::string& text) {
  Graded found;
  found.answer = judge::read_answer(text, asked.query.question, asked.soup.face_count(), asked.query.rays.size());
  found.grade = judge::grade(truth, found.answer);
  found.mark = judge::mark_of(found.grade);
  return found;
}

/// Words for people: the line that refutes the answer, the share that is wrong, and other ways to read the question
/// under which it is right.
py::dict explained(const Case& asked, const Graded& graded, const std::string& contract, bool cycles) {
  judge::Truth_options options;
  options.cycles = cycles;
  judge::Explanation why;
  std::vector<std::string> guesses;
  {
    const py::gil_scoped_release released;
    why = judge::explain(asked.soup, asked.query, graded.answer, graded.grade, contract_of(contract));
    if (judge::lists_faces(graded.answer))
      for (const judge::Reading reading : judge::readings_of(asked.query.question))
        if (judge::is_right(reading, asked.soup, asked.query, graded.answer, options))
          guesses.push_back("the answer is right read otherwise, " + judge::words_of(reading, asked.query.two_sided));
  }
  py::dict words;
  words["line"] = why.refutation ? py::object(py::str(why.refutation->words)) : py::object(py::none());
  words["share"] = why.share;
  words["share_words"] = why.share_words;
  words["segment"] =
      why.refutation
          ? py::object(py::make_tuple(python::fractions(why.refutation->from), python::fractions(why.refutation->to)))
          : py::object(py::none());
  py::list readings;
  for (const std::string& guess : guesses) readings.append(guess);
  words["guesses"] = readings;
  return words;
}

/// A case made smaller as long as `fails` says so.
Case reduced(const Case& asked, const Case_options& options, const py::function& fails, double seconds) {
  const auto of = [&](const generate::Posed_scene& scene) {
    judge::Query query = asked.query;
    query.eye = scene.eye;
    query.source = scene.source;
    return judge::case_of(scene.soup, query, options);
  };
  generate::Posed_scene scene;
  scene.soup = asked.soup;
  scene.eye = asked.query.eye;
  scene.source = asked.query.source;
  harness::Reduce_options limits;
  limits.most_tests = 1000000;
  limits.out_of_time = end_after(seconds);
  const auto still_fails = [&](const generate::Posed_scene& smaller) {
    const Case other = of(smaller);
    if (!other.not_asked.empty() || !other.as_given) return false;
    try {
      return py::cast<bool>(fails(other));
    } catch (py::error_already_set&) {
      throw Interrupted{std::current_exception()};
    }
  };
  return interruptible([&] { return of(harness::reduce(scene, still_fails, limits).scene); });
}

// ---- Laws

/// A face that is shown although hidden, or the other way round, in words.
std::string words_of(const judge::Grade& grade) {
  return grade.wrong_visible.empty() ? harness::face_name(grade.wrong_hidden.at(0)) + " is left out but visible"
                                     : harness::face_name(grade.wrong_visible.at(0)) + " is shown but hidden";
}

/// A Python function as a subject of the laws: `ask(case)` gives its answer as the protocol has it.
class Function_subject {
 public:
  Function_subject(py::function ask, const Case_options& options) : ask_(std::move(ask)), options_(options) {}

  harness::Subject subject() {
    harness::Subject subject;
    subject.name = judge::question_names[static_cast<std::size_t>(options_.question)];
    subject.what = "a Python function";
    subject.wants_source = options_.question == Question::weak;
    subject.answer = [this](const generate::Posed_scene& scene) { return labels(of(scene), true); };
    harness::add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "mirror", "cut", "bystander"});
    for (harness::Check& check : subject.checks)
      check.run = [this, run = check.run](const generate::Posed_scene& scene, const harness::Answer& answer,
                                          harness::Random& random) {
        const Case asked = of(scene);
        if (!asked.not_asked.empty()) return harness::Outcome::not_applicable();
        generate::Posed_scene prepared;
        prepared.soup = asked.soup;
        prepared.eye = asked.query.eye;
        prepared.source = asked.query.source;
        try {
          return run(prepared, answer, random);
        } catch (const Not_asked&) {
          return harness::Outcome::not_applicable();
        }
      };
    subject.checks.insert(subject.checks.begin(),
                          {"exact", "the exact answer",
                           [this](const generate::Posed_scene& scene, const harness::Answer& answer, harness::Random&) {
                             return against_truth(of(scene), answer);
                           }});
    subject.answer = [this](const generate::Posed_scene& scene) {
      const Case asked = of(scene);
      return asked.not_asked.empty() ? labels(asked, false) : harness::Answer();
    };
    return subject;
  }

  Case of(const generate::Posed_scene& scene) const {
    Case asked = judge::case_of(scene.soup, {options_.question, scene.eye, scene.source, options_.two_sided}, options_);
    if (options_.question == Question::weak && asked.query.source.size() < 3)
      asked.not_asked = "rounded to doubles, the source has no area";
    return asked;
  }

 private:
  struct Not_asked {};  // an image that doubles cannot hold

  harness::Answer labels(const Case& asked, bool only_as_given) const {
    check_signals();
    if (only_as_given && (!asked.not_asked.empty() || !asked.as_given)) throw Not_asked();
    std::string text;
    try {
      text = py::cast<std::string>(ask_(asked));
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_Exception)) throw Interrupted{std::current_exception()};
      throw std::runtime_error(std::string(py::str(error.type().attr("__name__"))) + ": " +
                               std::string(py::str(error.value())));
    }
    const judge::Answer said = judge::read_answer(text, options_.question, asked.soup.face_count());
    harness::Answer answer;
    answer.labels.assign(asked.soup.face_count(), harness::Answer::none);
    const Scene scene(asked.soup);
    for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
    for (const Face_id face : said.visible)
      if (answer.labels[face] != harness::Answer::none) answer.labels[face] = 1;
    for (const Face_id face : said.abstained) answer.labels[face] = harness::Answer::none;
    answer.undecided = said.abstained.size();
    return answer;
  }

  static harness::Outcome against_truth(const Case& asked, const harness::Answer& answer) {
    if (!asked.not_asked.empty()) return harness::Outcome::not_applicable();
    const Truth truth = judge::truth_of(asked.soup, asked.query);
    if (!truth.not_asked.empty()) return harness::Outcome::not_applicable();
    judge::Answer said;
    for (Face_id face = 0; face < answer.labels.size(); ++face) {
      if (answer.labels[face] == 1) said.visible.push_back(face);
      if (answer.labels[face] == harness::Answer::none) said.abstained.push_back(face);
    }
    const judge::Grade grade = judge::grade(truth, said);
    return grade.wrong() ? harness::Outcome::failed(words_of(grade)) : harness::Outcome{};
  }

  py::function ask_;
  Case_options options_;
};

py::dict fuzzed(const py::function& ask, const Case_options& options, std::uint64_t seed, std::size_t scenes,
                double seconds, const std::string& family, std::size_t most_faces, double reduce) {
  if (options.question != Question::see && options.question != Question::weak)
    throw py::value_error(
        "fuzz asks see or weak, of which laws say what follows; judge() grades orders, rays and solids, too");
  Function_subject function(ask, options);
  const harness::Subject subject = function.subject();
  harness::Fuzz_options limits;
  limits.seed = seed;
  limits.scenes = scenes;
  limits.family = family;
  limits.most_faces = most_faces;
  limits.out_of_time = [over = end_after(seconds), scenes] { return over() && scenes == 0; };
  harness::Fuzz_summary summary;
  const auto finding = interruptible([&] { return harness::fuzz(subject, limits, summary); });
  py::dict result, checks;
  for (const auto& [name, tally] : summary.by_check)
    if (name != "certificate")
      checks[py::str(name)] = py::make_tuple(tally.passed, tally.undecided, tally.not_applicable);
  result["scenes"] = summary.scenes;
  result["checks"] = checks;
  result["finding"] = py::none();
  if (!finding) return result;
  generate::Posed_scene smallest = finding->scene;
  if (reduce > 0) {
    harness::Reduce_options reduce_limits;
    reduce_limits.out_of_time = end_after(reduce);
    smallest = interruptible([&] {
      return harness::reduce(subject, finding->scene, finding->which.parameters.seed, finding->disagreement,
                             reduce_limits)
          .scene;
    });
  }
  const auto last = interruptible([&] {
    return harness::first_disagreement(subject, smallest, finding->which.parameters.seed, finding->disagreement.check);
  });
  result["finding"] = py::make_tuple(harness::to_string(finding->which), finding->disagreement.check,
                                     last ? last->what : finding->disagreement.what, function.of(smallest));
  return result;
}

}  // namespace

void add_harness(py::module_& module) {
  py::class_<Case_options>(module, "CaseOptions")
      .def(py::init([](const std::string& query, bool two_sided, bool exact, bool triangles) {
             return Case_options{question_of(query), two_sided, !exact, triangles};
           }),
           py::arg("query"), py::arg("two_sided"), py::arg("exact"), py::arg("triangles"));

  py::class_<Case>(module, "Case")
      .def_property_readonly("not_asked", [](const Case& asked) { return asked.not_asked; })
      .def_property_readonly("face_count", [](const Case& asked) { return asked.soup.face_count(); })
      .def(
          "points", [](const Case& asked, bool exact) { return points_of(asked.soup, exact); }, py::arg("exact"))
      .def("faces", [](const Case& asked) { return faces_of(asked.soup); })
      .def(
          "looker", [](const Case& asked, bool exact) { return looker_of(asked.query, exact); }, py::arg("exact"))
      .def("query", [](const Case& asked) { return judge::to_json(asked.query).dump(); })
      .def("model", [](const Case& asked) { return Model(asked.soup); });

  py::class_<Truth>(module, "Truth")
      .def_property_readonly("not_asked", [](const Truth& truth) { return truth.not_asked; })
      .def_property_readonly("visible", [](const Truth& truth) { return ids(truth.visible); })
      .def_property_readonly("hidden", [](const Truth& truth) { return ids(truth.hidden); });

  py::class_<Graded>(module, "Graded")
      .def_property_readonly(
          "mark",
          [](const Graded& graded) { return std::string(judge::mark_names[static_cast<std::size_t>(graded.mark)]); })
      .def_property_readonly("wrong_visible", [](const Graded& graded) { return ids(graded.grade.wrong_visible); })
      .def_property_readonly("wrong_hidden", [](const Graded& graded) { return ids(graded.grade.wrong_hidden); })
      .def_property_readonly(
          "errors",
          [](const Graded& graded) { return py::make_tuple(graded.grade.volume_error, graded.grade.area_error); })
      .def_property_readonly("judged", [](const Graded& graded) { return graded.grade.judged; })
      .def(
          "breaks",
          [](const Graded& graded, const std::string& contract) {
            return judge::breaks(contract_of(contract), graded.mark, graded.grade);
          },
          py::arg("contract"));

  module.def("families", &families);
  module.def("generate", &posed, py::arg("family"), py::arg("seed"), py::arg("size"), py::arg("ulps"),
             py::arg("offset"), py::arg("scale"));
  module.def("case_of", &make_case, py::arg("family"), py::arg("seed"), py::arg("size"), py::arg("ulps"),
             py::arg("options"));
  module.def(
      "check_contract", [](const std::string& contract) { contract_of(contract); }, py::arg("contract"));
  module.def("truth_of", &truth_of, py::arg("case"), py::arg("cycles"), py::arg("question"));
  module.def("graded", &graded, py::arg("case"), py::arg("truth"), py::arg("answer"));
  module.def("explained", &explained, py::arg("case"), py::arg("graded"), py::arg("contract"), py::arg("cycles"));
  module.def("reduced", &reduced, py::arg("case"), py::arg("options"), py::arg("fails"), py::arg("seconds"));
  module.def("fuzzed", &fuzzed, py::arg("ask"), py::arg("options"), py::arg("seed"), py::arg("scenes"),
             py::arg("seconds"), py::arg("family"), py::arg("most_faces"), py::arg("reduce"));
}

}  // namespace sightline::python
