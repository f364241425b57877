#include <sightline/harness/laws/solid_proof.h>

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

namespace sightline::harness {

using generate::Random;

namespace {

using Loop = std::vector<Exact_point>;
using Directed_edge = std::pair<Exact_point, Exact_point>;

std::vector<Directed_edge> edges_around(const Loop& loop) {
  std::vector<Directed_edge> edges;
  for (std::size_t k = 0; k < loop.size(); ++k) edges.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
  return edges;
}

/// One loop around two polygons in one plane that lie along common edges; empty where that is not convex.
Loop joined(const Loop& one, const Loop& other) {
  // 1. What they do not have in common.
  const std::vector<Directed_edge> own = edges_around(one);
  std::set<Directed_edge> edges(own.begin(), own.end());
  for (const auto& [p, q] : edges_around(other))
    if (edges.erase({q, p}) == 0) edges.emplace(p, q);
  const std::map<Exact_point, Exact_point> next(edges.begin(), edges.end());
  if (next.size() != edges.size()) return {};  // a corner twice
  // 2. Once around.
  Loop loop{next.begin()->first};
  for (auto at = next.begin()->second; at != loop[0]; at = next.at(at)) loop.push_back(at);
  if (loop.size() != edges.size()) return {};
  const Flat_face around(loop);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Exact_point &p = loop[k], &q = loop[(k + 1) % loop.size()], &r = loop[(k + 2) % loop.size()];
    if (dot(around.normal, cross(minus(q, p), minus(r, q))) < 0) return {};
  }
  return loop;
}

struct Neighbours {
  std::size_t one, other;
};

/// Fragments of the same faces on both sides of an edge of both, around which solids wind otherwise; each pair twice.
std::vector<Neighbours> different_neighbours(const std::vector<Solid_certificate::Fragment>& fragments) {
  const auto faces_of = [&](std::size_t i) {
    std::set<std::tuple<std::uint32_t, Face_id, std::uint32_t, bool>> faces;
    for (const Solid_certificate::Part& part : fragments[i].parts)
      faces.emplace(part.operand, part.face, part.piece, part.turned);
    return faces;
  };
  std::multimap<Directed_edge, std::size_t> along;
  for (std::size_t i = 0; i < fragments.size(); ++i)
    for (Directed_edge& edge : edges_around(fragments[i].vertices)) along.emplace(std::move(edge), i);
  std::set<std::pair<std::size_t, std::size_t>> known;
  std::vector<Neighbours> found;
  for (const auto& [edge, i] : along) {
    const auto [begin, end] = along.equal_range({edge.second, edge.first});
    for (auto at = begin; at != end; ++at)
      if (const std::size_t j = at->second; fragments[i].front != fragments[j].front && faces_of(i) == faces_of(j))
        if (known.emplace(i, j).second) found.push_back({i, j});
  }
  return found;
}

/// Makes two neighbours one, with what is said of the one; nothing where no two are convex together.
bool join_any(std::vector<Solid_certificate::Fragment>& fragments, Random& random) {
  std::vector<Neighbours> pairs = different_neighbours(fragments);
  random.shuffle(pairs);
  for (const auto& [one, other] : pairs) {
    Loop around = joined(fragments[one].vertices, fragments[other].vertices);
    if (around.empty()) continue;
    fragments[one].vertices = std::move(around);
    fragments.erase(fragments.begin() + static_cast<std::ptrdiff_t>(other));
    return true;
  }
  return false;
}

/// Says of one fragment what is so of its neighbour; nothing where there are none.
bool copy_any(std::vector<Solid_certificate::Fragment>& fragments, Random& random) {
  const std::vector<Neighbours> pairs = different_neighbours(fragments);
  if (pairs.empty()) return false;
  const auto& [one, other] = pairs[random.below(pairs.size())];
  fragments[one].front = fragments[other].front;
  fragments[one].fate = fragments[other].fate;
  return true;
}

/// Makes two of a fragment that several faces have, one upon the other, each with a part; nothing where there is none.
bool part_any(std::vector<Solid_certificate::Fragment>& fragments, Random& random) {
  std::vector<std::size_t> several;
  for (std::size_t i = 0; i < fragments.size(); ++i)
    if (fragments[i].parts.size() > 1) several.push_back(i);
  if (several.empty()) return false;
  Solid_certificate::Fragment& one = fragments[several[random.below(several.size())]];
  Solid_certificate::Fragment other = one;
  other.parts = {one.parts.back()};
  one.parts.pop_back();
  fragments.push_back(std::move(other));
  return true;
}

std::string claim_text(const Solid_certificate& certificate) {
  std::ostringstream out;
  write_solid_certificate(out, certificate);
  return out.str();
}

}  // namespace

std::string flaw_of_certificate(const std::vector<Polygon_soup>& given, Random& random) {
  std::vector<Polygon_soup> solids = given;
  Set_options options;
  options.operation = set_operations[random.below(4)];
  const bool is_all_dropped = random.chance(1, 3);
  if (is_all_dropped) {
    solids.emplace_back();
    options.operation = Set_operation::intersect;
  }
  options.inside = inside_rules[random.below(3)];
  options.keep_fragments = true;
  const Operands operands(solids);
  const Set_result result = set_operation(operands, options);
  const std::string text = claim_text(solid_certificate(operands, options, result));
  Solid_certificate claim = read_solid_certificate(text);
  if (claim_text(claim) != text) return "a certificate that is read is another one when it is written";
  Verify_options verifying;
  verifying.threads = 1;
  const Hole_free flat = without_holes(result.soup);
  const Verdict verdict = verify_solids(solids, claim, &flat.soup, verifying);
  if (!verdict.accepted) return "the certificate is rejected: " + verdict.why;
  // Forged: another thing that would mean something else.
  if (claim.fragments.empty()) return {};
  const std::size_t i = random.below(claim.fragments.size());
  Solid_certificate::Fragment& fragment = claim.fragments[i];
  std::string how;
  switch (is_all_dropped ? random.between(8, 9) : random.between(0, 10)) {
    case 0:
      how = "another fate";
      fragment.fate = static_cast<Solid_certificate::Fate>((static_cast<std::size_t>(fragment.fate) + 1) % 3);
      break;
    case 1:
      how = "another winding number";
      if (fragment.front.empty()) fragment.front.emplace_back(0, 1);
      else fragment.front.back().second += fragment.front.back().second == -1 ? 2 : 1;
      break;
    case 2:
      how = "a fragment left out";
      claim.fragments.erase(claim.fragments.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    case 3:
      how = "a fragment twice";
      claim.fragments.push_back(claim.fragments[i]);
      break;
    case 4:
      how = "a part left out";
      fragment.parts.pop_back();
      break;
    case 5:
      how = "a corner elsewhere";
      fragment.vertices[random.below(fragment.vertices.size())][random.below(3)] += Rational(1, 1024);
      break;
    case 6:
      how = "all of them dropped";
      if (result.soup.face_count() == 0) return {};
      for (Solid_certificate::Fragment& one : claim.fragments) one.fate = Solid_certificate::Fate::dropped;
      break;
    case 7:
      how = "turned round";
      std::reverse(fragment.vertices.begin(), fragment.vertices.end());
      break;
    case 8:
      how = "two fragments joined to one";
      if (!join_any(claim.fragments, random)) return {};
      break;
    case 9:
      how = "what is so of a neighbour";
      if (!copy_any(claim.fragments, random)) return {};
      break;
    default:
      how = "a fragment of two faces as two";
      if (!part_any(claim.fragments, random)) return {};
  }
  if (verify_solids(solids, claim, nullptr, verifying).accepted) return "a forged certificate is accepted: " + how;
  return {};
}

}  // namespace sightline::harness
