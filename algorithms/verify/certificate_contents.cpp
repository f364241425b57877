// From top to bottom: parts of entries; tables; entries, key by key; what refers to what; certificates.

#include <sightline/algorithms/verify/certificate_contents.h>

#include <sightline/kernel/number.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sightline::certificate_json {

std::string entry_name(const std::string& key, std::size_t number) { return key + '[' + std::to_string(number) + ']'; }

/// Where something stands, put together only where something is wrong with it. It refers to that in which it is, which
/// must last as long.
class At {
 public:
  At(const std::string& whole) : text_(whole) {}
  At operator+(const char* text) const { return {this, text, none}; }
  At operator[](std::size_t number) const { return {this, {}, number}; }
  std::string text() const {
    const std::string whole = (in_ != nullptr ? in_->text() : "") + std::string(text_);
    return number_ == none ? whole : entry_name(whole, number_);
  }

  At(std::string_view key, std::size_t number) : text_(key), number_(number) {}

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  At(const At* in, std::string_view text, std::size_t number) : in_(in), text_(text), number_(number) {}

  const At* in_ = nullptr;
  std::string_view text_;
  std::size_t number_ = none;
};

namespace {

using Json = nlohmann::json;

// ---- Parts of entries

[[noreturn]] void fail(const std::string& place, const std::string& what) { throw Fault{place + ": " + what}; }
[[noreturn]] void fail(const At& place, const std::string& what) { fail(place.text(), what); }

const Json& member(const Json& object, const char* key, const At& place) {
  if (!object.is_object()) fail(place, "expected an object");
  const auto found = object.find(key);
  if (found == object.end()) fail(place, std::string("no \"") + key + '"');
  return *found;
}

const Json& array(const Json& value, const At& place) {
  if (!value.is_array()) fail(place, "expected an array");
  return value;
}
std::uint32_t number32(const Json& value, const At& place) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    fail(place, "expected an integer from 0 to 4294967295");
  return value.get<std::uint32_t>();
}

Rational exact_number(const Json& value, const At& place) {
  if (!value.is_string()) fail(place, "expected exact numbers as strings \"p\" or \"p/q\"");
  try {
    return rational_from_string(value.get_ref<const std::string&>());
  } catch (const std::invalid_argument& error) {
    fail(place, error.what());
  }
}

template <std::size_t n>
std::array<Rational, n> exact_numbers(const Json& value, const At& place) {
  if (array(value, place).size() != n) fail(place, std::string("expected ") + (n == 3 ? "three" : "four") + " numbers");
  std::array<Rational, n> result;
  for (std::size_t k = 0; k < n; ++k) result[k] = exact_number(value[k], place);
  return result;
}
Exact_point point(const Json& value, const At& place) { return exact_numbers<3>(value, place); }

bool truth(const Json& value, const At& at) {
  if (!value.is_boolean()) fail(at, "expected true or false");
  return value.get<bool>();
}

/// The kinds of nodes, by the words that they begin with.
constexpr std::array<std::pair<const char*, Weak_certificate::Node::Kind>, 6> node_words{
    {{"line", Weak_certificate::Node::Kind::line},
     {"cut source", Weak_certificate::Node::Kind::cut_source},
     {"cut target", Weak_certificate::Node::Kind::cut_target},
     {"blocked", Weak_certificate::Node::Kind::blocked},
     {"empty", Weak_certificate::Node::Kind::empty},
     {"away", Weak_certificate::Node::Kind::away}}};

/// [line, factor] or [line, factor, {"source": form, "target": form}].
Weak_certificate::Term term(const Json& value, const At& at) {
  if (array(value, at).size() != 2 && value.size() != 3) fail(at, "expected [line, factor] or [line, factor, forms]");
  Weak_certificate::Term result;
  result.line = number32(value[0], at + "[0]");
  result.factor = exact_number(value[1], at + "[1]");
  if (value.size() == 2) return result;
  if (!value[2].is_object()) fail(at + "[2]", "expected an object");
  if (value[2].contains("source")) result.source = exact_numbers<4>(value[2]["source"], at + "[2].source");
  if (value[2].contains("target")) result.target = exact_numbers<4>(value[2]["target"], at + "[2].target");
  return result;
}

/// [word], or [word, what it is about].
Weak_certificate::Node node(const Json& value, const At& at) {
  using Kind = Weak_certificate::Node::Kind;
  if (array(value, at).empty() || !value[0].is_string()) fail(at, "expected an array that begins with a word");
  const auto found = std::find_if(node_words.begin(), node_words.end(), [&](const auto& known) {
    return value[0].get_ref<const std::string&>() == known.first;
  });
  if (found == node_words.end())
    fail(at + "[0]", "expected \"line\", \"cut source\", \"cut target\", \"blocked\", \"empty\" or \"away\"");
  Weak_certificate::Node result;
  result.kind = found->second;
  const std::size_t size = result.kind == Kind::away ? 1 : 2;
  if (value.size() != size) fail(at, "expected " + std::to_string(size) + (size == 1 ? " entry" : " entries"));
  if (result.kind == Kind::line || result.kind == Kind::blocked) result.index = number32(value[1], at + "[1]");
  if (result.kind == Kind::cut_source || result.kind == Kind::cut_target)
    result.plane = exact_numbers<4>(value[1], at + "[1]");
  if (result.kind == Kind::empty)
    for (const Json& entry : array(value[1], at + "[1]"))
      result.terms.push_back(term(entry, (at + "[1]")[result.terms.size()]));
  return result;
}

/// {"root": t}, or {"quadratic": [a, b, c], "low", "high"}.
Path_moment moment(const Json& value, const At& at) {
  if (value.is_object() && value.contains("root")) {
    for (const char* other : {"quadratic", "low", "high"})
      if (value.contains(other)) fail(at, "expected a \"root\" or a \"quadratic\", not both");
    const Rational root = exact_number(value["root"], at + ".root");
    return {{}, root, root};
  }
  const auto [a, b, c] = exact_numbers<3>(member(value, "quadratic", at), at + ".quadratic");
  return {{c, b, a},
          exact_number(member(value, "low", at), at + ".low"),
          exact_number(member(value, "high", at), at + ".high")};
}

/// [low, high]
Along_certificate::Range range(const Json& value, const At& at) {
  if (array(value, at).size() != 2) fail(at, "expected two moments");
  return {number32(value[0], at + "[0]"), number32(value[1], at + "[1]")};
}

/// ["edge", fragment, corner, sign] or ["meet", fragment, sign].
Along_certificate::Side side(const Json& value, const At& at) {
  using Kind = Along_certificate::Side::Kind;
  if (array(value, at).empty() || (value[0] != "edge" && value[0] != "meet"))
    fail(at, "expected an array that begins with \"edge\" or \"meet\"");
  Along_certificate::Side result;
  result.kind = value[0] == "edge" ? Kind::edge : Kind::meet;
  const std::size_t size = result.kind == Kind::edge ? 4 : 3;
  if (value.size() != size) fail(at, "expected " + std::to_string(size) + " entries");
  result.fragment = number32(value[1], at + "[1]");
  if (result.kind == Kind::edge) result.corner = number32(value[2], at + "[2]");
  if (value.back() != 1 && value.back() != -1) fail(at, "expected a sign, 1 or -1, at its end");
  result.sign = value.back().get<int>();
  return result;
}

/// ["blocked", fragment], or a cut.
Along_certificate::Node along_node(const Json& value, const At& at) {
  if (!array(value, at).empty() && value[0] == "blocked") {
    if (value.size() != 2) fail(at, "expected 2 entries");
    return {false, {}, number32(value[1], at + "[1]")};
  }
  return {true, side(value, at), 0};
}

// ---- Tables

std::string name_of(const Place& place) {
  static constexpr const char* keys[] = {"fragments", "pieces", "parts", "field", "empty", "sources", "hidden"};
  const std::string entry = place.list == Place::field ? "field" : entry_name(keys[place.list], place.entry);
  const char* const member = place.list <= Place::parts ? ".vertices" : place.list == Place::hidden ? ".target" : "";
  return entry_name(entry + member, place.corner);
}

}  // namespace

void Table::check(std::uint32_t number, const std::string& at) const {
  if (number < points.size()) return;
  const std::string table = std::string(1, '"') + key + '"';
  fail(at, is_whole ? "expected a number below " + std::to_string(points.size()) + ", the size of " + table
                    : std::string("is a number, but there is no table ") + table);
}

// ---- Entries

/// Whether the value of a key is taken entry by entry, as a list; nothing where the key means nothing.
std::optional<bool> is_list(std::string_view key) {
  for (const std::string_view known : {"format", "eye", "on_view", "field", "two_sided", "path"})
    if (key == known) return false;
  for (const std::string_view known :
       {"points", "fragments", "pieces", "set_aside", "sizes", "arcs", "rays", "parts", "empty", "sources", "visible",
        "lines", "hidden", "undecided", "moments", "faces", "proofs", "depths", "cuts"})
    if (key == known) return true;
  return std::nullopt;
}

Exact_point& Contents::at(const Place& place) {
  switch (place.list) {
    case Place::fragments: return covering_.fragments[place.entry].vertices[place.corner];
    case Place::pieces: return covering_.pieces[place.entry].vertices[place.corner];
    case Place::parts: return visible_.parts[place.entry].vertices[place.corner];
    case Place::field: return visible_.field[place.corner];
    case Place::empty: return visible_.empty[place.entry][place.corner];
    case Place::hidden: return weak_.hidden[place.entry].target[place.corner];
    default: return weak_.sources[place.entry][place.corner];
  }
}

void Contents::fail_as_too_much(const Table& table, const std::string& at) {
  fail(at, std::string("points of \"") + table.key + "\" are " + Written_out::what_is_too_much + "; write them out");
}
void Contents::put(const Table& table, std::uint32_t number, Exact_point& there, const Place& place) {
  if (!written_out_.add(table.points[number], read_)) fail_as_too_much(table, name_of(place));
  there = table.points[number];
}
void Contents::put_late(Table& table) {
  for (const auto& [number, place] : table.late) {
    table.check(number, name_of(place));
    put(table, number, at(place), place);
  }
  table.late = {};
}

std::vector<Exact_point> Contents::points(const Json& value, const At& place, Table& table, Place::List list,
                                          std::size_t entry) {
  std::vector<Exact_point> result(array(value, place).size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (!value[k].is_number()) {
      result[k] = point(value[k], place[k]);
      continue;
    }
    const std::uint32_t number = number32(value[k], place[k]);
    if (!table.is_whole) {
      table.late.push_back({number, {list, entry, k}});
      continue;
    }
    if (number >= table.points.size()) table.check(number, place[k].text());
    put(table, number, result[k], {list, entry, k});
  }
  return result;
}

/// {face, piece, vertices}: a fragment or a piece.
template <class Part>
Part Contents::part(const Json& entry, const At& at, Place::List list, std::size_t number) {
  return {number32(member(entry, "face", at), at + ".face"), number32(member(entry, "piece", at), at + ".piece"),
          points(member(entry, "vertices", at), at + ".vertices", points_, list, number)};
}

/// {fragment, vertices, ray} or {fragment, rays}.
void Contents::take_part(const Json& entry, const At& at) {
  Visible_certificate::Part part;
  part.fragment = number32(member(entry, "fragment", at), at + ".fragment");
  if (entry.contains("rays")) {
    const At place = at + ".rays";
    for (const Json& number : array(entry["rays"], place))
      part.rays.push_back(number32(number, place[part.rays.size()]));
    if (part.rays.size() < 3) fail(place, "expected three or more numbers");
    if (entry.contains("vertices") || entry.contains("ray"))
      fail(at, "expected either \"rays\", or \"vertices\" and \"ray\"");
  } else {
    part.vertices =
        points(member(entry, "vertices", at), at + ".vertices", points_, Place::parts, visible_.parts.size());
    part.ray = point(member(entry, "ray", at), at + ".ray");
  }
  visible_.parts.push_back(std::move(part));
}

/// {fragment, source, proof}, also more fragments, and the target that holds them.
void Contents::take_hidden(const Json& entry, const At& at) {
  Weak_certificate::Hidden hidden;
  hidden.fragment = number32(member(entry, "fragment", at), at + ".fragment");
  hidden.source = number32(member(entry, "source", at), at + ".source");
  for (const Json& step : array(member(entry, "proof", at), at + ".proof"))
    hidden.proof.push_back(node(step, (at + ".proof")[hidden.proof.size()]));
  if (entry.contains("also"))
    for (const Json& number : array(entry["also"], at + ".also"))
      hidden.also.push_back(number32(number, (at + ".also")[hidden.also.size()]));
  if (entry.contains("target"))
    hidden.target = points(entry["target"], at + ".target", points_, Place::hidden, weak_.hidden.size());
  weak_.hidden.push_back(std::move(hidden));
}

/// {fragment, from_behind, moments, cone or tree}.
void Contents::take_proof(const Json& entry, const At& at) {
  Along_certificate::Proof proof;
  proof.fragment = number32(member(entry, "fragment", at), at + ".fragment");
  if (entry.contains("from_behind")) proof.from_behind = truth(entry["from_behind"], at + ".from_behind");
  proof.range = range(member(entry, "moments", at), at + ".moments");
  if (entry.contains("cone") == entry.contains("tree")) fail(at, "expected either \"cone\" or \"tree\"");
  const bool is_cone = entry.contains("cone");
  const At place = at + (is_cone ? ".cone" : ".tree");
  for (const Json& step : array(entry[is_cone ? "cone" : "tree"], place))
    if (is_cone) proof.cone.push_back(side(step, place[proof.cone.size()]));
    else proof.tree.push_back(along_node(step, place[proof.tree.size()]));
  if (proof.cone.empty() && proof.tree.empty()) fail(place, "is empty");
  along_.proofs.push_back(std::move(proof));
}

void Contents::take(const std::string& key, std::size_t number, const Json& entry) {
  const At at(key, number);
  const auto numbers = [&](std::size_t count, const char* wanted) {
    if (array(entry, at).size() != count) fail(at, wanted);
    std::vector<std::uint32_t> result;
    for (const Json& value : entry) result.push_back(number32(value, at));
    return result;
  };
  if (key == "points") points_.points.push_back(point(entry, at));
  else if (key == "rays") rays_.points.push_back(point(entry, at));
  else if (key == "fragments") covering_.fragments.push_back(part<Order_fragment>(entry, at, Place::fragments, number));
  else if (key == "pieces") covering_.pieces.push_back(part<Covering::Piece>(entry, at, Place::pieces, number));
  else if (key == "set_aside") {
    const Json& why = member(entry, "why", at);
    if (!why.is_string()) fail(at + ".why", "expected a string");
    covering_.set_aside.push_back({number32(member(entry, "face", at), at + ".face"), why.get<std::string>()});
  } else if (key == "depths") cuts_.depths.push_back(number32(entry, at));
  else if (key == "cuts") {
    if (array(entry, at).size() != 3) fail(at, "expected [place, depth, plane]");
    cuts_.others.push_back(
        {number32(entry[0], at + "[0]"), number32(entry[1], at + "[1]"), exact_numbers<4>(entry[2], at + "[2]")});
  } else if (key == "sizes") graph_.sizes.push_back(number32(entry, at));
  else if (key == "arcs") {
    const auto arc = numbers(4, "expected [from, to, corner of from, corner of to]");
    graph_.arcs.push_back({arc[0], arc[1], arc[2], arc[3]});
  } else if (key == "parts") take_part(entry, at);
  else if (key == "empty") visible_.empty.push_back(points(entry, at, rays_, Place::empty, number));
  else if (key == "sources") weak_.sources.push_back(points(entry, at, points_, Place::sources, number));
  else if (key == "visible") {
    weak_.visible.push_back({number32(member(entry, "fragment", at), at + ".fragment"),
                             number32(member(entry, "source", at), at + ".source"),
                             point(member(entry, "from", at), at + ".from"),
                             point(member(entry, "to", at), at + ".to")});
  } else if (key == "lines") {
    const auto line = numbers(2, "expected [fragment, corner]");
    weak_.lines.push_back({line[0], line[1]});
  } else if (key == "hidden") take_hidden(entry, at);
  else if (key == "moments") along_.moments.push_back(moment(entry, at));
  else if (key == "proofs") take_proof(entry, at);
  else if (key == "faces") {
    Along_certificate::Face face{number32(member(entry, "face", at), at + ".face"), {}};
    for (const Json& seen : array(member(entry, "seen", at), at + ".seen"))
      face.seen.push_back(range(seen, (at + ".seen")[face.seen.size()]));
    along_.faces.push_back(std::move(face));
  } else weak_.undecided.push_back(number32(entry, at));
}

void Contents::take(const std::string& key, const Json& value) {
  if (key == "format") format_ = value.is_string() ? value.get<std::string>() : "";
  else if (key == "eye") eye_ = point(value, key);
  else if (key == "on_view") on_view_ = truth(value, key);
  else if (key == "two_sided") two_sided_ = truth(value, key);
  else if (key == "path") {
    if (array(value, key).size() != 2) fail(key, "expected two points");
    along_.from = point(value[0], std::string("path[0]"));
    along_.to = point(value[1], std::string("path[1]"));
  } else visible_.field = points(value, key, rays_, Place::field, 0);
}

// ---- What refers to what

static void check_below(std::size_t number, std::size_t below, const std::string& at) {
  if (number >= below) fail(at, "expected a number below " + std::to_string(below));
}

void Contents::check_graph() const {
  const std::vector<Order_fragment>& fragments = covering_.fragments;
  for (std::size_t k = 0; k < graph_.arcs.size(); ++k) {
    const Graph_certificate::Arc& arc = graph_.arcs[k];
    const std::string at = entry_name("arcs", k);
    check_below(arc.from, fragments.size(), at);
    check_below(arc.to, fragments.size(), at);
    check_below(arc.corner_from, fragments[arc.from].vertices.size(), at);
    check_below(arc.corner_to, fragments[arc.to].vertices.size(), at);
  }
}

void Contents::check_parts() {
  for (std::size_t k = 0; k < visible_.parts.size(); ++k) {
    const Visible_certificate::Part& part = visible_.parts[k];
    if (part.fragment >= covering_.fragments.size())
      check_below(part.fragment, covering_.fragments.size(), entry_name("parts", k) + ".fragment");
    for (std::size_t i = 0; i < part.rays.size(); ++i) {
      if (part.rays[i] >= rays_.points.size())
        rays_.check(part.rays[i], entry_name(entry_name("parts", k) + ".rays", i));
      if (!written_out_.add(rays_.points[part.rays[i]], read_))
        fail_as_too_much(rays_, entry_name(entry_name("parts", k) + ".rays", i));
    }
  }
}

void Contents::check_weak() const {
  const std::size_t fragments = covering_.fragments.size(), sources = weak_.sources.size(), lines = weak_.lines.size();
  for (std::size_t k = 0; k < lines; ++k) {
    const Weak_certificate::Edge& line = weak_.lines[k];
    check_below(line.fragment, fragments, entry_name("lines", k));
    check_below(line.corner, covering_.fragments[line.fragment].vertices.size(), entry_name("lines", k));
  }
  for (std::size_t k = 0; k < weak_.visible.size(); ++k) {
    check_below(weak_.visible[k].fragment, fragments, entry_name("visible", k) + ".fragment");
    check_below(weak_.visible[k].source, sources, entry_name("visible", k) + ".source");
  }
  for (std::size_t k = 0; k < weak_.hidden.size(); ++k) {
    const Weak_certificate::Hidden& hidden = weak_.hidden[k];
    const std::string at = entry_name("hidden", k);
    check_below(hidden.fragment, fragments, at + ".fragment");
    for (std::size_t i = 0; i < hidden.also.size(); ++i)
      if (hidden.also[i] >= fragments) check_below(hidden.also[i], fragments, entry_name(at + ".also", i));
    check_below(hidden.source, sources, at + ".source");
    for (std::size_t i = 0; i < hidden.proof.size(); ++i) {
      using Kind = Weak_certificate::Node::Kind;
      const Weak_certificate::Node& node = hidden.proof[i];
      const auto place = [&] { return entry_name(at + ".proof", i) + "[1]"; };
      if (node.kind == Kind::line && node.index >= lines) check_below(node.index, lines, place());
      if (node.kind == Kind::blocked && node.index >= fragments) check_below(node.index, fragments, place());
      for (std::size_t t = 0; t < node.terms.size(); ++t)
        if (node.terms[t].line >= lines) check_below(node.terms[t].line, lines, entry_name(place(), t) + "[0]");
    }
  }
}

void Contents::check_along() const {
  const std::vector<Order_fragment>& fragments = covering_.fragments;
  const auto check_range = [&](const Along_certificate::Range& of, const std::string& at) {
    check_below(of.low, along_.moments.size(), at);
    check_below(of.high, along_.moments.size(), at);
  };
  const auto check_side = [&](const Along_certificate::Side& of, const std::string& at) {
    check_below(of.fragment, fragments.size(), at);
    if (of.kind == Along_certificate::Side::Kind::edge)
      check_below(of.corner, fragments[of.fragment].vertices.size(), at);
  };
  for (std::size_t k = 0; k < along_.faces.size(); ++k)
    for (const Along_certificate::Range& seen : along_.faces[k].seen)
      check_range(seen, entry_name("faces", k) + ".seen");
  for (std::size_t k = 0; k < along_.proofs.size(); ++k) {
    const Along_certificate::Proof& proof = along_.proofs[k];
    const std::string at = entry_name("proofs", k);
    check_below(proof.fragment, fragments.size(), at + ".fragment");
    check_range(proof.range, at + ".moments");
    for (const Along_certificate::Side& of : proof.cone) check_side(of, at + ".cone");
    for (const Along_certificate::Node& node : proof.tree)
      if (node.is_cut) check_side(node.cut, at + ".tree");
      else check_below(node.blocked, fragments.size(), at + ".tree");
  }
}

namespace {
struct Kind {
  std::string_view name;
  char newest;  ///< of its formats, which begin with 1
  std::vector<std::string_view> needed, optional;
};
const std::array<Kind, 5>& kinds() {
  static const std::array<Kind, 5> all{
      {{"order", '2', {"eye"}, {"on_view", "depths", "cuts"}},
       {"graph", '2', {"sizes", "arcs"}, {}},
       {"see", '2', {"eye", "parts", "empty"}, {"field", "rays"}},
       {"weak", '4', {"sources", "lines", "visible", "hidden"}, {"two_sided", "undecided"}},
       {"along", '2', {"path", "moments", "faces", "proofs"}, {"two_sided"}}}};
  return all;
}

}  // namespace

Certificate Contents::finish(const std::vector<std::pair<std::string, std::optional<Certificate_error>>>& keys) {
  // 1. Its kind.
  const auto has = [&](std::string_view key) {
    return std::any_of(keys.begin(), keys.end(), [&](const auto& known) { return known.first == key; });
  };
  if (!has("format")) fail("top level", "no \"format\"");
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& known) {
    const std::string begin = "sightline " + std::string(known.name) + ' ';
    return format_.size() == begin.size() + 1 && format_.starts_with(begin) && '1' <= format_.back() &&
           format_.back() <= known.newest;
  });
  if (kind == kinds().end())
    fail("format",
         "expected \"sightline order 2\", or graph, see, weak or along in its place, or 1 in that of 2; or \"sightline "
         "weak "
         "4\"");

  // 2. Nothing is wrong below the keys that it has, and none is missing.
  std::vector<std::string_view> needed = {"fragments"}, known = {"points", "pieces", "set_aside"};
  needed.insert(needed.begin(), kind->needed.begin(), kind->needed.end());
  known.insert(known.end(), kind->optional.begin(), kind->optional.end());
  known.insert(known.end(), needed.begin(), needed.end());
  for (const auto& [key, fault] : keys)
    if (fault && std::find(known.begin(), known.end(), key) != known.end()) throw *fault;
  for (const std::string_view key : needed)
    if (!has(key)) fail("top level", "no \"" + std::string(key) + '"');

  // 3. What refers to something refers to what there is.
  const auto of_this_kind = [&](Table& table) {
    std::erase_if(table.late, [&](const Table::Late& late) {
      const std::string name = name_of(late.place);
      return std::find(known.begin(), known.end(), std::string_view(name).substr(0, name.find('['))) == known.end();
    });
  };
  of_this_kind(points_);
  of_this_kind(rays_);
  put_late(points_);
  put_late(rays_);
  if (kind->name == "graph") check_graph();
  if (kind->name == "see") check_parts();
  if (kind->name == "weak") check_weak();
  if (kind->name == "along") check_along();

  // 4. The certificate.
  const auto with_covering = [&](auto&& certificate) -> Certificate {
    static_cast<Covering&>(certificate) = std::move(covering_);
    return std::move(certificate);
  };
  if (kind->name == "graph") return with_covering(std::move(graph_));
  weak_.two_sided = along_.two_sided = two_sided_;
  if (kind->name == "weak") return with_covering(std::move(weak_));
  if (kind->name == "along") return with_covering(std::move(along_));
  if (kind->name == "see") {
    visible_.eye = std::move(eye_);
    visible_.rays = std::move(rays_.points);
    return with_covering(std::move(visible_));
  }
  Order_certificate order;
  order.eye = std::move(eye_);
  order.on_view = on_view_;
  order.cuts = std::move(cuts_);
  return with_covering(std::move(order));
}

}  // namespace sightline::certificate_json
