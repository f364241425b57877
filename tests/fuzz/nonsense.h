#pragma once
// Certificates with nonsense in them: a place in a list where the list ends, or a number that is not in lowest terms.
// No checker may accept any of what it goes by; rays and lines count that something refers to.

#include "certificate.h"
#include "support.h"

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>

#include <cstddef>
#include <functional>
#include <string>
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

  /// Says where; empty: nowhere.
  std::string tell(Bytes& bytes) const {
    if (ways_.empty()) return {};
    const auto& [what, say] = ways_[bytes.word() % ways_.size()];
    say(bytes);
    return what;
  }

 private:
  std::vector<std::pair<const char*, std::function<void(Bytes&)>>> ways_;
};

inline void add_of_scene(Nonsense& nonsense, Covering& claim, std::size_t faces) {
  for (Order_fragment& fragment : claim.fragments) {
    nonsense.place("fragment.face", fragment.face, faces);
    nonsense.points("fragment.vertices", fragment.vertices);
  }
  for (Covering::Piece& piece : claim.pieces) {
    nonsense.place("piece.face", piece.face, faces);
    nonsense.points("piece.vertices", piece.vertices);
  }
  for (Covering::Set_aside& entry : claim.set_aside) nonsense.place("entry.face", entry.face, faces);
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
    for (std::uint32_t& ray : part.rays) {
      if (ray < claim.rays.size()) nonsense.numbers("claim.rays", claim.rays[ray]);
      nonsense.place("ray", ray, claim.rays.size());
    }
  }
  for (Visible_certificate::Directions& cone : claim.empty) nonsense.points("cone", cone);
}
inline void add_of_question(Nonsense& nonsense, Weak_certificate& claim) {
  using Kind = Weak_certificate::Node::Kind;
  const std::size_t fragments = claim.fragments.size(), sources = claim.sources.size();
  for (Points& source : claim.sources) nonsense.points("source", source);
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
    for (Weak_certificate::Node& node : entry.proof) {
      if (node.kind == Kind::line) add_line(node.index);
      if (node.kind == Kind::blocked) nonsense.place("node.index", node.index, fragments);
      if (node.kind == Kind::cut_source || node.kind == Kind::cut_target) nonsense.numbers("node.plane", node.plane);
      for (Weak_certificate::Term& term : node.terms) {
        add_line(term.line);
        nonsense.number("term.factor", term.factor);
        if (term.source) nonsense.numbers("term.source", *term.source);
        if (term.target) nonsense.numbers("term.target", *term.target);
      }
    }
  }
}
inline void add_of_question(Nonsense& nonsense, Along_certificate& claim) {
  const auto add_side = [&](Along_certificate::Side& side) {
    nonsense.place("side.fragment", side.fragment, claim.fragments.size());
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
  }
  for (Along_certificate::Face& face : claim.faces)
    for (Along_certificate::Range& range : face.seen) add_range(range);
  for (Along_certificate::Proof& proof : claim.proofs) {
    nonsense.place("proof.fragment", proof.fragment, claim.fragments.size());
    add_range(proof.range);
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
  }
  for (Solid_certificate::Piece& piece : claim.pieces) {
    if (piece.operand < solids.size()) nonsense.place("piece.face", piece.face, solids[piece.operand].face_count());
    nonsense.place("piece.operand", piece.operand, solids.size());
    nonsense.points("piece.vertices", piece.vertices);
  }
  for (Solid_certificate::Set_aside& entry : claim.set_aside) {
    if (entry.operand < solids.size()) nonsense.place("entry.face", entry.face, solids[entry.operand].face_count());
    nonsense.place("entry.operand", entry.operand, solids.size());
  }
  return nonsense.tell(bytes);
}

}  // namespace fuzz
