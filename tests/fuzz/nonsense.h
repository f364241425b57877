#pragma once
// Certificates with nonsense in them: a place in a list where the list ends, a number that is not in lowest terms, a
// list that ends too early or goes on, what there is but cannot be. No checker may accept any of what it goes by; rays
// and lines count that something refers to.

#include "certificate.h"
#include "support.h"

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/kernel/vectors.h>

#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace fuzz {

/// Where nonsense may be put, of a certificate: each says it when it is called.
class Nonsense {
 public:
  /// The place `at` of a list of so many entries.
  template <class Place>
  void place(const char* what, Place& at, std::size_t count) {
    ways_.emplace_back(what, [&at, count](Bytes& bytes) {
      const std::size_t past = bytes.below(3);
      at = past == 2 ? static_cast<Place>(~Place{0} - bytes.below(2)) : static_cast<Place>(count + past);
    });
  }
  void number(const char* what, Rational& r) {
    ways_.emplace_back(what, [&r](Bytes& bytes) {
      const unsigned long factor = 2 + static_cast<unsigned long>(bytes.below(2));
      mpz_mul_ui(mpq_numref(r.get_mpq_t()), mpq_numref(r.get_mpq_t()), factor);
      mpz_mul_ui(mpq_denref(r.get_mpq_t()), mpq_denref(r.get_mpq_t()), factor);
    });
  }
  template <std::size_t n>
  void numbers(const char* what, std::array<Rational, n>& all) {
    for (Rational& r : all) number(what, r);
  }
  void points(const char* what, std::vector<Exact_point>& all) {
    for (Exact_point& p : all) numbers(what, p);
  }

  /// Nothing where something must be.
  template <class List>
  void emptied(const char* what, List& all) {
    if (!all.empty()) way(what, [&all](Bytes&) { all.clear(); });
  }
  /// A proof without its end, or with more behind it.
  template <class List>
  void ended(const char* what, List& all) {
    if (all.empty()) return;
    way(what, [&all](Bytes& bytes) {
      if (bytes.below(2) == 0) all.pop_back();
      else all.push_back(all.back());
    });
  }
  void way(const char* what, std::function<void(Bytes&)> say) { ways_.emplace_back(what, std::move(say)); }

  /// Says where; empty: nowhere. What a certificate has one of is taken as often as what it has thousands of.
  std::string tell(Bytes& bytes) const {
    std::map<std::string, std::vector<std::size_t>> by_name;
    for (std::size_t k = 0; k < ways_.size(); ++k) by_name[ways_[k].first].push_back(k);
    if (by_name.empty()) return {};
    const auto& [name, own] = *std::next(by_name.begin(), static_cast<std::ptrdiff_t>(bytes.word() % by_name.size()));
    ways_[own[bytes.word() % own.size()]].second(bytes);
    return name;
  }

 private:
  std::vector<std::pair<const char*, std::function<void(Bytes&)>>> ways_;
};

inline void add_of_scene(Nonsense& nonsense, Covering& claim, std::size_t faces) {
  for (Order_fragment& fragment : claim.fragments) {
    nonsense.place("fragment.face", fragment.face, faces);
    nonsense.points("fragment.vertices", fragment.vertices);
    nonsense.emptied("fragment.vertices", fragment.vertices);
  }
  for (Covering::Piece& piece : claim.pieces) {
    nonsense.place("piece.face", piece.face, faces);
    nonsense.points("piece.vertices", piece.vertices);
  }
  for (Covering::Set_aside& entry : claim.set_aside) {
    if (entry.why.starts_with("zero area") && !claim.fragments.empty())
      nonsense.way("a face without area in pieces", [&claim, face = entry.face](Bytes& bytes) {
        claim.pieces.push_back(
            {face, 0,
             claim.fragments[bytes.below(claim.fragments.size() % 256 + 1) % claim.fragments.size()].vertices});
        if (bytes.below(2) == 0) std::erase_if(claim.set_aside, [&](const auto& one) { return one.face == face; });
      });
    nonsense.place("entry.face", entry.face, faces);
    nonsense.way("entry.why", [&entry](Bytes& bytes) { entry.why = bytes.below(2) == 0 ? "" : " " + entry.why; });
  }
}

inline void add_of_question(Nonsense& nonsense, Order_certificate& claim) { nonsense.numbers("claim.eye", claim.eye); }
inline void add_of_question(Nonsense& nonsense, Graph_certificate& claim) {
  for (Graph_certificate::Arc& arc : claim.arcs) {
    if (arc.from < claim.fragments.size() && arc.to < claim.fragments.size()) {
      nonsense.place("arc.corner_from", arc.corner_from, claim.fragments[arc.from].vertices.size());
      nonsense.place("arc.corner_to", arc.corner_to, claim.fragments[arc.to].vertices.size());
    }
    nonsense.place("arc.from", arc.from, claim.fragments.size());
    nonsense.place("arc.to", arc.to, claim.fragments.size());
  }
}
inline void add_of_question(Nonsense& nonsense, Visible_certificate& claim) {
  nonsense.numbers("claim.eye", claim.eye);
  nonsense.points("claim.field", claim.field);
  for (Visible_certificate::Part& part : claim.parts) {
    nonsense.place("part.fragment", part.fragment, claim.fragments.size());
    if (part.rays.empty()) nonsense.points("part.vertices", part.vertices);
    if (part.rays.empty()) nonsense.emptied("part.vertices", part.vertices);
    nonsense.emptied("part.rays", part.rays);
    for (std::uint32_t& ray : part.rays) {
      if (ray < claim.rays.size()) nonsense.numbers("claim.rays", claim.rays[ray]);
      nonsense.place("ray", ray, claim.rays.size());
    }
  }
  for (Visible_certificate::Directions& cone : claim.empty) {
    nonsense.points("cone", cone);
    nonsense.emptied("cone", cone);
  }
}
/// The plane that a polygon is in.
inline std::array<Rational, 4> plane_through_corners(const Points& polygon) {
  const Exact_point n = cross(minus(polygon[1], polygon[0]), minus(polygon[2], polygon[0]));
  return {n[0], n[1], n[2], Rational(-dot(n, polygon[0]))};
}
inline void add_of_question(Nonsense& nonsense, Weak_certificate& claim) {
  using Kind = Weak_certificate::Node::Kind;
  const std::size_t fragments = claim.fragments.size(), sources = claim.sources.size();
  for (Points& source : claim.sources) {
    nonsense.points("source", source);
    nonsense.emptied("source", source);
  }
  nonsense.emptied("sources", claim.sources);
  nonsense.way("a face undecided that there is not",
               [&claim](Bytes& bytes) { claim.undecided.push_back(~Face_id{0} - bytes.byte()); });
  for (const Covering::Set_aside& entry : claim.set_aside)
    nonsense.way("a face undecided that is not drawn",
                 [&claim, face = entry.face](Bytes&) { claim.undecided.push_back(face); });
  for (const Order_fragment& fragment : claim.fragments) {  // it is decided, or undecided already
    nonsense.way("a face undecided that is decided",
                 [&claim, face = fragment.face](Bytes&) { claim.undecided.push_back(face); });
    nonsense.way("a face undecided twice",
                 [&claim, face = fragment.face](Bytes&) { claim.undecided.insert(claim.undecided.end(), 2, face); });
  }
  for (Weak_certificate::Sightline& line : claim.visible) {
    nonsense.place("line.fragment", line.fragment, fragments);
    nonsense.place("line.source", line.source, sources);
    nonsense.numbers("line.from", line.from);
    nonsense.numbers("line.to", line.to);
  }
  const auto add_line = [&](std::size_t& place) {
    if (place < claim.lines.size()) {
      Weak_certificate::Edge& line = claim.lines[place];
      if (line.fragment < fragments)
        nonsense.place("line.corner", line.corner, claim.fragments[line.fragment].vertices.size());
      nonsense.place("line.fragment", line.fragment, fragments);
    }
    nonsense.place("line", place, claim.lines.size());
  };
  for (Weak_certificate::Hidden& entry : claim.hidden) {
    nonsense.place("entry.fragment", entry.fragment, fragments);
    nonsense.place("entry.source", entry.source, sources);
    for (std::size_t& other : entry.also) nonsense.place("other", other, fragments);
    nonsense.points("entry.target", entry.target);
    if (entry.fragment < fragments) {
      const auto in_its_place = [&claim, &nonsense, &entry](const char* what, auto&& change) {
        nonsense.way(what, [&claim, &entry, change](Bytes&) {
          if (entry.fragment < claim.fragments.size()) change(entry.target = claim.fragments[entry.fragment].vertices);
        });
      };
      in_its_place("a target that looks to the other side",
                   [](Points& target) { std::reverse(target.begin(), target.end()); });
      in_its_place("a target in another plane", [](Points& target) {
        const std::array<Rational, 4> plane = plane_through_corners(target);
        for (Exact_point& p : target)
          for (std::size_t k = 0; k < 3; ++k) p[k] += plane[k];
      });
      in_its_place("a target that is smaller", [](Points& target) {
        const Exact_point first = target[0], second = target[2];
        for (Exact_point& p : target)
          for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] / 2 + (first[k] + second[k]) / 4;
      });
    }
    nonsense.ended("entry.proof", entry.proof);
    if (sources > 0 && !claim.sources[0].empty())  // all of the source is behind the cut
      nonsense.way("something is told of nothing", [&claim, &entry](Bytes& bytes) {
        Weak_certificate::Node cut, leaf;
        cut.kind = Kind::cut_source;
        Rational most = claim.sources[0][0][0];
        for (const Points& source : claim.sources)
          for (const Exact_point& p : source) most = std::max(most, p[0]);
        cut.plane = {Rational(1), Rational(0), Rational(0), Rational(-most - 1)};
        leaf.kind = bytes.below(2) == 0 ? Kind::blocked : Kind::empty;
        if (leaf.kind == Kind::empty) leaf.terms.emplace_back();
        entry.proof.insert(entry.proof.begin(), {cut, leaf});
      });
    for (Weak_certificate::Node& node : entry.proof) {
      const bool is_cut = node.kind == Kind::cut_source || node.kind == Kind::cut_target;
      if (is_cut && entry.source < sources && entry.fragment < fragments)
        nonsense.way("a cut that holds all", [&claim, &entry, &node](Bytes&) {
          node.plane = plane_through_corners(node.kind == Kind::cut_source ? claim.sources[entry.source]
                                                                           : claim.fragments[entry.fragment].vertices);
        });
      nonsense.emptied("node.terms", node.terms);
      nonsense.way("a kind that there is not", [&node](Bytes&) { node.kind = static_cast<Kind>(99); });
      if (node.kind == Kind::empty && node.terms.empty())  // nothing is inside
        nonsense.way("node.kind",
                     [&node](Bytes& bytes) { node.kind = bytes.below(2) == 0 ? Kind::away : Kind::blocked; });
      if (node.kind == Kind::blocked || node.kind == Kind::away)
        nonsense.way("node.kind", [&node](Bytes&) { node.kind = Kind::empty; });
      if (node.kind == Kind::line) add_line(node.index);
      if (node.kind == Kind::blocked) nonsense.place("node.index", node.index, fragments);
      if (node.kind == Kind::cut_source || node.kind == Kind::cut_target) nonsense.numbers("node.plane", node.plane);
      for (Weak_certificate::Term& term : node.terms) {
        add_line(term.line);
        nonsense.number("term.factor", term.factor);
        nonsense.way("a factor that is not positive", [&term](Bytes& bytes) {
          term.factor = bytes.below(2) == 0 ? Rational(0) : Rational(-term.factor);
        });
        for (auto* form : {&term.source, &term.target})
          if (*form)
            nonsense.way("a form that is not positive", [form](Bytes&) {
              for (Rational& x : **form) x = -x;
            });
        if (term.source) nonsense.numbers("term.source", *term.source);
        if (term.target) nonsense.numbers("term.target", *term.target);
      }
    }
  }
}
inline void add_of_question(Nonsense& nonsense, Along_certificate& claim, std::size_t faces) {
  const auto add_side = [&](Along_certificate::Side& side) {
    if (side.kind == Along_certificate::Side::Kind::edge && side.fragment < claim.fragments.size())
      nonsense.place("side.corner", side.corner, claim.fragments[side.fragment].vertices.size());
    nonsense.place("side.fragment", side.fragment, claim.fragments.size());
    nonsense.way("side.sign", [&side](Bytes& bytes) { side.sign = 2 * static_cast<int>(bytes.below(2)); });
  };
  const auto add_range = [&](Along_certificate::Range& range) {
    nonsense.place("range.high", range.high, claim.moments.size());
  };
  nonsense.numbers("claim.from", claim.from);
  nonsense.numbers("claim.to", claim.to);
  for (Path_moment& moment : claim.moments) {
    nonsense.numbers("moment.polynomial", moment.polynomial);
    nonsense.number("moment.low", moment.low);
    nonsense.number("moment.high", moment.high);
    nonsense.way("moment", [&moment](Bytes& bytes) {
      if (moment.low == moment.high && bytes.below(2) == 0) moment.polynomial[bytes.below(3)] = 1;
      else if (moment.low == moment.high) moment.low -= 1;
      else if (bytes.below(2) == 0) std::swap(moment.low, moment.high);
      else moment.polynomial[2] = 0;
    });
  }
  nonsense.ended("moments", claim.moments);
  if (!claim.faces.empty())
    nonsense.way("a face twice", [&claim](Bytes&) { claim.faces.push_back(claim.faces.front()); });
  for (Along_certificate::Face& face : claim.faces) {
    nonsense.place("face.face", face.face, faces);
    for (Along_certificate::Range& range : face.seen) add_range(range);
  }
  for (Along_certificate::Proof& proof : claim.proofs) {
    nonsense.place("proof.fragment", proof.fragment, claim.fragments.size());
    add_range(proof.range);
    nonsense.ended("proof.tree", proof.tree);
    nonsense.emptied("proof.tree", proof.tree);
    nonsense.emptied("proof.cone", proof.cone);
    if (!claim.two_sided) nonsense.way("proof.from_behind", [&proof](Bytes&) { proof.from_behind = true; });
    for (Along_certificate::Side& side : proof.cone) add_side(side);
    for (Along_certificate::Node& node : proof.tree) {
      if (node.is_cut) add_side(node.cut);
      else nonsense.place("node.blocked", node.blocked, claim.fragments.size());
    }
  }
}

/// Puts nonsense into a certificate of a scene of so many faces and says where; empty: there is no place for it.
template <class Claim>
std::string told_nonsense(Claim& claim, std::size_t faces, Bytes& bytes) {
  Nonsense nonsense;
  if (bytes.below(3) == 0) add_of_scene(nonsense, claim, faces);
  else if constexpr (std::is_same_v<Claim, Along_certificate>) add_of_question(nonsense, claim, faces);
  else add_of_question(nonsense, claim);
  return nonsense.tell(bytes);
}

/// The same of solids; windings and words, too.
inline std::string told_nonsense(Solid_certificate& claim, const std::vector<Polygon_soup>& solids, Bytes& bytes) {
  Nonsense nonsense;
  switch (bytes.below(6)) {
    case 0: claim.operation = bytes.below(2) == 0 ? "" : "uniom"; return "a word";
    case 1: claim.inside = bytes.below(2) == 0 ? "" : "Odd"; return "a word";
    case 2: claim.operands += 1 + static_cast<std::uint32_t>(bytes.below(2)); return "a word";
    case 3: {  // a winding number that is 0, or one twice
      if (claim.fragments.empty()) return {};
      auto& front = claim.fragments[bytes.below(claim.fragments.size())].front;
      if (front.empty()) front.emplace_back(0, 0);
      else if (bytes.below(2) == 0) front.push_back(front.back());
      else front.back().second = 0;
      return "a word";
    }
    default: break;
  }
  for (Solid_certificate::Fragment& fragment : claim.fragments) {
    for (Solid_certificate::Part& part : fragment.parts) {
      if (part.operand < solids.size()) nonsense.place("part.face", part.face, solids[part.operand].face_count());
      nonsense.place("part.operand", part.operand, solids.size());
    }
    for (auto& [operand, number] : fragment.front) nonsense.place("operand", operand, solids.size());
    nonsense.points("fragment.vertices", fragment.vertices);
    nonsense.emptied("fragment.vertices", fragment.vertices);
    nonsense.emptied("fragment.parts", fragment.parts);
  }
  for (Solid_certificate::Piece& piece : claim.pieces) {
    if (piece.operand < solids.size()) nonsense.place("piece.face", piece.face, solids[piece.operand].face_count());
    nonsense.place("piece.operand", piece.operand, solids.size());
    nonsense.points("piece.vertices", piece.vertices);
  }
  for (Solid_certificate::Set_aside& entry : claim.set_aside) {
    if (entry.operand < solids.size()) nonsense.place("entry.face", entry.face, solids[entry.operand].face_count());
    nonsense.place("entry.operand", entry.operand, solids.size());
    nonsense.emptied("entry.why", entry.why);
  }
  return nonsense.tell(bytes);
}

}  // namespace fuzz
