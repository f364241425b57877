// Certificates of weak visibility, damaged at random: rejected, or still true, which is shown by shooting
// (weak_scenes.h).

#include "weak_scenes.h"

#include <map>

namespace weak_test {

namespace {

class Damage {
 public:
  Damage(Weak_certificate& certificate, Dice& dice) : c(certificate), dice_(dice) {}

  /// Does one thing to the certificate, and says which kind it was; empty if there was nothing to do it to.
  std::string once() {
    static constexpr std::array kinds = {
        &Damage::leafs_face,   &Damage::multiplier,      &Damage::order_of_children, &Damage::end_point,
        &Damage::plane,  // twice as often as the others
        &Damage::leafs_face,   &Damage::multiplier,      &Damage::order_of_children, &Damage::end_point,
        &Damage::plane,        &Damage::node_lost,       &Damage::node_doubled,      &Damage::nodes_line,
        &Damage::line,         &Damage::nodes_kind,      &Damage::source_vertex,     &Damage::source_turned,
        &Damage::entrys_index, &Damage::others,          &Damage::entry_lost,        &Damage::two_sided,
        &Damage::undecided,    &Damage::fragment_vertex, &Damage::multipliers_form,  &Damage::term_lost};
    return (this->*kinds[below(kinds.size())])();
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(dice_() % n); }
  Rational change() {
    const Rational size = std::array<Rational, 4>{Rational(1), ratio(1, 5), tiny(10), tiny(70)}[below(4)];
    return below(2) == 0 ? size : Rational(-size);
  }
  std::vector<Node*> nodes(const std::function<bool(const Node&)>& wanted) {
    std::vector<Node*> result;
    for (auto& entry : c.hidden)
      for (Node& n : entry.proof)
        if (wanted(n)) result.push_back(&n);
    return result;
  }
  Node* some_node(const std::function<bool(const Node&)>& wanted) {
    const std::vector<Node*> found = nodes(wanted);
    return found.empty() ? nullptr : found[below(found.size())];
  }
  Term* some_term() {
    Node* n = some_node([](const Node& m) { return !m.terms.empty(); });
    return n == nullptr ? nullptr : &n->terms[below(n->terms.size())];
  }

  std::string leafs_face() {
    Node* n = some_node([](const Node& m) { return m.kind == Kind::blocked; });
    if (n == nullptr) return "";
    n->index = below(c.fragments.size() + 1);
    return "leaf's face";
  }
  std::string multiplier() {
    Term* t = some_term();
    if (t == nullptr) return "";
    const std::size_t kind = below(5);
    if (kind == 0) t->factor = -t->factor;
    if (kind == 1) t->factor *= ratio(roll(dice_, 0, 9), roll(dice_, 1, 9));
    if (kind == 2) t->factor += change();
    if (kind == 3) t->factor *= 1 + change() / 100;
    if (kind == 4) t->line = below(c.lines.size() + 1);
    return "multiplier";
  }
  std::string multipliers_form() {
    Term* t = some_term();
    if (t == nullptr) return "";
    std::optional<Form>& f = below(2) == 0 ? t->source : t->target;
    if (!f) f = form(0, 0, 0, 1);
    if (below(6) == 0) f.reset();
    else (*f)[below(4)] += change();
    return "form";
  }
  std::string term_lost() {
    Node* n = some_node([](const Node& m) { return !m.terms.empty(); });
    if (n == nullptr) return "";
    n->terms.erase(n->terms.begin() + static_cast<std::ptrdiff_t>(below(n->terms.size())));
    return "term lost";
  }
  /// The end of the subtree that begins at i.
  static std::size_t end_of(const Proof& proof, std::size_t i) {
    for (std::size_t open = 1; open > 0 && i < proof.size(); ++i) {
      const bool is_leaf =
          proof[i].kind == Kind::blocked || proof[i].kind == Kind::empty || proof[i].kind == Kind::away;
      open = is_leaf ? open - 1 : open + 1;
    }
    return i;
  }
  std::string order_of_children() {
    Proof& proof = c.hidden[below(c.hidden.size())].proof;
    const std::size_t i = below(proof.size());
    if (i >= proof.size() || proof[i].kind == Kind::blocked || proof[i].kind == Kind::empty ||
        proof[i].kind == Kind::away)
      return "";
    const std::size_t middle = end_of(proof, i + 1), end = end_of(proof, middle);
    std::rotate(proof.begin() + static_cast<std::ptrdiff_t>(i + 1), proof.begin() + static_cast<std::ptrdiff_t>(middle),
                proof.begin() + static_cast<std::ptrdiff_t>(end));
    return "order of children";
  }
  std::string node_lost() {
    Proof& proof = c.hidden[below(c.hidden.size())].proof;
    if (proof.empty()) return "";
    proof.erase(proof.begin() + static_cast<std::ptrdiff_t>(below(proof.size())));
    return "node lost";
  }
  std::string node_doubled() {
    Proof& proof = c.hidden[below(c.hidden.size())].proof;
    if (proof.empty()) return "";
    const Node twice = proof[below(proof.size())];
    proof.insert(proof.begin() + static_cast<std::ptrdiff_t>(below(proof.size() + 1)), twice);
    return "node doubled";
  }
  std::string nodes_line() {
    Node* n = some_node([](const Node& m) { return m.kind == Kind::line; });
    if (n == nullptr) return "";
    n->index = below(c.lines.size() + 1);
    return "node's line";
  }
  std::string line() {
    if (c.lines.empty()) return "";
    auto& edge = c.lines[below(c.lines.size())];
    if (below(3) == 0) edge.fragment = below(c.fragments.size() + 1);
    else edge.corner = below(5);
    return "line";
  }
  std::string plane() {
    Node* n = some_node([](const Node& m) { return m.kind == Kind::cut_source || m.kind == Kind::cut_target; });
    if (n == nullptr) return "";
    const std::size_t kind = below(4);
    if (kind == 0)
      for (Rational& r : n->plane) r = -r;
    if (kind == 1) n->plane = form(roll(dice_, -1, 1), roll(dice_, -1, 1), roll(dice_, -1, 1), roll(dice_, -1, 1));
    if (kind > 1) n->plane[below(4)] += change();
    return "plane";
  }
  std::string nodes_kind() {
    Node* n = some_node([](const Node&) { return true; });
    if (n == nullptr) return "";
    n->kind =
        std::array{Kind::line, Kind::cut_source, Kind::cut_target, Kind::blocked, Kind::empty, Kind::away}[below(6)];
    return "node's kind";
  }
  std::string end_point() {
    if (c.visible.empty()) return "";
    auto& sightline = c.visible[below(c.visible.size())];
    Exact_point& p = below(2) == 0 ? sightline.from : sightline.to;
    p[below(3)] += change();
    return "end point";
  }
  std::string source_vertex() {
    Points& polygon = c.sources[below(c.sources.size())];
    polygon[below(polygon.size())][below(3)] += change();
    return "source vertex";
  }
  std::string source_turned() {
    Points& polygon = c.sources[below(c.sources.size())];
    std::reverse(polygon.begin(), polygon.end());
    return "source turned";
  }
  std::string entrys_index() {
    auto& entry = c.hidden[below(c.hidden.size())];
    const std::size_t kind = below(4);
    if (kind == 0) entry.source = below(c.sources.size() + 1);
    if (kind == 1) entry.fragment = below(c.fragments.size() + 1);
    if (kind == 2) std::swap(entry.fragment, c.hidden[below(c.hidden.size())].fragment);
    if (kind == 3) {
      if (c.visible.empty()) return "";
      c.visible[0].fragment = below(c.fragments.size() + 1);
    }
    return "entry's index";
  }
  std::string others() {
    auto& entry = c.hidden[below(c.hidden.size())];
    if (!entry.also.empty() && below(2) == 0) entry.also.pop_back();
    else entry.also.push_back(below(c.fragments.size() + 1));
    return "others";
  }
  std::string entry_lost() {
    if (!c.visible.empty() && below(2) == 0) c.visible.pop_back();
    else c.hidden.erase(c.hidden.begin() + static_cast<std::ptrdiff_t>(below(c.hidden.size())));
    return "entry lost";
  }
  std::string two_sided() {
    c.two_sided = !c.two_sided;
    return "two-sided";
  }
  std::string undecided() {
    if (!c.undecided.empty() && below(2) == 0) c.undecided.pop_back();
    else c.undecided.push_back(static_cast<Face_id>(below(5)));
    return "undecided";
  }
  std::string fragment_vertex() {
    Points& polygon = c.fragments[below(c.fragments.size())].vertices;
    if (below(2) == 0) polygon[below(polygon.size())][below(3)] += change();
    else std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    return "fragment vertex";
  }

  Weak_certificate& c;
  Dice& dice_;
};

TEST(Weak_mutations, are_rejected_or_true) {
  const auto scenes = all_scenes();
  std::map<std::string, std::array<std::size_t, 2>> counts;  // rejected, accepted and true
  std::size_t rejected = 0, harmless = 0;
  for (unsigned seed = 0; seed < 12000 / share; ++seed) {
    Dice dice(seed);
    const auto& [what, base] = scenes[seed % scenes.size()];
    Weak_scene scene = base;
    const std::string kind = Damage(scene.certificate, dice).once();
    if (kind.empty()) continue;
    if (roll(dice, 0, 3) == 0) Damage(scene.certificate, dice).once();
    const Verdict verdict = scene.verdict();
    EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
    EXPECT_FALSE(verdict.why.empty());
    for (const std::size_t f : verdict.fragments) EXPECT_LT(f, scene.certificate.fragments.size());
    ++counts[kind][verdict.accepted ? 1 : 0];
    ++(verdict.accepted ? harmless : rejected);
    if (!verdict.accepted) continue;
    EXPECT_EQ(Judge(scene.certificate).fault(dice, 40), "")
        << what << ", " << kind << ", seed " << seed << ": " << verdict.why;
  }
  EXPECT_GT(rejected, 5000 / share);
  EXPECT_GT(harmless, 500 / share);
  for (const auto& [kind, of] : counts)
    std::cout << "    " << kind << ": " << of[0] << " rejected, " << of[1] << " harmless\n";
}

/// Random blockers between two triangles: a blocking leaf is right iff, for each two corners, the segment meets the
/// blocker.
TEST(Weak_mutations, of_blockers_on_a_small_grid_are_judged_as_by_segments) {
  std::size_t accepted = 0, rejected = 0;
  for (unsigned seed = 0; seed < 4000 / share; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const auto corner = [&](long reach, long low, long high) {
      return at(roll(dice, -reach, reach), roll(dice, -reach, reach), roll(dice, low, high));
    };
    const auto triangle = [&](long reach, long low, long high) {
      Points corners;
      do corners = {corner(reach, low, high), corner(reach, low, high), corner(reach, low, high)};
      while (Judged(corners).normal == at(0, 0, 0));
      return corners;
    };
    const Points source = triangle(1, 0, 1), target = triangle(1, 4, 5),
                 blocker = roll(dice, 0, 1) == 0 ? triangle(4, 1, 4) : triangle(9, 2, 3);
    Weak_scene scene;
    scene.from(source).face(target);
    scene.face(blocker);
    scene.certificate.undecided = {1};
    scene.hide(0, {blocked(1)});
    const Judged judged(blocker);
    int front = 0, back = 0;
    for (const Exact_point& p : source) {
      front += judged.above(p);
      back += std::abs(judged.above(p));
    }
    int front_of_target = 0, back_of_target = 0;
    for (const Exact_point& q : target) {
      front_of_target += judged.above(q);
      back_of_target += std::abs(judged.above(q));
    }
    bool right = back > 0 && back_of_target > 0 && std::abs(front) == back &&
                 std::abs(front_of_target) == back_of_target && front * front_of_target < 0;
    bool borderline = false;  // a segment in the blocker's plane
    for (const Exact_point& p : source)
      for (const Exact_point& q : target) {
        borderline = borderline || (judged.above(p) == 0 && judged.above(q) == 0);
        right = right && !judged.meetings(p, q).empty();
      }
    if (borderline) continue;
    const Verdict verdict = scene.verdict();
    EXPECT_EQ(verdict.accepted, right) << verdict.why;
    ++(right ? accepted : rejected);
  }
  EXPECT_GT(accepted, 300 / share);
  EXPECT_GT(rejected, 300 / share);
}

}  // namespace

}  // namespace weak_test
