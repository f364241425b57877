#include <sightline/algorithms/weak_visibility/along/certificate.h>

#include <sightline/algorithms/covering_of_scene.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sightline {

namespace {

/// All moments that are named, in order, each once.
std::vector<Quadratic_root> moments_of(const Visible_along& found) {
  std::vector<Quadratic_root> all{Quadratic_root(0), Quadratic_root(1)};
  const auto add = [&](const Parameter_range& range) { all.insert(all.end(), {range.low, range.high}); };
  for (const Along_proof& proof : found.proofs) add(proof.range);
  for (const Visible_along::Face& face : found.faces) {
    std::for_each(face.seen.begin(), face.seen.end(), add);
    for (const Rational& t : face.moments) all.push_back(moment(t));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// A root told apart by so many bits, if these are enough.
Path_moment told_apart(const Quadratic_root& t, unsigned long& bits) {
  if (const std::optional<Rational> root = t.rational()) return {{}, *root, *root};
  const Quadratic f = t.polynomial();
  for (;; bits *= 2) {
    const Integer k = t.bits(bits);
    Rational low(Integer(k - 1), Integer(1) << bits), high(Integer(k + 2), Integer(1) << bits);
    low.canonicalize();
    high.canonicalize();
    if (f.sign(low) * f.sign(high) < 0)
      return {{Rational(f.c[0]), Rational(f.c[1]), Rational(f.c[2])}, std::move(low), std::move(high)};
  }
}

/// Each with ends that are apart from those of the others.
std::vector<Path_moment> told_apart(const std::vector<Quadratic_root>& all) {
  std::vector<unsigned long> bits(all.size(), 16);
  std::vector<Path_moment> moments;
  for (std::size_t k = 0; k < all.size(); ++k) moments.push_back(told_apart(all[k], bits[k]));
  for (bool are_apart = false; !are_apart;) {
    are_apart = true;
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
      if (moments[k].high < moments[k + 1].low) continue;
      are_apart = false;
      for (const std::size_t i : {k, k + 1}) moments[i] = told_apart(all[i], bits[i] *= 2);
    }
  }
  return moments;
}

}  // namespace

Along_certificate along_certificate(const Scene& scene, const Visible_along& found, const Exact_point& from,
                                    const Exact_point& to, bool two_sided) {
  Along_certificate certificate;
  add_all(certificate, scene);
  certificate.from = from;
  certificate.to = to;
  certificate.two_sided = two_sided;
  const std::vector<Quadratic_root> moments = moments_of(found);
  certificate.moments = told_apart(moments);
  const auto place = [&](const Quadratic_root& t) {
    return static_cast<std::size_t>(std::lower_bound(moments.begin(), moments.end(), t) - moments.begin());
  };
  const auto places = [&](const Parameter_range& range) {
    return Along_certificate::Range{place(range.low), place(range.high)};
  };
  for (const Visible_along::Face& face : found.faces) {
    if (face.seen.empty() && face.moments.empty()) continue;
    auto& seen = certificate.faces.emplace_back(Along_certificate::Face{face.face, {}}).seen;
    for (const Parameter_range& range : face.seen) seen.push_back(places(range));
    for (const Rational& t : face.moments) seen.push_back(places({moment(t), moment(t)}));
  }
  for (const Along_proof& known : found.proofs) {
    certificate.proofs.push_back(known.proof);
    certificate.proofs.back().range = places(known.range);
  }
  return certificate;
}

}  // namespace sightline
