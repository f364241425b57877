// To be read after weak_lines.h and moments.h, from top to bottom: planes that the eye takes along, and cones of them;
// trees, which prove that a fragment is not seen; cones, which prove that one is; when faces are seen; and the check,
// step by step.

#include <sightline/algorithms/verify/along.h>

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/weak_lines.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace sightline {
namespace along_check {
namespace {

using namespace weak_check;

constexpr std::size_t most_sides = 1000;  // a cone with more of them is rejected

using Range = Along_certificate::Range;
using Side = Along_certificate::Side;
using Proof = Along_certificate::Proof;

// ---- Planes through the eye

/// A plane through the eye, linear in t: first + t change.
struct Moving_plane {
  Homogeneous first, change;
};
using Moving_cone = std::vector<Moving_plane>;  // of sides in order; two that follow each other meet in a ray

Homogeneous opposite(const Homogeneous& plane) {
  return {Integer(-plane[0]), Integer(-plane[1]), Integer(-plane[2]), Integer(-plane[3])};
}
Moving_plane turned(const Moving_plane& plane) { return {opposite(plane.first), opposite(plane.change)}; }

Integer_vector normal_of(const Homogeneous& plane) { return {plane[0], plane[1], plane[2]}; }

/// The side of a point: linear.
Polynomial height_of(const Moving_plane& plane, const Homogeneous& p) {
  return {height(plane.first, p), height(plane.change, p), Integer(0)};
}

/// Of the ray in which two sides meet, the side of a third: the determinant of their normals. Proof: P-127b
Polynomial side_of_ray(const Moving_plane& a, const Moving_plane& b, const Moving_plane& c) {
  const Integer_vector a0 = normal_of(a.first), b0 = normal_of(b.first), c0 = normal_of(c.first),
                       a1 = normal_of(a.change), b1 = normal_of(b.change), c1 = normal_of(c.change);
  const Integer_vector constant = cross(a0, b0), square = cross(a1, b1), one = cross(a0, b1), other = cross(a1, b0);
  return {dot(constant, c0), Integer(dot(constant, c1) + dot(one, c0) + dot(other, c0)),
          Integer(dot(square, c0) + dot(one, c1) + dot(other, c1))};
}

// ---- What is before one fragment

/// The path, and all fragments.
struct Setting {
  const Along_certificate& certificate;
  const Moments& moments;
  const std::vector<Outline>& fragments;
  std::array<Homogeneous, 2> eye;  // at 0 and at 1, the last coordinates equal

  /// The eye's side of a plane: linear.
  Polynomial eye_side(const Homogeneous& plane) const {
    const Integer at0 = height(plane, eye[0]);
    return {at0, Integer(height(plane, eye[1]) - at0), Integer(0)};
  }
  /// Positive inside of an edge, as seen from the front of its fragment.
  Moving_plane through(const Homogeneous& a, const Homogeneous& b) const {
    const auto line = line_through(a, b);
    Moving_plane plane{plane_through(line, eye[0]), plane_through(line, eye[1])};
    for (std::size_t k = 0; k < 4; ++k) plane.change[k] -= plane.first[k];
    return plane;
  }
};

/// One fragment from one of its sides in one range.
class View {
 public:
  View(const Setting& setting, std::size_t fragment, bool from_behind);

  /// Rejects unless the proof is right.
  void check(const Proof& proof, const std::string& what);

 private:
  struct Blocker {
    bool is_none = false;  // it is in the fragment's plane or behind it, the path is in its plane, or it is aside
    Polynomial eye_side;
    Moving_cone edges;  // positive inside, as seen from its front
    Moving_plane meet;  // with the fragment's plane: the sign there of the blocker's plane
    Corners in_front;   // of its corners and where its edges pass the fragment's plane, what is not behind
  };
  [[noreturn]] void refuse(const std::string& why) const { reject(what_ + ' ' + why, {fragment_}); }
  Moving_plane plane_of_side(const Side& side) const;
  const Blocker& blocker(std::size_t place);
  /// Whether it hides nothing all along the path, as the two ends tell. Proof: P-127d
  bool is_aside(const Outline& outline, const Blocker& blocker) const;
  std::optional<int> sign(const Polynomial& f) const { return setting_.moments.sign(range_.low, range_.high, f); }
  bool never_negative(const Polynomial& f) const { return setting_.moments.never_negative(range_.low, range_.high, f); }
  /// Whether all rays of a cone are on the closed positive side of a plane.
  bool holds_rays(const Moving_plane& plane, const Moving_cone& cone) const;
  void check_tree(const Proof& proof);
  std::pair<Moving_cone, Moving_cone> halves(const Moving_cone& cone, const Moving_plane& plane) const;
  void check_blocked(const Moving_cone& cone, std::size_t place);
  void check_cone(const Proof& proof);
  bool is_beside(const Moving_cone& cone, std::size_t place);

  const Setting& setting_;
  std::size_t fragment_;
  Homogeneous plane_;  // the eye in front
  Moving_cone whole_;
  std::unordered_map<std::size_t, Blocker> blockers_;  // those that were asked for
  Range range_;
  std::string what_;
};

View::View(const Setting& setting, std::size_t fragment, bool from_behind)
    : setting_(setting), fragment_(fragment), plane_(setting.fragments[fragment].plane) {
  const Corners& corners = setting.fragments[fragment].corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    whole_.push_back(setting.through(corners[i], corners[(i + 1) % corners.size()]));
  if (from_behind) {
    for (Moving_plane& side : whole_) side = turned(side);
    plane_ = opposite(plane_);
  } else {
    std::reverse(whole_.begin(), whole_.end());  // so that products of sides are rays to the fragment
  }
}

Moving_plane View::plane_of_side(const Side& side) const {
  const Outline& of = setting_.fragments[side.fragment];
  Moving_plane plane;
  if (side.kind == Side::Kind::edge) {
    const std::vector<Exact_point>& corners = setting_.certificate.fragments[side.fragment].vertices;
    plane =
        setting_.through(homogeneous(corners[side.corner]), homogeneous(corners[(side.corner + 1) % corners.size()]));
  } else {
    const Polynomial to = setting_.eye_side(plane_), its = setting_.eye_side(of.plane);
    for (std::size_t k = 0; k < 4; ++k) {
      plane.first[k] = to[0] * of.plane[k] - its[0] * plane_[k];
      plane.change[k] = to[1] * of.plane[k] - its[1] * plane_[k];
    }
  }
  return side.sign > 0 ? plane : turned(plane);
}

const View::Blocker& View::blocker(std::size_t place) {
  const auto [found, is_new] = blockers_.try_emplace(place);
  Blocker& known = found->second;
  if (!is_new) return known;
  const Outline& outline = setting_.fragments[place];
  known.eye_side = setting_.eye_side(outline.plane);
  known.in_front = cut(outline.corners, plane_);
  known.is_none = known.in_front.empty() || is_zero(known.eye_side) || is_aside(outline, known);
  if (known.is_none) return known;
  for (std::size_t i = 0; i < outline.corners.size(); ++i)
    known.edges.push_back(setting_.through(outline.corners[i], outline.corners[(i + 1) % outline.corners.size()]));
  known.meet = plane_of_side({Side::Kind::meet, place, 0, 1});
  return known;
}

bool View::is_aside(const Outline& outline, const Blocker& blocker) const {
  // 1. The path and the fragment are on one side of its plane.
  const int from = sgn(blocker.eye_side[0]), to = sgn(Integer(blocker.eye_side[0] + blocker.eye_side[1]));
  if (from * to >= 0 && !reaches(outline.plane, setting_.fragments[fragment_].corners, from + to > 0 ? -1 : 1))
    return true;
  // 2. It is beyond a side of the fragment.
  return std::any_of(whole_.begin(), whole_.end(), [&](const Moving_plane& side) {
    return std::all_of(blocker.in_front.begin(), blocker.in_front.end(), [&](const Homogeneous& p) {
      const Integer first = height(side.first, p);
      return sgn(first) <= 0 && sgn(Integer(first + height(side.change, p))) <= 0;
    });
  });
}

bool View::holds_rays(const Moving_plane& plane, const Moving_cone& cone) const {
  for (std::size_t i = 0; i < cone.size(); ++i)
    if (!never_negative(side_of_ray(cone[i], cone[(i + 1) % cone.size()], plane))) return false;
  return true;
}

void View::check(const Proof& proof, const std::string& what) {
  range_ = proof.range;
  what_ = what;
  if (const auto side = sign(setting_.eye_side(plane_)); !side || *side <= 0)
    refuse("is about a fragment that the eye is not in front of throughout");
  if (proof.cone.empty()) check_tree(proof);
  else check_cone(proof);
}

// ---- Hidden

/// Rejects unless each cone of the tree is behind its fragment. Proof: P-127c
void View::check_tree(const Proof& proof) {
  std::vector<Moving_cone> open{whole_};
  for (const Along_certificate::Node& node : proof.tree) {
    if (open.empty()) refuse("has nodes after its last leaf");
    const Moving_cone cone = std::move(open.back());
    open.pop_back();
    if (!node.is_cut) {
      check_blocked(cone, node.blocked);
      continue;
    }
    if (cone.size() >= most_sides) refuse("has a cone of too many sides");
    auto [first, second] = halves(cone, plane_of_side(node.cut));
    open.push_back(std::move(second));
    open.push_back(std::move(first));
  }
  if (!open.empty()) refuse("ends before its last leaf");
}

/// The two parts of a cone. Rejects unless rays are on both sides, and each where it is throughout. Proof: P-127b
std::pair<Moving_cone, Moving_cone> View::halves(const Moving_cone& cone, const Moving_plane& plane) const {
  const std::size_t n = cone.size();
  std::vector<int> signs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::optional<int> of_ray = sign(side_of_ray(cone[i], cone[(i + 1) % n], plane));
    if (!of_ray) refuse("has a cut that passes a ray of its cone within the range");
    signs.push_back(*of_ray);
  }
  const auto part = [&](int sense) {
    const auto is_kept = [&](std::size_t i) { return signs[i % n] == sense; };
    std::size_t i = 0;
    while (i < n && (!is_kept(i) || is_kept(i + n - 1))) ++i;  // the first ray that is kept
    if (i == n) refuse("has a cut with all of its cone on one side");
    Moving_cone kept{cone[i]};
    for (; is_kept(i); ++i) kept.push_back(cone[(i + 1) % n]);
    kept.push_back(sense > 0 ? plane : turned(plane));
    return kept;
  };
  return {part(1), part(-1)};
}

void View::check_blocked(const Moving_cone& cone, std::size_t place) {
  const Blocker& by = blocker(place);
  const auto refuse_leaf = [&](const char* why) { refuse("has a leaf that " + name("fragment", place) + why); };
  if (by.is_none) refuse_leaf(" does not hide: it is not before it, or its plane holds the path");
  const std::optional<int> eye = sign(by.eye_side);
  if (!eye || *eye == 0) refuse_leaf(" does not hide: the eye passes its plane");
  for (const Moving_plane& edge : by.edges)
    if (!holds_rays(*eye > 0 ? edge : turned(edge), cone)) refuse_leaf(" does not cover");
  if (!holds_rays(*eye > 0 ? turned(by.meet) : by.meet, cone)) refuse_leaf(" is not in front of");
}

// ---- Seen

/// Rejects unless the sides are those of a cone in which the fragment is first. Proof: P-127d
void View::check_cone(const Proof& proof) {
  Moving_cone cone;
  if (proof.cone.size() > most_sides) refuse("has a cone of too many sides");
  for (const Side& side : proof.cone) cone.push_back(plane_of_side(side));
  // 1. A cone, within that of the fragment.
  const std::size_t n = cone.size();
  if (n < 3) refuse("has a cone of less than three sides");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 2; k < n; ++k)
      if (sign(side_of_ray(cone[i], cone[(i + 1) % n], cone[(i + k) % n])) != 1)
        refuse("has sides that are not those of a cone in their order");
  for (const Moving_plane& side : whole_)
    if (!holds_rays(side, cone)) refuse("has a cone that is not within its fragment");
  // 2. Nothing is before it.
  for (std::size_t place = 0; place < setting_.fragments.size(); ++place)
    if (place != fragment_ && !is_beside(cone, place))
      refuse("has a cone that " + name("fragment", place) + " is not shown to be beside");
}

bool View::is_beside(const Moving_cone& cone, std::size_t place) {
  const Blocker& by = blocker(place);
  if (by.is_none) return true;
  const auto is_beyond = [&](const Moving_plane& side) {
    return std::all_of(by.in_front.begin(), by.in_front.end(),
                       [&](const Homogeneous& p) { return never_negative(negated(height_of(side, p))); });
  };
  if (std::any_of(whole_.begin(), whole_.end(), is_beyond) || std::any_of(cone.begin(), cone.end(), is_beyond))
    return true;
  const std::optional<int> eye = sign(by.eye_side);
  if (!eye) return false;
  if (*eye == 0) return true;  // at one moment: it is edge-on
  return holds_rays(*eye > 0 ? by.meet : turned(by.meet), cone) ||
         std::any_of(by.edges.begin(), by.edges.end(),
                     [&](const Moving_plane& edge) { return holds_rays(*eye > 0 ? turned(edge) : edge, cone); });
}

// ---- When faces are seen

/// Places in time: moment k is 2 k, what is between it and the next one 2 k + 1.
struct Places {
  std::size_t begin, end;
  explicit Places(const Range& range)
      : begin(range.low == range.high ? 2 * range.low : 2 * range.low + 1),
        end(range.low == range.high ? 2 * range.low + 1 : 2 * range.high) {}
};

/// Rejects unless the claims and proofs of one face are about all of the path, each right, and agree.
class Face_check {
 public:
  Face_check(const Setting& setting, const std::vector<bool>& contacts, Face_id face)
      : setting_(setting), contacts_(contacts), face_(face) {}
  void check(const std::vector<Range>& claims, const std::vector<std::size_t>& fragments,
             const std::vector<std::size_t>& proofs, std::size_t& nodes);

 private:
  void gather_times(const std::vector<Range>& claims, const std::vector<std::size_t>& proofs);
  /// Of the moments that the face's claims and proofs name.
  Range own(const Range& range) const {
    const auto place = [&](std::size_t k) {
      return static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), k) - times_.begin());
    };
    return {place(range.low), place(range.high)};
  }
  void mark(std::vector<bool>& places, const Range& range) const {
    const Places of(own(range));
    std::fill(places.begin() + static_cast<std::ptrdiff_t>(of.begin),
              places.begin() + static_cast<std::ptrdiff_t>(of.end), true);
  }
  /// Where the eye is not strictly in front of a fragment.
  void mark_away(std::vector<bool>& places, const Polynomial& eye_side) const;

  const Setting& setting_;
  const std::vector<bool>& contacts_;
  Face_id face_;
  std::vector<std::size_t> times_;
};

void Face_check::gather_times(const std::vector<Range>& claims, const std::vector<std::size_t>& proofs) {
  times_ = {0, setting_.moments.size() - 1};
  const auto add = [&](const Range& range) { times_.insert(times_.end(), {range.low, range.high}); };
  for (const Range& range : claims) add(range);
  for (const std::size_t k : proofs) add(setting_.certificate.proofs[k].range);
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

void Face_check::mark_away(std::vector<bool>& places, const Polynomial& eye_side) const {
  const Polynomial behind = negated(eye_side);
  for (std::size_t k = 0; k < times_.size(); ++k) {
    if (setting_.moments.never_negative(times_[k], times_[k], behind)) places[2 * k] = true;
    if (k + 1 < times_.size() && setting_.moments.never_negative(times_[k], times_[k + 1], behind))
      places[2 * k + 1] = true;
  }
}

void Face_check::check(const std::vector<Range>& claims, const std::vector<std::size_t>& fragments,
                       const std::vector<std::size_t>& proofs, std::size_t& nodes) {
  gather_times(claims, proofs);
  const std::size_t count = 2 * times_.size() - 1;
  std::vector<bool> claimed(count), seen(count);
  for (const Range& range : claims) {
    const Places of(own(range));
    for (std::size_t place = of.begin; place < of.end; ++place)
      if (claimed[place]) reject(name("face", face_) + " is said to be seen twice at once");
    mark(claimed, range);
  }
  // 1. The proofs of each fragment and each of its sides.
  std::vector<std::vector<bool>> hidden;
  for (const std::size_t fragment : fragments)
    for (const bool from_behind : {false, true}) {
      if (from_behind && !setting_.certificate.two_sided) continue;
      std::optional<View> view;  // where there is a proof
      std::vector<bool>& places = hidden.emplace_back(count);
      for (const std::size_t k : proofs) {
        const Proof& proof = setting_.certificate.proofs[k];
        if (proof.fragment != fragment || proof.from_behind != from_behind) continue;
        if (!view) view.emplace(setting_, fragment, from_behind);
        view->check(proof, name("proof", k));
        nodes += proof.tree.size() + proof.cone.size();
        mark(proof.cone.empty() ? places : seen, proof.range);
      }
      const Polynomial side = setting_.eye_side(setting_.fragments[fragment].plane);
      mark_away(places, from_behind ? negated(side) : side);
      // What is not seen beside a moment at which the eye is on nothing is not seen at it. Proof: P-127e
      for (std::size_t k = 0; k < times_.size(); ++k)
        if (!contacts_[times_[k]] && ((k > 0 && places[2 * k - 1]) || (2 * k + 1 < count && places[2 * k + 1])))
          places[2 * k] = true;
    }
  // 2. All of the path.
  for (std::size_t place = 0; place < count; ++place) {
    const std::string when = (place % 2 == 0 ? " at " : " after ") + name("moment", times_[place / 2]);
    if (claimed[place] && !seen[place]) reject(name("face", face_) + " is not shown to be seen" + when);
    if (claimed[place]) continue;
    for (std::size_t k = 0; k < hidden.size(); ++k)
      if (!hidden[k][place]) reject(name("face", face_) + " is neither said to be seen nor shown not to be" + when);
  }
}

// ---- The certificate

/// At which moments the eye is on a fragment whose plane does not hold the path.
std::vector<bool> contacts_of(const Setting& setting, const Exact_point& from, const Exact_point& to) {
  std::vector<bool> contacts(setting.moments.size());
  for (const Outline& outline : setting.fragments) {
    const Polynomial side = setting.eye_side(outline.plane);
    if (sgn(side[1]) == 0) continue;
    Rational t(Integer(-side[0]), side[1]);
    t.canonicalize();
    if (t < 0 || t > 1) continue;
    Exact_point eye;
    for (std::size_t k = 0; k < 3; ++k) eye[k] = from[k] + t * (to[k] - from[k]);
    if (crossing(line_through(outline.upwards(), homogeneous(eye)), outline.corners) < 0) continue;
    std::size_t low = 0, high = contacts.size();
    while (low < high) {  // the first moment that is not before
      const std::size_t middle = (low + high) / 2;
      if (setting.moments.compare(middle, t) < 0) low = middle + 1;
      else high = middle;
    }
    if (low < contacts.size() && setting.moments.compare(low, t) == 0) contacts[low] = true;
  }
  return contacts;
}

/// Rejects unless a range is of moments that there are, in order.
void check_range(const Range& range, std::size_t moments, const std::string& what) {
  if (range.low > range.high || range.high >= moments) reject(what + " has a range that is none of the moments");
}

/// Rejects unless what is named is there.
void check_places(const Along_certificate& certificate) {
  const std::size_t fragments = certificate.fragments.size(), moments = certificate.moments.size();
  for (const Along_certificate::Face& face : certificate.faces)
    for (const Range& range : face.seen) check_range(range, moments, name("face", face.face));
  for (std::size_t k = 0; k < certificate.proofs.size(); ++k) {
    const Proof& proof = certificate.proofs[k];
    const auto check_fragment = [&](std::size_t place) {
      if (place >= fragments) reject(name("proof", k) + " names " + name("fragment", place) + ", which there is not");
    };
    const auto check_side = [&](const Side& side) {
      check_fragment(side.fragment);
      if (side.kind == Side::Kind::edge && side.corner >= certificate.fragments[side.fragment].vertices.size())
        reject(name("proof", k) + " names a corner that " + name("fragment", side.fragment) + " has not");
      if (side.sign != 1 && side.sign != -1) reject(name("proof", k) + " has a side that is none");
    };
    check_fragment(proof.fragment);
    if (proof.from_behind && !certificate.two_sided) reject(name("proof", k) + " is of a back, which does not count");
    check_range(proof.range, moments, name("proof", k));
    for (const Side& side : proof.cone) check_side(side);
    if (proof.cone.empty() == proof.tree.empty()) reject(name("proof", k) + " has not either a cone or a tree");
    for (const Along_certificate::Node& node : proof.tree)
      if (node.is_cut) check_side(node.cut);
      else check_fragment(node.blocked);
  }
}

/// The certificate, step by step; throws a Rejection. Returns what was shown, in one line.
std::string check(const Polygon_soup& soup, const Along_certificate& certificate, const Verify_options& options) {
  // 1. The fragments are the scene; the path has a length; the moments are in order; what is named is there.
  const Workers workers(options, soup.face_count());
  const Covered covered = check_covering(soup, certificate, workers);
  std::vector<Outline> fragments;
  for (const Order_fragment& fragment : certificate.fragments) {
    workers.ask();
    fragments.emplace_back(fragment.vertices);
  }
  if (!canonical(certificate.from) || !canonical(certificate.to)) reject("the path is not in canonical numbers");
  if (certificate.from == certificate.to) reject("the path has no length");
  const Moments moments(certificate.moments);
  check_places(certificate);

  // 2. What belongs to which face.
  struct Of_face {
    std::vector<std::size_t> fragments, proofs;
    const std::vector<Range>* claims = nullptr;
  };
  static const std::vector<Range> nothing;
  std::vector<Of_face> faces(soup.face_count());
  for (std::size_t k = 0; k < fragments.size(); ++k) faces[certificate.fragments[k].face].fragments.push_back(k);
  for (std::size_t k = 0; k < certificate.proofs.size(); ++k)
    faces[certificate.fragments[certificate.proofs[k].fragment].face].proofs.push_back(k);
  for (const Along_certificate::Face& face : certificate.faces) {
    if (face.face >= faces.size() || faces[face.face].fragments.empty())
      reject("faces name face " + std::to_string(face.face) + ", which is not drawn");
    if (faces[face.face].claims != nullptr) reject(name("face", face.face) + " is listed twice");
    faces[face.face].claims = &face.seen;
  }

  // 3. What is said of each face is shown.
  Setting setting{certificate, moments, fragments, {homogeneous(certificate.from), homogeneous(certificate.to)}};
  const Integer from_w = setting.eye[0][3], to_w = setting.eye[1][3];
  for (Integer& x : setting.eye[0]) x *= to_w;
  for (Integer& x : setting.eye[1]) x *= from_w;
  const std::vector<bool> contacts = contacts_of(setting, certificate.from, certificate.to);
  std::atomic<std::size_t> steps = 0, seen = 0, drawn = 0;
  std::mutex mutex;
  std::size_t done = 0;
  for_each_below(faces.size(), 1, options.threads, [&](std::size_t f) {
    if (!faces[f].fragments.empty()) {
      std::size_t nodes = 0;
      const std::vector<Range>& claims = faces[f].claims == nullptr ? nothing : *faces[f].claims;
      Face_check(setting, contacts, static_cast<Face_id>(f)).check(claims, faces[f].fragments, faces[f].proofs, nodes);
      steps += nodes;
      drawn += 1;
      seen += claims.empty() ? 0 : 1;
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done, faces.size());
  });
  return std::to_string(seen) + " faces visible at some time on the way from " + exact_name(certificate.from) + " to " +
         exact_name(certificate.to) + ", " + std::to_string(drawn - seen) + " at none; " +
         std::to_string(certificate.proofs.size()) + " proofs of " + std::to_string(steps) + " nodes and sides; " +
         (certificate.two_sided ? "both sides" : "fronts") + " of faces; " + covered.text();
}

}  // namespace
}  // namespace along_check

Verdict verify_along(const Polygon_soup& soup, const Along_certificate& certificate, const Verify_options& options) {
  return certificate_check::verdict_of([&] { return along_check::check(soup, certificate, options); });
}

}  // namespace sightline
