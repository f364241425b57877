#include <sightline/model_inside.h>
#include <sightline/told_text.h>

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/kernel/threads.h>

#include <array>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace sightline {
namespace {

std::vector<Polygon_soup> soups_of(const std::vector<Model>& models) {
  std::vector<Polygon_soup> soups;
  for (const Model& model : models) soups.push_back(model.soup());
  return soups;
}

}  // namespace

Combined combine(std::string_view operation, const std::vector<Model>& solids, std::string_view inside,
                 const Asking& asking) {
  Set_options options;
  options.progress = progress_within_budget(asking);
  const auto named = [](std::string_view word, auto& chosen, const auto& all) {
    std::string names;
    for (const auto one : all) {
      if (word == name(one)) {
        chosen = one;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(name(one));
    }
    throw std::invalid_argument('"' + std::string(word) + "\" is none of " + names);
  };
  using enum Set_operation;
  using enum Inside_rule;
  named(operation, options.operation, std::array{unite, intersect, subtract, differ});
  named(inside, options.inside, std::array{positive, nonzero, odd});
  const std::vector<Polygon_soup> soups = soups_of(solids);
  const Operands operands(soups);
  if (options.progress) options.progress(0, 1);
  if (const std::vector<Operand_flaw> wrong = flaws(operands); !wrong.empty())
    throw std::invalid_argument(
        "solid " + std::to_string(wrong[0].operand) + " bounds no solid: face " + std::to_string(wrong[0].face) +
        (wrong[0].why.empty() ? " has an edge without an opposite; close its surface" : " is " + wrong[0].why));
  Set_result result;
  run_with_threads(asking.threads, [&] { result = set_operation(operands, options); });
  const Rational volume = sightline::volume(result.soup);
  std::vector<std::pair<std::uint32_t, Face_id>> sources;
  for (const Result_face& face : result.faces) sources.emplace_back(face.operand, face.face);
  result.soup.file = std::string(operation);
  options.progress = {};
  options.keep_fragments = true;
  auto certify = [solids, options, threads = asking.threads](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress& steps) {
      const Operands again(soups_of(solids));
      Set_options told = options;
      told.progress = steps;
      run_with_threads(
          threads, [&] { write_solid_certificate(out, solid_certificate(again, told, set_operation(again, told))); });
    });
  };
  return {Answer(std::move(certify)), Model(std::make_shared<const Model::Inside>(std::move(result.soup))),
          std::move(sources), volume};
}

std::array<double, 2> Combined::area() const { return sightline::area(model.soup()); }

Checked verify(const std::vector<Model>& solids, const Model& result, const std::string& certificate,
               const Asking& asking) {
  const Solid_certificate claim = read_solid_certificate(certificate);
  Verify_options options;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  const Verdict verdict = verify_solids(soups_of(solids), claim, &result.soup(), options);
  return {verdict.accepted, verdict.why};
}

}  // namespace sightline
