#pragma once
// What files hold rarely: counts and numbers where a type of numbers ends, line ends before data, names that come
// twice, brushes far beyond the numbers of their planes, and tables, scenes and levels told in parts.

#include "decimal.h"
#include "long_rows.h"
#include "readers.h"
#include "support.h"
#include "written.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/grid.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/io/binary.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/materials.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/io/quake_map.h>
#include <sightline/io/visibility_table.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

// ---- Fingerprints

/// What a scene is, in lists that can be changed.
struct Listed_scene {
  std::vector<Exact_point> points;
  std::vector<std::vector<std::vector<Point_id>>> faces;  ///< each of loops, the first and its holes
  friend bool operator==(const Listed_scene&, const Listed_scene&) = default;

  /// `otherwise`: points that doubles hold are added as such, the others by numerators that are not reduced.
  Polygon_soup soup(bool otherwise) const {
    Polygon_soup soup;
    for (const Exact_point& p : points) {
      const Integer q = 6 * lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den());
      if (!otherwise) soup.add_point(p[0], p[1], p[2]);
      else if (p == exact({p[0].get_d(), p[1].get_d(), p[2].get_d()}))
        soup.add_point(p[0].get_d(), p[1].get_d(), p[2].get_d());
      else {
        std::array<std::int64_t, 3> numerators{};
        for (std::size_t k = 0; k < 3; ++k) numerators[k] = Rational(p[k] * q).get_num().get_si();
        soup.add_point(numerators, q.get_si());
      }
    }
    for (const auto& loops : faces) {
      soup.add_face(loops[0]);
      for (std::size_t k = 1; k < loops.size(); ++k) soup.add_hole(loops[k]);
    }
    return soup;
  }
};

/// A few faces, no two loops of which are the same.
inline Listed_scene any_listed_scene(generate::Random& random) {
  Listed_scene scene;
  for (std::size_t k = 3 + random.below(6); k > 0; --k) {
    Exact_point& p = scene.points.emplace_back();
    for (Rational& x : p) x = generate::ratio(random.between(-9, 9), random.chance(1, 2) ? 4 : random.between(1, 9));
  }
  std::set<std::vector<Point_id>> known;
  for (std::size_t f = random.below(5); f > 0; --f) {
    auto& loops = scene.faces.emplace_back();
    for (std::size_t k = 1 + (random.chance(1, 2) ? random.below(3) : 0); k > 0; --k) {
      std::vector<Point_id> loop;
      do loop.push_back(static_cast<Point_id>(random.below(scene.points.size())));
      while (loop.size() < 3 || random.chance(1, 2) || known.count(loop) > 0);
      known.insert(loop);
      loops.push_back(std::move(loop));
    }
  }
  return scene;
}

/// One thing of it is another, less, more or elsewhere; or nothing is, where there is none of that kind.
inline void change_one_thing(Listed_scene& scene, generate::Random& random) {
  const auto any_of = [&](auto& items) {
    return items.begin() + static_cast<std::ptrdiff_t>(random.below(items.size()));
  };
  const std::uint64_t kind = random.below(16);
  if (kind == 0) (*any_of(scene.points))[random.below(3)] += generate::ratio(1, random.between(1, 1000000000));
  if (kind == 1) (*any_of(scene.points))[random.below(3)] *= -1;
  if (kind == 2) std::swap(*any_of(scene.points), *any_of(scene.points));
  if (kind == 3) std::rotate(scene.points[0].begin(), scene.points[0].begin() + 1, scene.points[0].end());
  if (kind == 4) scene.points.push_back(*any_of(scene.points));
  if (kind == 5) scene.faces.push_back({{0, 1, 2}});
  if (kind < 6 || scene.faces.empty()) return;
  auto& face = *any_of(scene.faces);
  auto& loop = *any_of(face);
  if (kind == 6) *any_of(loop) = static_cast<Point_id>(random.below(scene.points.size()));
  if (kind == 7) loop.insert(any_of(loop), static_cast<Point_id>(random.below(scene.points.size())));
  if (kind == 8) loop.erase(any_of(loop));
  if (kind == 9) std::reverse(loop.begin(), loop.end());
  if (kind == 10) std::rotate(loop.begin(), any_of(loop), loop.end());
  if (kind == 11) face.push_back(loop);
  if (kind == 12 && face.size() > 1) face.erase(any_of(face));
  if (kind == 13) std::swap(loop, *any_of(face));
  if (kind == 14) std::swap(face, *any_of(scene.faces));
  if (kind == 15 && face.size() > 1) {  // a hole is a face of its own
    const std::vector<std::vector<Point_id>> own{face.back()};
    face.pop_back();
    scene.faces.insert(scene.faces.begin() + (&face - scene.faces.data()) + 1, own);
  }
}

/// A scene has the number that it has, however it was made; and another one as soon as anything of it is another.
inline void try_fingerprints(generate::Random& random) {
  const Listed_scene scene = any_listed_scene(random);
  const std::uint64_t own = fingerprint(scene.soup(false));
  require(fingerprint(scene.soup(true)) == own, "equal scenes have one fingerprint");
  for (int times = 0; times < 8; ++times) {
    Listed_scene other = scene;
    change_one_thing(other, random);
    require((fingerprint(other.soup(random.chance(1, 2))) == own) == (other == scene),
            "another scene has another fingerprint");
  }
}

// ---- Tables in parts

inline bool same_table(const Visibility_table& a, const Visibility_table& b) {
  const auto same_row = [](const Visibility_table::Row& r, const Visibility_table::Row& s) {
    return r.visible == s.visible && r.undecided == s.undecided && r.cells == s.cells &&
           r.cells_undecided == s.cells_undecided;
  };
  return a.question == b.question && a.cells == b.cells && a.faces == b.faces && a.lower_cells == b.lower_cells &&
         std::equal(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(), same_row);
}

/// A table is read as it was written, also without the sum that older programs did not write; with one byte changed, or
/// some missing at the end, it is refused.
inline void require_read_and_guarded(const Visibility_table& table, generate::Random& random) {
  const std::string bytes = table_bytes(table);
  require(same_table(sightline::read_table({"table", bytes}), table), "a table is read as it was written");
  std::string older = bytes.substr(0, bytes.size() - 8), changed = bytes;
  older[std::string_view("sightline pvs ").size()] -= 2;
  require(same_table(sightline::read_table({"older", older}), table), "a table of an older program is read");
  const std::size_t at = random.below(bytes.size());
  changed[at] = static_cast<char>(changed[at] ^ static_cast<char>(random.between(1, 255)));
  for (const std::string& damaged : {changed, bytes.substr(0, at)})
    require(is_refused<Input_error>([&] {
              sightline::read_table({"damaged", damaged});
            }),
            "a damaged table is refused");
}

/// A table of many cells and faces, of which few were asked about, or none, and fewer are seen.
inline void try_long_table(generate::Random& random) {
  const bool none_asked = random.chance(1, 4);
  const std::size_t most = none_asked ? 200001 : 20001, cells = random.below(random.chance(1, 2) ? 4 : most),
                    faces = random.below(most);
  Visibility_table table{"?", std::vector<bool>(cells), std::vector<bool>(faces), {}};
  if (!none_asked) {
    table.cells = any_long_row(cells, random);
    table.faces = any_long_row(faces, random);
  }
  if (random.chance(1, 2)) table.lower_cells = any_long_row(cells, random);
  std::vector<std::uint32_t> asked;
  for (std::uint32_t c = 0; c < cells; ++c)
    if (table.cells[c]) asked.push_back(c);
  table.rows.resize(asked.size());
  for (Visibility_table::Row& row : table.rows)
    for (std::uint32_t f = 0; f < faces; ++f)
      if (table.faces[f] && random.chance(1, 3)) (random.chance(2, 3) ? row.visible : row.undecided).push_back(f);
  for (std::size_t r = 0; r < asked.size(); ++r)
    for (std::size_t s = r + 1; s < asked.size(); ++s)
      if (table.has_cells() && table.lower_cells[asked[r]] && random.chance(1, 3)) {
        const auto list = random.chance(2, 3) ? &Visibility_table::Row::cells : &Visibility_table::Row::cells_undecided;
        (table.rows[r].*list).push_back(asked[s]);
        (table.rows[s].*list).push_back(asked[r]);
      }
  require_read_and_guarded(table, random);
}

/// A table whose faces and pairs of cells are dealt out anyhow: put together in any order, and in steps, it is the
/// same in all its parts. What is in two parts, and what is in none, is refused.
inline void try_dealt_table(generate::Random& random) {
  const std::size_t cells = 1 + random.below(12), faces = random.below(20), count = 1 + random.below(5);
  const bool has_cells = random.chance(3, 4);
  Visibility_table whole{"which see which", {}, std::vector<bool>(faces, true), {}};
  for (std::size_t c = 0; c < cells; ++c) whole.cells.push_back(random.chance(3, 4));
  if (has_cells) whole.lower_cells.assign(cells, true);
  // 1. Who has which face, and which lower cell of pairs.
  std::vector<std::size_t> of_face, of_cell;
  for (std::size_t f = 0; f < faces; ++f) of_face.push_back(random.below(count));
  for (std::size_t c = 0; c < whole.lower_cells.size(); ++c) of_cell.push_back(random.below(count));
  std::vector<Visibility_table> parts(count, whole);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t f = 0; f < faces; ++f) parts[i].faces[f] = of_face[f] == i;
    for (std::size_t c = 0; c < of_cell.size(); ++c) parts[i].lower_cells[c] = of_cell[c] == i;
    names.push_back("part " + std::to_string(i));
  }
  // 2. Rows.
  std::map<std::array<std::size_t, 2>, std::uint64_t> seen;
  for (std::size_t c = 0; c < cells; ++c) {
    if (!whole.cells[c]) continue;
    whole.rows.emplace_back();
    for (Visibility_table& part : parts) part.rows.emplace_back();
    const auto add = [&](std::size_t part, auto visible, auto undecided, std::size_t number, std::uint64_t what) {
      for (Visibility_table* table : {&whole, &parts[part]})
        if (what < 2) (table->rows.back().*(what == 0 ? visible : undecided)).push_back(static_cast<Face_id>(number));
    };
    using Row = Visibility_table::Row;
    for (std::size_t f = 0; f < faces; ++f) add(of_face[f], &Row::visible, &Row::undecided, f, random.below(3));
    for (std::size_t other = 0; other < of_cell.size(); ++other)
      if (other != c && whole.cells[other]) {
        const std::size_t lower = std::min(c, other);
        add(of_cell[lower], &Row::cells, &Row::cells_undecided, other,
            seen.try_emplace({lower, std::max(c, other)}, random.below(3)).first->second);
      }
  }
  require_read_and_guarded(whole, random);
  // 3. Together, at once and two by two.
  random.shuffle(parts);
  if (random.chance(1, 2))
    for (Visibility_table& part : parts) part = sightline::read_table({"part", table_bytes(part)});
  require(same_table(merged(parts, names), whole), "parts are the table again");
  std::vector<Visibility_table> heaps = parts;
  while (heaps.size() > 1) {
    const std::size_t into = random.below(heaps.size() - 1);
    heaps[into] = joined({heaps[into], heaps.back()}, names);
    heaps.pop_back();
  }
  require(same_table(heaps[0], whole), "parts of parts are the table again");
  // 4. One twice, and one less.
  const std::size_t chosen = random.below(count);
  const auto has_any = [](const std::vector<bool>& bits) { return std::count(bits.begin(), bits.end(), true) > 0; };
  const bool is_empty = !has_any(parts[chosen].faces) && !has_any(parts[chosen].lower_cells);
  names.emplace_back("one more");
  std::vector<Visibility_table> twice = parts, less = parts;
  twice.push_back(parts[chosen]);
  less.erase(less.begin() + static_cast<std::ptrdiff_t>(chosen));
  require(is_refused<Merge_error>([&] { joined(twice, names); }) == !is_empty, "what is in two parts is refused");
  require(is_refused<Merge_error>([&] { merged(less, names); }) == (!is_empty || count == 1),
          "what is in no part is refused");
  // 5. One that answers something else.
  std::vector<Visibility_table> others = parts;
  Visibility_table& other = others[chosen];
  switch (random.below(4)) {
    case 0: other.question += "?"; break;
    case 1:
      other.cells.flip();
      other.rows.clear();
      for (const bool is_asked : other.cells)
        if (is_asked) other.rows.emplace_back();
      break;
    case 2: other.faces.push_back(true); break;
    default: other.lower_cells.resize(has_cells ? 0 : cells);
  }
  require(is_refused<Merge_error>([&] { joined(others, names); }) == (count > 1),
          "parts of other questions, cells, faces or pairs are refused");
}

/// Faces go round among shards, of which some are missing: those are named, where a part that is there has two faces.
inline void try_missing_shards(generate::Random& random) {
  const std::size_t shards = 1 + random.below(6), faces = random.below(3 * shards);
  std::vector<Visibility_table> parts;
  std::vector<std::string> names;
  std::string missing;
  bool is_told = false;
  for (std::size_t s = 0; s < shards; ++s) {
    Visibility_table part{"which see which", {true}, std::vector<bool>(faces), {{}}};
    for (std::size_t f = s; f < faces; f += shards) part.faces[f] = true;
    if (random.chance(2, 3)) {
      is_told = is_told || s + shards < faces;
      names.push_back("part " + std::to_string(s));
      parts.push_back(std::move(part));
    } else if (s < faces) {
      missing += (missing.empty() ? "" : ", ") + std::to_string(s) + "/" + std::to_string(shards);
    }
  }
  if (parts.empty()) return;
  std::string said;
  try {
    merged(parts, names);
  } catch (const Merge_error& error) {
    said = error.what();
  }
  require(said.empty() == missing.empty(), "all faces are there iff no shard is missing");
  if (is_told && !said.empty())
    require(said.ends_with("run again --shard " + missing), "the shards that are missing are named");
}

// ---- Leaves

/// Leaves see what their cells see or may see, by any table of pairs; and each cell is in the box of its leaf.
inline void try_rows_of_leaves(generate::Random& random) {
  std::array<std::uint32_t, 3> counts{};
  for (std::uint32_t& n : counts) n = 1 + static_cast<std::uint32_t>(random.below(3));
  generate::Faces faces{{{-5, -5, -5}, {5, 5, 5}, {5, -5, 5}}};
  if (random.chance(1, 2))
    faces.push_back({generate::lattice(random, 4), generate::lattice(random, 4), generate::lattice(random, 4)});
  const Polygon_soup soup = generate::soup_of(faces);
  Cell_options options;
  options.threads = 1;
  options.tree = even_boxes(soup, counts);
  const Level_cells level(soup, options);
  const auto cells = static_cast<Cell_id>(level.cells().size());
  const std::size_t leaves = counts[0] * counts[1] * counts[2];
  for (Cell_id c = 0; c < cells; ++c) {
    const Exact_point inside = level.inside(c);
    std::size_t rest = level.cells()[c].leaf;
    require(rest < leaves, "a cell is in a leaf");
    for (std::size_t k = 0; k < 3; rest /= counts[k++]) {
      const auto box = static_cast<std::int64_t>(rest % counts[k]), all = static_cast<std::int64_t>(counts[k]);
      require((box == 0 || inside[k] >= generate::ratio(10 * box, all) - 5) &&
                  (box + 1 == all || inside[k] <= generate::ratio(10 * (box + 1), all) - 5),
              "a cell is in the box of its leaf");
    }
  }
  for (int times = 0; times < 4; ++times) {
    Cell_pvs pvs{std::vector<char>(cells, 1),
                 std::vector<std::vector<Cell_id>>(cells),
                 std::vector<std::vector<Cell_id>>(cells),
                 {}};
    std::vector<std::vector<bool>> expected(leaves, std::vector<bool>(leaves));
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) expected[leaf][leaf] = true;
    const std::uint64_t share = random.below(9), decided = random.below(9);
    for (Cell_id c = 0; c < cells; ++c)
      for (Cell_id other = 0; other < c; ++other) {
        if (!random.chance(share, 8)) continue;
        auto& lists = random.chance(decided, 8) ? pvs.visible : pvs.undecided;
        lists[c].push_back(other);
        lists[other].push_back(c);
        const std::uint32_t a = level.cells()[c].leaf, b = level.cells()[other].leaf;
        expected[a][b] = expected[b][a] = true;
      }
    require(visible_leaves(level, pvs, leaves) == expected, "leaves see what their cells see, or may see");
  }
}

// ---- Nodes

/// A compiled level of any number of nodes, in any order, has the nodes that were written; one that names a leaf that
/// is not there, or a node twice, is refused.
inline void try_many_nodes(generate::Random& random, bool are_many) {
  Written_level written(random);
  const std::size_t most = 65536 - written.marked.size();
  std::size_t count = 1 + random.below(60);
  if (are_many)
    count = random.chance(1, 2) ? 32769 + random.below(most - 32768) : std::min(most, 32766 + random.below(5));
  if (are_many && random.chance(1, 4)) count = most;
  // 1. A tree: below the last node that is there, or below any; by its numbers.
  std::vector<std::int32_t> number(count);
  std::iota(number.begin(), number.end(), 0);
  random.shuffle(number);
  const auto named = [&](std::size_t node) { return static_cast<std::size_t>(number[node]); };
  written.children.assign(count, {});
  std::vector<std::array<std::size_t, 2>> free{{named(0), 0}, {named(0), 1}};
  const bool is_chain = random.chance(1, 2);
  for (std::size_t n = 1; n < count; ++n) {
    std::swap(free.back(), free[is_chain ? free.size() - 1 - random.below(2) : random.below(free.size())]);
    written.children[free.back()[0]][free.back()[1]] = number[n];
    free.pop_back();
    for (const std::size_t side : {0u, 1u}) free.push_back({named(n), side});
  }
  for (const auto& [node, side] : free)
    written.children[node][side] = -1 - static_cast<std::int32_t>(random.below(written.marked.size()));
  written.root = number[0];
  // 2. In place of the nodes that are there.
  written.lump[Written_level::lump_models].set(36, written.root);
  Level_bytes& nodes = written.lump[Written_level::lump_nodes];
  nodes.bytes.clear();
  for (std::size_t n = 0; n < count; ++n) {
    nodes.put(static_cast<std::uint32_t>(n % 2));
    for (const std::int32_t child : written.children[n]) nodes.put(static_cast<std::uint16_t>(child));
    nodes.bytes += std::string(16, '\0');
  }
  // 3. Or with a wrong child of one.
  const auto [node, side] = free[random.below(free.size())];
  const std::uint64_t kind = random.below(6);
  bool is_wrong = kind < 2;
  const std::size_t place = 24 * node + 4 + 2 * side;
  if (kind == 0) nodes.set(place, static_cast<std::uint16_t>(named(random.below(count))));  // twice, or the root
  if (kind == 1) {
    is_wrong = count < most;  // else it is the last node
    if (is_wrong) nodes.set(place, static_cast<std::uint16_t>(65535 - written.marked.size()));
  }
  const std::string file = written.file(random);
  if (is_wrong)
    return require(is_refused<Input_error>([&] {
                     read_quake_level({"nodes", file});
                   }),
                   "a level with a wrong child is refused");
  check_level(read_quake_level({"nodes", file}), written, written.rows);
}

// ---- Brushes

using Whole_rows = std::array<std::array<Integer, 3>, 3>;

inline Whole_rows product(const Whole_rows& a, const Whole_rows& b) {
  Whole_rows c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// A brush, moved and put through a map of whole numbers and determinant 1, has its corners where the map puts them:
/// planes have numbers of some bits, corners of up to three times as many. One that has no end is refused.
inline void try_far_brush(generate::Random& random) {
  // 1. The map, inverse to one of numbers that are hardly half as long.
  const std::int64_t most = std::int64_t{1} << random.below(16);
  Whole_rows lower{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, upper = lower;
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{1, 0}, {2, 0}, {2, 1}}) {
    lower[i][j] = static_cast<long>(random.between(-most, most));
    upper[j][i] = static_cast<long>(random.between(-most, most));
  }
  const auto inverse = [](const Whole_rows& of) {  // of what is 1 and triangular: 1 - N + N N
    Whole_rows n = of;
    for (std::size_t k = 0; k < 3; ++k) n[k][k] = 0;
    Whole_rows sum = product(n, n);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] += (i == j ? 1 : 0) - n[i][j];
    return sum;
  };
  const Whole_rows map = product(inverse(upper), inverse(lower));
  Exact_point way;
  for (Rational& x : way) x = random.chance(1, 2) ? 0 : static_cast<long>(random.between(-most, most));
  const auto mapped = [&](const Exact_point& p) {
    Exact_point q;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) q[i] += map[i][k] * (p[k] + way[k]);
    return q;
  };
  // 2. Its sides, each by three points; and its faces.
  std::vector<Half_space> sides = any_brush(random);
  if (random.chance(1, 4)) sides.pop_back();
  std::vector<Half_space> bounded = sides;  // by a box that is wider than any meets of its planes
  for (std::size_t k = 0; k < 3; ++k)
    for (const int sense : {-1, 1}) {
      bounded.push_back({{0, 0, 0}, 1000});
      bounded.back().normal[k] = sense;
    }
  const std::vector<std::set<Exact_point>> faces = faces_of_brush(bounded);
  if (faces.size() < 4) return;
  const bool has_end = std::none_of(faces.begin(), faces.end(), [](const std::set<Exact_point>& face) {
    return std::any_of(face.begin(), face.end(), [](const Exact_point& p) {
      return std::any_of(p.begin(), p.end(), [](const Rational& x) { return abs(x) == 1000; });
    });
  });
  std::string text = "{\n\"classname\" \"worldspawn\"\n{\n";
  for (const Half_space& h : sides) {
    for (const Exact_point& p : points_of(h, random)) {
      text += "( ";
      for (const Rational& x : mapped(p)) text += decimal_of(x) + " ";
      text += ") ";
    }
    text += "stone 0 0 0 1 1\n";
  }
  text += "}\n}\n";
  if (!has_end)
    return require(is_refused<Input_error>([&] {
                     sightline::read_map({"far", text});
                   }),
                   "a brush that has no end is refused");
  const Polygon_soup soup = sightline::read_map({"far", text});
  // 3. These are all, and look outwards.
  require(soup.face_count() == faces.size(), "a far brush has a face for each side");
  Exact_point middle;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::set<Exact_point>* face : {&faces[0], &faces[1]})
      for (const Exact_point& p : *face) middle[k] += p[k];
    middle[k] /= static_cast<unsigned long>(faces[0].size() + faces[1].size());
  }
  middle = mapped(middle);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::vector<Exact_point> loop;
    for (const Point_id p : soup.loop(f)) loop.push_back(soup.point(p));
    std::set<Exact_point> expected;
    for (const Exact_point& p : faces[f]) expected.insert(mapped(p));
    require(loop.size() == expected.size() && std::set<Exact_point>(loop.begin(), loop.end()) == expected,
            "a far brush has its corners where its planes meet");
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Exact_point &a = loop[k], &b = loop[(k + 1) % loop.size()], &c = loop[(k + 2) % loop.size()];
      require(dot(cross(minus(b, a), minus(c, b)), minus(a, middle)) > 0, "a far brush's faces look outwards");
    }
  }
}

// ---- PLY

struct Ply_form {
  std::array<const char*, 2> names;
  std::size_t bytes;
  std::int64_t least, most;  ///< none of floating ones
};
inline constexpr std::array<Ply_form, 8> ply_forms{{{{"char", "int8"}, 1, -128, 127},
                                                    {{"uchar", "uint8"}, 1, 0, 255},
                                                    {{"short", "int16"}, 2, -32768, 32767},
                                                    {{"ushort", "uint16"}, 2, 0, 65535},
                                                    {{"int", "int32"}, 4, -2147483648, 2147483647},
                                                    {{"uint", "uint32"}, 4, 0, 4294967295},
                                                    {{"float", "float32"}, 4, 0, 0},
                                                    {{"double", "float64"}, 8, 0, 0}}};

/// What the least significant bytes of `raw` say. Pre: finite.
inline Rational in_ply_form(std::size_t form, std::uint64_t raw) {
  if (form == 7) return exact(std::bit_cast<double>(raw));
  if (form == 6) return exact(double{std::bit_cast<float>(static_cast<std::uint32_t>(raw))});
  const auto bits = static_cast<int>(8 * ply_forms[form].bytes);
  auto value = static_cast<std::int64_t>(raw & ((std::uint64_t{1} << bits) - 1));
  if (value > ply_forms[form].most) value -= std::int64_t{1} << bits;
  return static_cast<long>(value);
}

struct Ply_columns {
  struct Column {
    std::string name;
    std::size_t form;
    std::optional<std::size_t> count_form = {};  ///< of a list
  };
  std::string name;
  std::vector<Column> columns;
  std::vector<std::vector<std::vector<std::uint64_t>>> rows;  ///< of each cell its numbers
};

/// Data after a header: in text (0), the least (1) or the most significant byte first (2).
inline std::string ply_file(const std::vector<Ply_columns>& elements, std::size_t encoding, std::string_view end,
                            generate::Random& random) {
  static constexpr std::array encodings{"ascii", "binary_little_endian", "binary_big_endian"};
  std::vector<std::string> header{"ply", std::string("format ") + encodings[encoding] + " 1.0"};
  const auto named = [&](std::size_t form) { return std::string(ply_forms[form].names[random.below(2)]) + " "; };
  for (const Ply_columns& element : elements) {
    if (random.chance(1, 4)) header.emplace_back("comment end_header");
    header.push_back("element " + element.name + " " + std::to_string(element.rows.size()));
    for (const auto& [name, form, count_form] : element.columns)
      header.push_back("property " + (count_form ? "list " + named(*count_form) : "") + named(form) + name);
  }
  header.emplace_back("end_header");
  std::string file;
  for (const std::string& line : header) (file += line) += end;
  const auto put = [&](std::size_t form, std::uint64_t raw) {
    for (std::size_t k = 0; k < ply_forms[form].bytes; ++k) {
      const std::size_t byte = encoding == 1 ? k : ply_forms[form].bytes - 1 - k;
      file += static_cast<char>(raw >> 8 * byte & 255);
    }
  };
  for (const Ply_columns& element : elements)
    for (const auto& row : element.rows) {
      std::string line;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const auto& [name, form, count_form] = element.columns[k];
        if (encoding == 0) {
          if (count_form) line += std::to_string(row[k].size()) + " ";
          for (const std::uint64_t raw : row[k]) line += decimal_text(in_ply_form(form, raw)).value() + " ";
        } else {
          if (count_form) put(*count_form, row[k].size());
          for (const std::uint64_t raw : row[k]) put(form, raw);
        }
      }
      if (encoding == 0) (file += line) += end;
    }
  return file;
}

/// Points and faces in numbers of all types, and others between them; as many of each as types hold or one more; line
/// ends of all kinds, and data that begin with a byte that is one. They are read as they were written, and so is what
/// the library writes of them.
inline void try_ply_forms(generate::Random& random, bool are_many) {
  const std::size_t encoding = random.below(are_many ? 2 : 3) + (are_many ? 1 : 0);
  static constexpr std::array<std::string_view, 3> ends{"\n", "\r\n", "\r"};
  static constexpr std::array<std::size_t, 7> small_bounds{127, 128, 254, 255, 256, 257, 258};
  static constexpr std::array<std::size_t, 5> large_bounds{32768, 65535, 65536, 65537, 32769};
  const auto number_of = [&](std::size_t usual) {
    return random.chance(1, 4) ? small_bounds[random.below(small_bounds.size())] : random.below(usual);
  };
  const std::size_t points = are_many ? large_bounds[random.below(large_bounds.size())] : 1 + number_of(20);
  const auto holding = [&](std::size_t most) {
    for (;;)
      if (const std::size_t form = random.below(6); most <= static_cast<std::size_t>(ply_forms[form].most)) return form;
  };
  // 1. Columns, in any order.
  Ply_columns vertex{"vertex", {}, {}}, face{"face", {}, {}};
  const std::size_t of_all = random.below(8);
  for (const char* name : {"x", "y", "z"})
    vertex.columns.push_back({name, random.chance(1, 2) ? of_all : random.below(8)});
  face.columns.push_back({random.chance(1, 2) ? "vertex_index" : "vertex_indices", holding(points - 1), {}});
  std::vector<std::size_t> corners;
  for (std::size_t f = are_many ? 3 : number_of(6); f > 0; --f) corners.push_back(number_of(8));
  const char first = random.chance(1, 2) ? '\n' : '\r';  // a byte that the data may begin with
  const bool begins_so = random.chance(2, 3), is_face_first = random.chance(1, 3);
  if (begins_so && is_face_first && !corners.empty()) corners[0] = static_cast<std::size_t>(first);
  face.columns[0].count_form = holding(corners.empty() ? 0 : *std::max_element(corners.begin(), corners.end()));
  for (Ply_columns* element : {&vertex, &face})
    for (std::size_t more = are_many ? 0 : random.below(3); more > 0; --more) {
      element->columns.push_back({"more" + std::to_string(more), random.below(8), {}});
      if (random.chance(1, 3)) element->columns.back().count_form = random.below(6);
    }
  for (Ply_columns* element : {&vertex, &face}) random.shuffle(element->columns);
  // 2. What is in them.
  const auto any_number = [&](std::size_t form) -> std::uint64_t {
    if (form == 7) return std::bit_cast<std::uint64_t>(std::ldexp(static_cast<double>(random.between(-99, 99)), -3));
    if (form == 6) return std::bit_cast<std::uint32_t>(std::ldexp(static_cast<float>(random.between(-99, 99)), -3));
    return random.below(random.chance(1, 2) ? 100 : std::uint64_t{1} << 32);
  };
  std::size_t at = 0;  // of corners
  for (Ply_columns* element : {&vertex, &face}) {
    element->rows.resize(element == &vertex ? points : corners.size());
    for (auto& row : element->rows)
      for (const auto& [name, form, count_form] : element->columns) {
        std::vector<std::uint64_t>& cell = row.emplace_back();
        const bool is_loop = name.starts_with("vertex_");
        const std::size_t size = is_loop ? corners[at++] : count_form ? random.below(4) : 1;
        for (std::size_t k = 0; k < size; ++k)
          cell.push_back(!is_loop ? any_number(form) : random.chance(1, 4) ? points - 1 : random.below(points));
      }
  }
  std::vector<Ply_columns> elements{vertex, face};
  if (is_face_first) std::swap(elements[0], elements[1]);
  if (auto& [name, columns, rows] = elements[0]; begins_so && !rows.empty() && !columns[0].count_form) {
    const std::size_t shift = encoding == 1 ? 0 : 8 * ply_forms[columns[0].form].bytes - 8;
    rows[0][0][0] = (rows[0][0][0] & ~(std::uint64_t{255} << shift)) | static_cast<std::uint64_t>(first) << shift;
  }
  // 3. Read, and written and read.
  const std::string file = ply_file(elements, encoding, ends[random.below(3)], random);
  const std::optional<Polygon_soup> soup = scene_in(file, Format::ply);
  require(soup.has_value(), "ply: what was written is read");
  require(soup->point_count() == points && soup->face_count() == corners.size(), "ply: it has its points and faces");
  for (const Ply_columns& element : elements)
    for (std::size_t k = 0; k < element.columns.size(); ++k) {
      const auto& [name, form, count_form] = element.columns[k];
      const std::size_t axis = name == "x" ? 0 : name == "y" ? 1 : 2;
      for (std::size_t i = 0; i < element.rows.size(); i += are_many && i > 0 && i + 9 < element.rows.size() ? 8 : 1) {
        const std::vector<std::uint64_t>& cell = element.rows[i][k];
        if (name.size() == 1)
          require(soup->coordinates[3 * i + axis] == in_ply_form(form, cell[0]), "ply: a coordinate is what it was");
        if (!name.starts_with("vertex_")) continue;
        const std::span<const Point_id> loop = soup->loop(static_cast<Face_id>(i));
        require(std::equal(loop.begin(), loop.end(), cell.begin(), cell.end()), "ply: a face has its corners");
      }
    }
  if (are_many) return;
  require(comes_back(*soup, Format::ply_binary), "ply: what is of doubles is written in binary");
  require(comes_back(*soup, Format::ply), "ply: what is of doubles is written in text");
}

// ---- Materials

/// Of a name in several materials, of one library or several, the first counts; of its lines the last. A name counts
/// from where a library that has it is named.
inline void try_repeated_materials(generate::Random& random) {
  static const Own_folder folder;
  static constexpr std::array<std::string_view, 4> names{"a", "b", "a b", "A"};
  // 1. Libraries.
  std::array<std::vector<Material>, 2> of_library;
  std::array<std::string, 2> names_of_library;
  for (std::size_t library = 0; library < 2; ++library) {
    const std::string number = std::to_string(library) + ".mtl";
    std::filesystem::remove(folder.path / ("twice" + number));
    std::filesystem::remove(folder.path / ("twice " + number));
    names_of_library[library] = (random.chance(1, 3) ? "twice " : "twice") + number;
    std::string text;
    for (std::size_t k = 1 + random.below(4); k > 0; --k) {
      Material& material = of_library[library].emplace_back();
      material.name = names[random.below(names.size())];
      text += "newmtl " + material.name + (random.chance(1, 4) ? " # again\n" : "\n");
      for (std::size_t line = random.below(4); line > 0; --line) {
        const double x = static_cast<double>(random.below(9)) / 8;
        if (random.chance(1, 2)) {
          material.colour = {x, 0.25, 1};
          text += "Kd " + std::to_string(x) + " 0.25 1\n";
        } else {
          material.opacity = x;
          text += "d " + std::to_string(x) + "\n";
        }
      }
    }
    std::ofstream(folder.path / names_of_library[library]) << text;
  }
  // 2. Faces.
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::map<std::string, Material, std::less<>> known;
  std::vector<std::optional<Material>> expected;
  std::optional<Material> current;
  bool is_wrong = false;
  for (std::size_t k = random.below(10); k > 0 && !is_wrong; --k) {
    const std::uint64_t kind = known.empty() && random.chance(3, 4) ? 0 : random.below(3);
    if (kind == 0) {
      // Both stand in one line only where no name has a blank.
      const std::size_t library = random.below(2);
      const bool both = random.chance(1, 3);
      obj += "mtllib " + names_of_library[library] + (both ? "  " + names_of_library[1 - library] : "") + "\n";
      for (const Material& material : of_library[library]) known.try_emplace(material.name, material);
      if (both)
        for (const Material& material : of_library[1 - library]) known.try_emplace(material.name, material);
      is_wrong = both && (names_of_library[0] + names_of_library[1]).find(' ') != std::string::npos;
    } else if (kind == 1) {
      const std::string_view name = names[random.below(names.size())];
      const auto found = known.find(name);
      if (found == known.end() && random.chance(3, 4)) continue;
      is_wrong = found == known.end();
      if (!is_wrong) current = found->second;
      obj += "usemtl " + std::string(name) + "\n";
    } else {
      obj += "f 1 2 3\n";
      expected.push_back(current);
    }
  }
  std::ofstream(folder.path / "twice.obj") << obj;
  std::vector<std::optional<Material>> found;
  const bool refused = is_refused<Input_error>([&] { found = read_materials(folder.path / "twice.obj"); });
  require(refused == is_wrong,
          "a material is refused iff no library so far has it, a library where there is no file of it");
  if (refused) return;
  const auto same = [](const std::optional<Material>& a, const std::optional<Material>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->name == b->name && a->colour == b->colour && a->opacity == b->opacity));
  };
  require(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same),
          "of materials of one name the first counts");
}

// ---- Decimals

/// A number of any size up to 10^1200, its point anywhere among its digits or zeros, and the exponent that takes that
/// back: exact, or refused as decimal.h says; and rounded to the nearest double, or refused where it is beyond them.
inline void try_decimal_sizes(generate::Random& random) {
  // 1. Digits, the place of the first, and that of the point.
  std::string digits;
  for (std::size_t k = 1 + random.below(random.chance(1, 2) ? 3 : 30); k > 0; --k)
    digits += static_cast<char>('0' + (digits.empty() ? random.between(1, 9) : random.between(0, 9)));
  static constexpr std::array<std::int64_t, 4> ends_of_doubles{-324, -308, 308, 309};
  const std::int64_t size = random.chance(1, 4) ? ends_of_doubles[random.below(4)] + random.between(-2, 2)
                                                : random.between(-1200, 1200);  // a power of ten
  const std::int64_t before = random.chance(1, 4)   ? size + 1                  // how many digits are before the point
                              : random.chance(1, 3) ? random.between(-2, 35)
                                                    : random.between(-1200, 1200);
  // 2. As text.
  std::string text = digits;
  if (const auto all = static_cast<std::int64_t>(text.size()); before <= 0)
    text = (random.chance(3, 4) ? "0." : ".") + std::string(static_cast<std::size_t>(-before), '0') + text;
  else if (before >= all)
    text += std::string(static_cast<std::size_t>(before - all), '0') + (random.chance(1, 4) ? "." : "");
  else text.insert(static_cast<std::size_t>(before), ".");
  if (random.chance(1, 4) && text.find('.') != std::string::npos) text += std::string(random.below(1200), '0');
  if (random.chance(1, 8)) text.insert(0, random.below(30), '0');
  if (random.chance(1, 2)) text.insert(0, random.chance(2, 3) ? "-" : "+");
  if (const std::int64_t exponent = size + 1 - before; exponent != 0 || random.chance(1, 2)) {
    text += random.chance(1, 2) ? 'e' : 'E';
    text += exponent < 0 ? "-" : random.chance(1, 2) ? "+" : "";
    text += (random.chance(1, 4) ? "00" : "") + std::to_string(std::abs(exponent));
  }
  // 3. As a number.
  const Plain_decimal plain = *plain_decimal(text);
  const Rational truth = value_of(plain);
  Integer rest = plain.digits, power = plain.exponent - static_cast<unsigned long>(plain.places);
  for (; power < 0 && rest % 10 == 0; ++power) rest /= 10;
  const std::optional<Number> number =
      number_in(text, [](const Text_reader& of, std::string_view token) { return parse_decimal(of, token); });
  require(number.has_value() == (abs(power) <= largest_decimal_exponent), "decimals within the range are read");
  if (number) check_number(*number, truth);
  check_rounding(text, Number_syntax::decimal, truth);
  const std::optional<Number> rounded = number_in(text, [](const Text_reader& of, std::string_view token) {
    return read_coordinate(of, token, Number_syntax::decimal, {true});
  });
  if (rounded && is_nearest(0.0, truth))
    require(!std::signbit(std::get<double>(*rounded)), "what is rounded to 0 has no sign");
}

/// The bytes of a compiled level that has entities and nothing else.
inline std::string level_of_entities(const std::string& text) {
  constexpr std::size_t header = 124;  // the version, then where each of 15 lumps begins and how long it is
  std::string bytes;
  store(bytes, std::int32_t{29});
  store(bytes, static_cast<std::int32_t>(header));
  store(bytes, static_cast<std::int32_t>(text.size()));
  bytes.resize(header, '\0');
  return bytes + text;
}

/// Entities without brushes, or a model of the level's in their place, stand where their last origin says; an origin
/// that is not three decimals is refused. So in a .map, and in a compiled level, whose text ends with a byte of 0.
inline void try_map_places(generate::Random& random) {
  std::string text;
  std::vector<std::pair<std::string, Exact_point>> expected;
  bool is_wrong = false;
  for (std::size_t entities = 1 + random.below(4); entities > 0; --entities) {
    text += "{\n";
    std::string name;
    std::optional<Exact_point> origin;
    bool has_brush = false, has_model = false;
    for (std::size_t keys = random.below(5); keys > 0; --keys) switch (random.below(5)) {
        case 0:
          name = random.chance(1, 2) ? "light" : "info_player_start";
          text += "\"classname\" \"" + name + "\"\n";
          break;
        case 1:
          text += "{\n( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 ) stone 0 0 0 1 1\n}\n";
          has_brush = true;
          break;
        case 2:
          has_model = random.chance(1, 2);  // else one of a file of its own
          text += has_model ? "\"model\" \"*7\"\n" : "\"model\" \"a*.mdl\"\n";
          break;
        default: {
          const std::size_t numbers = random.chance(1, 12) ? 2 + 2 * random.below(2) : 3;
          is_wrong = is_wrong || numbers != 3;
          text += "\"origin\" \"";
          origin.emplace();
          for (std::size_t k = 0; k < numbers; ++k) {
            const Rational x = generate::ratio(random.between(-99, 99), 4);
            if (k < 3) (*origin)[k] = x;
            text += (k == 0 ? "" : " ") + decimal_of(x);
          }
          text += "\"\n";
        }
      }
    text += "}\n";
    if (origin && !has_brush && !has_model) expected.emplace_back(name, *origin);
  }
  std::vector<Map_place> places;
  const bool is_compiled = random.chance(1, 2);
  const std::string level =
      level_of_entities(text + (random.chance(1, 2) ? std::string("\0}{ nothing", 11) : std::string()));
  const bool refused = is_refused<Input_error>([&] {
    places = is_compiled ? read_level_places({"places", level}) : read_map_places({"places", text});
  });
  require(refused == is_wrong, "an origin is three decimals");
  if (refused) return;
  require(std::equal(places.begin(), places.end(), expected.begin(), expected.end(),
                     [](const Map_place& p, const auto& e) { return p.name == e.first && p.origin == e.second; }),
          "what has an origin and no brushes stands there");
}

inline void rare_files(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(256);
  generate::Random random(from.word());
  if (kind < 4) return try_many_nodes(random, true);
  if (kind == 4) return try_ply_forms(random, true);
  switch (kind % 8) {
    case 0: return try_fingerprints(random);
    case 1:
      if (random.chance(1, 2)) return random.chance(1, 2) ? try_long_row(random) : try_long_table(random);
      return random.chance(1, 4) ? try_missing_shards(random) : try_dealt_table(random);
    case 2: return try_rows_of_leaves(random);
    case 3: return try_many_nodes(random, false);
    case 4: return try_far_brush(random);
    case 5: return try_ply_forms(random, false);
    case 6: return random.chance(1, 2) ? try_map_places(random) : try_repeated_materials(random);
    default: return try_decimal_sizes(random);
  }
}

}  // namespace fuzz
