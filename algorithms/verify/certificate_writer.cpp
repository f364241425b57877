// From top to bottom: what parts of certificates are as text; the table of points; certificates of each kind.

#include <sightline/algorithms/verify/certificate_writer.h>

#include <sightline/algorithms/verify/json_text.h>
#include <sightline/kernel/number.h>

#include <gmp.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace sightline {
namespace certificate_text_detail {
namespace {

// ---- Parts

/// What stands between the entries of a list.
class Commas {
 public:
  explicit Commas(std::ostream& out) : out_(out) {}
  void next() {
    if (!first_) out_ << ',';
    first_ = false;
  }

 private:
  std::ostream& out_;
  bool first_ = true;
};

template <class Entries, class Write>
void write_list(std::ostream& out, const Entries& entries, const Write& write) {
  Commas commas(out);
  out << '[';
  for (const auto& entry : entries) {
    commas.next();
    write(entry);
  }
  out << ']';
}

void write(std::ostream& out, const Rational& number) { out << '"' << to_string(number) << '"'; }

template <std::size_t n>
void write(std::ostream& out, const std::array<Rational, n>& numbers) {
  write_list(out, numbers, [&](const Rational& number) { write(out, number); });
}
void write(std::ostream& out, const std::vector<Exact_point>& points) {
  write_list(out, points, [&](const Exact_point& p) { write(out, p); });
}
template <class Whole>
requires std::is_integral_v<Whole>
void write_numbers(std::ostream& out, std::span<const Whole> numbers) {
  write_list(out, numbers, [&](Whole number) { out << number; });
}

// ---- The table of points

struct Hash {
  std::size_t operator()(const Exact_point* p) const {
    std::size_t h = 14695981039346656037u;
    const auto add = [&](std::size_t word) {
      h = (h ^ word) * 1099511628211u;
      h ^= h >> 29;
    };
    for (const Rational& number : *p)
      for (const Integer* part : {&number.get_num(), &number.get_den()}) {
        add(static_cast<std::size_t>(mpz_sgn(part->get_mpz_t()) + 1));
        for (std::size_t i = 0; i < mpz_size(part->get_mpz_t()); ++i)
          add(mpz_getlimbn(part->get_mpz_t(), static_cast<mp_size_t>(i)));
      }
    return h;
  }
};
struct Same {
  bool operator()(const Exact_point* p, const Exact_point* q) const { return *p == *q; }
};

/// Points by number, each once, in the order in which they were first met. It refers to points that others keep.
class Point_table {
 public:
  void add(const std::vector<Exact_point>& points) {
    for (const Exact_point& p : points)
      if (numbers_.try_emplace(&p, static_cast<std::uint32_t>(points_.size())).second) points_.push_back(&p);
  }
  template <class Parts>
  void add_vertices_of(const Parts& parts) {
    for (const auto& part : parts) add(part.vertices);
  }
  std::uint32_t number(const Exact_point& p) const { return numbers_.at(&p); }
  void write_to(std::ostream& out) const {
    out << R"(,"points":)";
    write_list(out, points_, [&](const Exact_point* p) { write(out, *p); });
  }
  void write_numbers_of(std::ostream& out, const std::vector<Exact_point>& points) const {
    write_list(out, points, [&](const Exact_point& p) { out << number(p); });
  }

 private:
  std::unordered_map<const Exact_point*, std::uint32_t, Hash, Same> numbers_;
  std::vector<const Exact_point*> points_;
};

/// What every certificate has, after the table.
void write(std::ostream& out, const Covering& covering, const Point_table& table) {
  const auto write_parts = [&](const char* key, const auto& parts) {
    out << ",\"" << key << "\":";
    write_list(out, parts, [&](const auto& part) {
      out << R"({"face":)" << part.face << R"(,"piece":)" << part.piece << R"(,"vertices":)";
      table.write_numbers_of(out, part.vertices);
      out << '}';
    });
  };
  write_parts("fragments", covering.fragments);
  write_parts("pieces", covering.pieces);
  out << R"(,"set_aside":)";
  write_list(out, covering.set_aside, [&](const Covering::Set_aside& entry) {
    out << R"({"face":)" << entry.face << R"(,"why":)";
    certificate_check::write_json_text(out, entry.why);
    out << '}';
  });
}

void write_begin(std::ostream& out, const char* format) { out << R"({"format":")" << format << '"'; }

Point_table table_of(const Covering& covering) {
  Point_table table;
  table.add_vertices_of(covering.fragments);
  table.add_vertices_of(covering.pieces);
  return table;
}

/// The same with all of it.
void write_covering(std::ostream& out, const Covering& covering) {
  const Point_table table = table_of(covering);
  table.write_to(out);
  write(out, covering, table);
}

void write(std::ostream& out, const Weak_certificate::Node& node) {
  using Kind = Weak_certificate::Node::Kind;
  switch (node.kind) {
    case Kind::line: out << R"(["line",)" << node.index; break;
    case Kind::blocked: out << R"(["blocked",)" << node.index; break;
    case Kind::away: out << R"(["away")"; break;
    case Kind::cut_source:
    case Kind::cut_target:
      out << (node.kind == Kind::cut_source ? R"(["cut source",)" : R"(["cut target",)");
      write(out, node.plane);
      break;
    case Kind::empty:
      out << R"(["empty",)";
      write_list(out, node.terms, [&](const Weak_certificate::Term& term) {
        out << '[' << term.line << ',';
        write(out, term.factor);
        if (term.source || term.target) out << ",{";
        if (term.source) {
          out << R"("source":)";
          write(out, *term.source);
        }
        if (term.source && term.target) out << ',';
        if (term.target) {
          out << R"("target":)";
          write(out, *term.target);
        }
        out << (term.source || term.target ? "}]" : "]");
      });
  }
  out << ']';
}

void write_side(std::ostream& out, const Along_certificate::Side& side) {
  const bool is_edge = side.kind == Along_certificate::Side::Kind::edge;
  out << (is_edge ? R"(["edge",)" : R"(["meet",)") << side.fragment;
  if (is_edge) out << ',' << side.corner;
  out << ',' << side.sign << ']';
}

void write(std::ostream& out, const Along_certificate::Proof& proof) {
  out << R"({"fragment":)" << proof.fragment;
  if (proof.from_behind) out << R"(,"from_behind":true)";
  out << R"(,"moments":[)" << proof.range.low << ',' << proof.range.high << ']';
  if (!proof.cone.empty()) {
    out << R"(,"cone":)";
    write_list(out, proof.cone, [&](const Along_certificate::Side& side) { write_side(out, side); });
  } else {
    out << R"(,"tree":)";
    write_list(out, proof.tree, [&](const Along_certificate::Node& node) {
      if (node.is_cut) write_side(out, node.cut);
      else out << R"(["blocked",)" << node.blocked << ']';
    });
  }
  out << '}';
}

}  // namespace
}  // namespace certificate_text_detail

using namespace certificate_text_detail;

// ---- Certificates

void write_certificate(std::ostream& out, const Order_certificate& certificate) {
  write_begin(out, "sightline order 2");
  out << R"(,"eye":)";
  write(out, certificate.eye);
  if (certificate.on_view) out << R"(,"on_view":true)";
  write_covering(out, certificate);
  const auto& [depths, others] = certificate.cuts;
  if (!depths.empty()) {
    out << R"(,"depths":)";
    write_numbers(out, std::span(depths));
  }
  if (!others.empty()) {
    out << R"(,"cuts":)";
    write_list(out, others, [&](const Order_cuts::Cut& cut) {
      out << '[' << cut.place << ',' << cut.depth << ',';
      write(out, cut.plane);
      out << ']';
    });
  }
  out << "}\n";
}

void write_certificate(std::ostream& out, const Graph_certificate& certificate) {
  write_begin(out, "sightline graph 2");
  write_covering(out, certificate);
  out << R"(,"sizes":)";
  write_numbers(out, std::span(certificate.sizes));
  out << R"(,"arcs":)";
  write_list(out, certificate.arcs, [&](const Graph_certificate::Arc& arc) {
    out << '[' << arc.from << ',' << arc.to << ',' << arc.corner_from << ',' << arc.corner_to << ']';
  });
  out << "}\n";
}

void write_certificate(std::ostream& out, const Visible_certificate& certificate) {
  Visible_certificate_writer writer(out, certificate, certificate.eye, certificate.field);
  for (const Exact_point& ray : certificate.rays) writer.ray(ray);
  for (const Visible_certificate::Part& part : certificate.parts)
    if (part.rays.empty()) writer.part(part.fragment, part.vertices, part.ray);
    else writer.part(part.fragment, part.rays);
  for (const Visible_certificate::Directions& cone : certificate.empty) writer.empty(cone);
  writer.finish();
}

void write_certificate(std::ostream& out, const Weak_certificate& certificate) {
  write_begin(out, "sightline weak 4");
  write_covering(out, certificate);
  out << R"(,"sources":)";
  write_list(out, certificate.sources, [&](const std::vector<Exact_point>& source) { write(out, source); });
  if (certificate.two_sided) out << R"(,"two_sided":true)";
  out << R"(,"visible":)";
  write_list(out, certificate.visible, [&](const Weak_certificate::Sightline& sightline) {
    out << R"({"fragment":)" << sightline.fragment << R"(,"source":)" << sightline.source << R"(,"from":)";
    write(out, sightline.from);
    out << R"(,"to":)";
    write(out, sightline.to);
    out << '}';
  });
  out << R"(,"lines":)";
  write_list(out, certificate.lines,
             [&](const Weak_certificate::Edge& line) { out << '[' << line.fragment << ',' << line.corner << ']'; });
  out << R"(,"hidden":)";
  write_list(out, certificate.hidden, [&](const Weak_certificate::Hidden& entry) {
    out << R"({"fragment":)" << entry.fragment << R"(,"source":)" << entry.source << R"(,"proof":)";
    write_list(out, entry.proof, [&](const Weak_certificate::Node& node) { write(out, node); });
    if (!entry.also.empty()) {
      out << R"(,"also":)";
      write_numbers(out, std::span(entry.also));
    }
    if (!entry.target.empty()) {
      out << R"(,"target":)";
      write(out, entry.target);
    }
    out << '}';
  });
  out << R"(,"undecided":)";
  write_numbers(out, std::span(certificate.undecided));
  out << "}\n";
}

void write_certificate(std::ostream& out, const Along_certificate& certificate) {
  write_begin(out, "sightline along 2");
  out << R"(,"path":[)";
  write(out, certificate.from);
  out << ',';
  write(out, certificate.to);
  out << ']';
  write_covering(out, certificate);
  if (certificate.two_sided) out << R"(,"two_sided":true)";
  out << R"(,"moments":)";
  write_list(out, certificate.moments, [&](const Path_moment& moment) {
    if (moment.low == moment.high) {
      out << R"({"root":)";
      write(out, moment.low);
    } else {
      out << R"({"quadratic":)";
      write(out, std::array{moment.polynomial[2], moment.polynomial[1], moment.polynomial[0]});
      out << R"(,"low":)";
      write(out, moment.low);
      out << R"(,"high":)";
      write(out, moment.high);
    }
    out << '}';
  });
  const auto write_range = [&](const Along_certificate::Range& range) {
    out << '[' << range.low << ',' << range.high << ']';
  };
  out << R"(,"faces":)";
  write_list(out, certificate.faces, [&](const Along_certificate::Face& face) {
    out << R"({"face":)" << face.face << R"(,"seen":)";
    write_list(out, face.seen, write_range);
    out << '}';
  });
  out << R"(,"proofs":)";
  write_list(out, certificate.proofs, [&](const Along_certificate::Proof& proof) { write(out, proof); });
  out << "}\n";
}

template <class Any>
std::string certificate_text(const Any& certificate) {
  std::ostringstream out;
  write_certificate(out, certificate);
  return std::move(out).str();
}
template std::string certificate_text(const Order_certificate&);
template std::string certificate_text(const Graph_certificate&);
template std::string certificate_text(const Visible_certificate&);
template std::string certificate_text(const Weak_certificate&);
template std::string certificate_text(const Along_certificate&);

// ---- Piece by piece

Visible_certificate_writer::Visible_certificate_writer(std::ostream& out, const Covering& scene, const Exact_point& eye,
                                                       const Visible_certificate::Directions& field)
    : out_(out) {
  write_begin(out, "sightline see 2");
  out << R"(,"eye":)";
  write(out, eye);
  if (!field.empty()) {
    out << R"(,"field":)";
    write(out, field);
  }
  write_covering(out, scene);
  out << R"(,"rays":[)";
}

void Visible_certificate_writer::go_to(Stage stage) {
  for (; stage_ < stage; stage_ = static_cast<Stage>(static_cast<int>(stage_) + 1)) {
    out_ << (stage_ == Stage::rays ? R"(],"parts":[)" : R"(],"empty":[)");
    first_ = true;
  }
}
void Visible_certificate_writer::begin_entry(Stage stage) {
  go_to(stage);
  if (!first_) out_ << ',';
  first_ = false;
}

void Visible_certificate_writer::ray(const Exact_point& direction) {
  begin_entry(Stage::rays);
  write(out_, direction);
}
void Visible_certificate_writer::part(std::size_t fragment, std::span<const std::uint32_t> rays) {
  begin_entry(Stage::parts);
  out_ << R"({"fragment":)" << fragment << R"(,"rays":)";
  write_numbers(out_, rays);
  out_ << '}';
}
void Visible_certificate_writer::part(std::size_t fragment, const std::vector<Exact_point>& vertices,
                                      const Exact_point& ray) {
  begin_entry(Stage::parts);
  out_ << R"({"fragment":)" << fragment << R"(,"vertices":)";
  write(out_, vertices);
  out_ << R"(,"ray":)";
  write(out_, ray);
  out_ << '}';
}
void Visible_certificate_writer::empty(std::span<const std::uint32_t> rays) {
  begin_entry(Stage::empty);
  write_numbers(out_, rays);
}
void Visible_certificate_writer::empty(const Visible_certificate::Directions& rays) {
  begin_entry(Stage::empty);
  write(out_, rays);
}
void Visible_certificate_writer::finish() {
  go_to(Stage::empty);
  out_ << "]}\n";
}

}  // namespace sightline
