#pragma once
// Weak visibility as a sentence of nonlinear real arithmetic in four unknowns, and what z3 says to it. For small
// scenes.

#include "../sample.h"
#include "rays.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace weak_oracle {

// ---- The law as a formula
// p = S0 + u (S1 - S0) + v (S2 - S0) for three corners of the source, q = T0 + s (T1 - T0) + t (T2 - T0) for three of a
// piece of the target: all pairs of points of the two planes. The sentence, with strict inequalities only, so that what
// it describes is open:
//   p is strictly inside every edge of the source and q of the piece; q is strictly in front of the source, p of the
//   piece; and for each piece F in another plane than these two: p and q are strictly on one side of F's plane,
//     or p is strictly in front of it and the line passes strictly outside some edge, or p is strictly behind and the
//     line passes strictly outside some edge.
// Each pair that satisfies it is free with all its neighbours: if q too is strictly in front where p is, or q is on F's
// plane, the open segment does not meet F, and a line outside an edge's line meets F's plane outside F. A pair that is
// free with all its neighbours has one near it with p and q on no plane of an F and the line through no edge's line,
// and that one satisfies it. So the sentence holds iff the set of free pairs has an interior point. A piece in the
// source's or the target's plane holds no point of the open segment: h(p) > 0 and h(q) > 0 for the other one's plane.

/// A form in (p, q), affine in each: its values at the pairs of the three corners.
using Form = std::array<std::array<Rational, 3>, 3>;

/// p and q are points of these two planes.
struct Frame {
  std::array<Exact_point, 3> source, target;
};

/// Six times a volume: positive iff d is on the side from which a, b, c run counterclockwise. Of (p, q, a, b) it is
/// bilinear in p and q, and positive where the line passes outside the edge (a, b) of a polygon that p is in front of
/// and q is not.
inline Rational orient(const Exact_point& a, const Exact_point& b, const Exact_point& c, const Exact_point& d) {
  return dot(minus(b, a), cross(minus(c, a), minus(d, a)));
}

inline Form side_of_line(const Frame& frame, const Exact_point& a, const Exact_point& b) {
  Form form;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) form[i][j] = orient(frame.source[i], frame.target[j], a, b);
  return form;
}
inline Form height_of_p(const Frame& frame, const Half_space& plane) {
  Form form;
  for (std::size_t i = 0; i < 3; ++i) form[i].fill(plane.height(frame.source[i]));
  return form;
}
inline Form height_of_q(const Frame& frame, const Half_space& plane) {
  Form form;
  for (auto& row : form)
    for (std::size_t j = 0; j < 3; ++j) row[j] = plane.height(frame.target[j]);
  return form;
}

/// SMT-LIB 2 for the sentence "this piece is visible", without a question, and whether it is linear: that it is where
/// all planes are parallel.
class Sentence {
 public:
  Sentence(const Flats& flats, const Points& source, const Flat& piece)
      : frame_{{source[0], source[1], source[2]}, {piece.corners[0], piece.corners[1], piece.corners[2]}} {
    const Half_space from = plane_of(source);
    for (const Half_space& wall : oracle::walls(source, from.normal)) claim(positive(height_of_p(frame_, wall)));
    for (const Half_space& wall : oracle::walls(piece.corners, piece.plane.normal))
      claim(positive(height_of_q(frame_, wall)));
    claim(positive(height_of_q(frame_, from)));
    claim(positive(height_of_p(frame_, piece.plane)));
    for (const Flat& flat : flats)
      if (!lies_in(flat.corners, from) && !lies_in(flat.corners, piece.plane)) claim(not_blocked_by(flat));
  }
  bool linear() const { return linear_; }
  /// Whether it can be satisfied. The usual way to ask tries several methods, each for some time.
  std::string question() const { return linear_ ? "(check-sat)" : "(check-sat-using qfnra-nlsat)"; }
  std::string text() const {
    return std::string("(set-logic ") + (linear_ ? "QF_LRA" : "QF_NRA") +
           ")\n(declare-const u Real)\n(declare-const v Real)\n(declare-const s Real)\n(declare-const t Real)\n" +
           claims_;
  }

 private:
  void claim(const std::string& formula) { claims_ += "(assert " + formula + ")\n"; }

  std::string not_blocked_by(const Flat& flat) {
    const Form p = height_of_p(frame_, flat.plane), q = height_of_q(frame_, flat.plane);
    std::string outside_from_front, outside_from_behind;
    for (std::size_t k = 0; k < flat.corners.size(); ++k) {
      const Form side = side_of_line(frame_, flat.corners[k], flat.corners[(k + 1) % flat.corners.size()]);
      outside_from_front += ' ' + positive(side);
      outside_from_behind += ' ' + negative(side);
    }
    return "(or (and " + positive(p) + ' ' + positive(q) + ") (and " + negative(p) + ' ' + negative(q) + ")\n  (and " +
           positive(p) + " (or" + outside_from_front + "))\n  (and " + negative(p) + " (or" + outside_from_behind +
           ")))";
  }

  std::string positive(const Form& form) { return "(> " + polynomial(form) + " 0)"; }
  std::string negative(const Form& form) { return "(< " + polynomial(form) + " 0)"; }

  /// In u, v, s, t, times a positive number that makes its coefficients integers.
  std::string polynomial(const Form& form) {
    static constexpr const char* of_p[] = {"", "u", "v"};
    static constexpr const char* of_q[] = {"", "s", "t"};
    Form coefficients = form;  // of 1, u, v in rows, of 1, s, t in columns
    for (std::size_t i = 1; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) coefficients[i][j] -= form[0][j];
    for (auto& row : coefficients)
      for (std::size_t j = 1; j < 3; ++j) row[j] -= row[0];
    sightline::Integer common = 1, divisor = 0;
    for (const auto& row : coefficients)
      for (const Rational& c : row) common = lcm(common, c.get_den());
    for (const auto& row : coefficients)
      for (const Rational& c : row) divisor = gcd(divisor, sightline::Integer(c * common));
    if (sgn(divisor) == 0) return "0";
    std::string sum = "(+ 0";
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const sightline::Integer c(coefficients[i][j] * common / divisor);
        if (sgn(c) == 0) continue;
        if (i > 0 && j > 0) linear_ = false;
        const std::string magnitude = sightline::Integer(abs(c)).get_str();
        sum += " (* " + (sgn(c) < 0 ? "(- " + magnitude + ")" : magnitude) + ' ' + of_p[i] + ' ' + of_q[j] + " 1)";
      }
    return sum + ")";
  }

  Frame frame_;
  std::string claims_;
  bool linear_ = true;
};

// ---- z3

inline bool has_z3() {
  static const bool there = std::system("command -v z3 >/dev/null 2>&1") == 0;
  return there;
}

/// What z3 prints when it reads this. `effort` is the most of its own steps that it may take for a question, so that it
/// gives up at the same place everywhere; a million are about a second. A few steps of algebra take minutes: twenty
/// seconds end these. Pre: has_z3()
inline std::string z3_output(const std::string& text, unsigned effort) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("sightline_" + std::to_string(::getpid()) + ".smt2");
  std::ofstream(file) << text;
  const std::string command =
      "z3 -smt2 -memory:2000 -T:20 rlimit=" + std::to_string(effort) + ' ' + file.string() + " 2>&1";
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("z3 cannot be started");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  ::pclose(pipe);
  std::filesystem::remove(file);
  return output;
}

/// Whether a sentence can be satisfied; none where z3 gives up. Pre: has_z3()
inline std::optional<bool> satisfiable(const Sentence& sentence, unsigned effort) {
  const std::string output = z3_output(sentence.text() + sentence.question() + '\n', effort);
  if (output == "sat\n") return true;
  if (output == "unsat\n") return false;
  if (output == "unknown\n" || output == "timeout\n" || output.find("out of memory") != std::string::npos)
    return std::nullopt;
  throw std::runtime_error("z3 says: " + output);
}

/// Whether a face is weakly visible from the scene's source; none where z3 gives up. Pre: has_z3()
inline std::optional<bool> z3_says(const Weak_scene& scene, Face_id target, unsigned effort) {
  const Flats flats = oracle::flats_of(sightline::Scene(scene.soup));
  bool unknown = false;
  for (const Flat& piece : flats) {
    if (piece.face != target) continue;
    const std::optional<bool> visible = satisfiable(Sentence(flats, scene.source, piece), effort);
    if (visible == true) return true;
    unknown = unknown || !visible;
  }
  return unknown ? std::nullopt : std::optional(false);
}

}  // namespace weak_oracle
