#include <sightline/harness/laws/reduce.h>

#include <sightline/harness/generate/weak_draft.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace sightline::harness::reduce_detail {

Draft::Draft(const Posed_scene& scene) : eye(scene.eye), source(scene.source) {
  for (Face_id f = 0; f < scene.soup.face_count(); ++f) {
    auto& loops = faces.emplace_back();
    for (std::size_t k = 0; k < scene.soup.loop_count(f); ++k) {
      auto& loop = loops.emplace_back();
      for (const Point_id p : scene.soup.loop(f, k)) loop.push_back(scene.soup.point(p));
    }
  }
}

Posed_scene Draft::scene(const std::string& name) const {
  Posed_scene posed;
  posed.name = name;
  posed.eye = eye;
  posed.source = source;
  posed.soup.file = name;
  std::map<Exact_point, Point_id> known;
  for (const auto& loops : faces)
    for (std::size_t k = 0; k < loops.size(); ++k) {
      std::vector<Point_id> ids;
      for (const Exact_point& p : loops[k]) {
        const auto [place, is_new] = known.try_emplace(p, static_cast<Point_id>(known.size()));
        if (is_new) posed.soup.add_point(p[0], p[1], p[2]);
        ids.push_back(place->second);
      }
      if (k == 0) posed.soup.add_face(ids);
      else posed.soup.add_hole(ids);
    }
  return posed;
}

std::size_t length_of(const Rational& x) {
  return sgn(x) == 0 ? 0 : bit_length(x.get_num()) + 2 * bit_length(x.get_den()) - 1 + (sgn(x) < 0);
}

std::vector<Rational> rounder(const Rational& x) {
  std::vector<Rational> list{0};
  for (const unsigned bits : {0u, 1u, 2u, 4u, 8u, 16u, 32u}) {
    Rational scaled;
    mpq_mul_2exp(scaled.get_mpq_t(), x.get_mpq_t(), bits);
    Integer whole;
    const Integer above = 2 * scaled.get_num() + scaled.get_den(), below = 2 * scaled.get_den();
    mpz_fdiv_q(whole.get_mpz_t(), above.get_mpz_t(), below.get_mpz_t());
    Rational near(whole);
    mpq_div_2exp(near.get_mpq_t(), near.get_mpq_t(), bits);
    if (near == list.back()) continue;
    list.push_back(near);
  }
  if (sgn(x) < 0) list.push_back(Rational(-x));
  std::erase_if(list, [&](const Rational& y) { return length_of(y) >= length_of(x); });
  return list;
}

Reduced Reducer::run() {
  if (!still_fails(draft_)) {  // it depends on how points are shared, or on what is known of the scene
    result_.scene = given_;
    return result_;
  }
  bool again = true;
  while (again && !exhausted_) {
    const std::size_t before = result_.kept;
    remove_faces();
    remove_loops_and_corners();
    move_all();
    round_values();
    round_points();
    again = result_.kept > before;
  }
  result_.scene = draft_.scene(given_.name + ", reduced");
  result_.finished = !exhausted_;
  return result_;
}

bool Reducer::still_fails(const Draft& draft) {
  if (result_.tests >= options_.most_tests || has_run_out(options_.out_of_time)) exhausted_ = true;
  if (exhausted_) return false;
  ++result_.tests;
  return fails_(draft.scene(given_.name));
}

template <class Change>
bool Reducer::attempt(Change change) {
  Draft other = draft_;
  change(other);
  if (!still_fails(other)) return false;
  draft_ = std::move(other);
  ++result_.kept;
  if (options_.progress) options_.progress(result_.tests, draft_.faces.size());
  return true;
}

void Reducer::remove_faces() {
  for (std::size_t length = std::max<std::size_t>(1, draft_.faces.size() / 2); length > 0; length /= 2)
    for (std::size_t first = draft_.faces.size(); first > 0;) {
      first = first > length ? first - length : 0;
      if (first >= draft_.faces.size()) continue;
      attempt([&](Draft& draft) {
        const auto begin = draft.faces.begin() + static_cast<std::ptrdiff_t>(first);
        draft.faces.erase(begin, begin + static_cast<std::ptrdiff_t>(std::min(length, draft.faces.size() - first)));
      });
    }
}

void Reducer::remove_loops_and_corners() {
  for (std::size_t f = 0; f < draft_.faces.size(); ++f) {
    for (std::size_t k = draft_.faces[f].size(); k-- > 1;)
      attempt([&](Draft& draft) { draft.faces[f].erase(draft.faces[f].begin() + static_cast<std::ptrdiff_t>(k)); });
    for (std::size_t k = 0; k < draft_.faces[f].size(); ++k)
      for (std::size_t c = draft_.faces[f][k].size(); c-- > 0;)
        if (draft_.faces[f][k].size() > 3)
          attempt([&](Draft& draft) {
            draft.faces[f][k].erase(draft.faces[f][k].begin() + static_cast<std::ptrdiff_t>(c));
          });
  }
  for (std::size_t c = draft_.source.size(); c-- > 0;)
    if (draft_.source.size() > 3)
      attempt([&](Draft& draft) { draft.source.erase(draft.source.begin() + static_cast<std::ptrdiff_t>(c)); });
}

std::size_t Reducer::length() {
  std::size_t sum = 0;
  draft_.for_each_point([&](const Exact_point& p) {
    for (const Rational& x : p) sum += length_of(x);
  });
  return sum;
}

void Reducer::move_all() {
  const auto map_all = [&](auto map) {
    Draft other = draft_;
    other.for_each_point([&](Exact_point& p) { p = map(p); });
    std::swap(draft_, other);
    const std::size_t after = length();
    std::swap(draft_, other);
    if (after < length()) attempt([&](Draft& draft) { draft.for_each_point([&](Exact_point& p) { p = map(p); }); });
  };
  if (!draft_.faces.empty() && !draft_.faces[0].empty() && !draft_.faces[0][0].empty()) {
    const Exact_point corner = draft_.faces[0][0][0];
    map_all([&](const Exact_point& p) { return minus(p, corner); });
  }
  Integer denominator = 1, factor = 0;
  draft_.for_each_point([&](const Exact_point& p) {
    for (const Rational& x : p) denominator = lcm(denominator, x.get_den());
  });
  map_all([&](const Exact_point& p) { return generate::along({0, 0, 0}, Rational(denominator), p); });
  draft_.for_each_point([&](const Exact_point& p) {
    for (const Rational& x : p) factor = gcd(factor, x.get_num());
  });
  if (factor > 1)
    map_all([&](const Exact_point& p) { return generate::along({0, 0, 0}, Rational(Integer(1), factor), p); });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::map<Rational, long> rank;
    draft_.for_each_point([&](const Exact_point& p) { rank[p[axis]] = 0; });
    long next = 0;
    for (auto& entry : rank) entry.second = next++;
    map_all([&](Exact_point p) {
      p[axis] = rank.at(p[axis]);
      return p;
    });
  }
}

void Reducer::round_values() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::set<Rational> values;
    draft_.for_each_point([&](const Exact_point& p) { values.insert(p[axis]); });
    for (const Rational& value : values)
      for (const Rational& other : rounder(value)) {
        const auto replace = [&](Draft& draft) {
          draft.for_each_point([&](Exact_point& p) {
            if (p[axis] == value) p[axis] = other;
          });
        };
        if (attempt(replace)) break;
      }
  }
}

void Reducer::round_points() {
  std::set<Exact_point> places;
  draft_.for_each_point([&](const Exact_point& p) { places.insert(p); });
  for (Exact_point place : places)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const Rational& other : rounder(place[axis])) {
        Exact_point moved = place;
        moved[axis] = other;
        const auto move = [&](Draft& draft) {
          draft.for_each_point([&](Exact_point& p) {
            if (p == place) p = moved;
          });
        };
        if (attempt(move)) {
          place = moved;
          break;
        }
      }
}

}  // namespace sightline::harness::reduce_detail
