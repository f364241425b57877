#pragma once
// Quake's compiled levels written for what is in them, and read; with another table of what leaves see; and with one
// thing that is wrong.

#include "written_gltf.h"

#include <sightline/io/quake_bsp.h>

#include <cmath>
#include <map>

namespace fuzz {

/// Numbers, one behind the other, as a level has them.
struct Level_bytes {
  std::string bytes;
  template <class Number>
  void put(Number value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  template <class Number>
  void set(std::size_t offset, Number value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
  }
};

/// A level in the making: its 15 lumps, and what they say.
struct Written_level {
  std::array<Level_bytes, 15> lump;
  std::array<std::size_t, 15> begin{};  // in the file
  std::vector<Face_points> faces;       // of the world, counterclockwise
  std::vector<std::array<std::int32_t, 2>> children;
  std::vector<std::vector<Face_id>> marked;  // by leaf
  std::vector<std::int32_t> contents;
  std::vector<std::vector<bool>> rows;  // of leaf l + 1, what it sees of leaf m + 1
  std::size_t visible_leaves = 0;
  std::int32_t root = 0;

  enum Lump {
    lump_planes = 1,
    lump_vertices = 3,
    lump_visibility,
    lump_nodes,
    lump_faces = 7,
    lump_leaves = 10,
    lump_marks,
    lump_edges,
    lump_turns,
    lump_models
  };

  /// `has_tree`: nodes and leaves.
  explicit Written_level(generate::Random& random, bool has_tree = true) {
    put_faces(random);
    put_planes();
    if (has_tree) {
      put_leaves(random);
      put_nodes(random);
    }
    for (std::size_t k = 0; k < 9; ++k) lump[lump_models].put(0.0f);
    lump[lump_models].put(root);
    for (std::size_t k = 0; k < 3; ++k) lump[lump_models].put(std::int32_t{0});
    lump[lump_models].put(static_cast<std::int32_t>(visible_leaves));
    lump[lump_models].put(std::int32_t{0});
    lump[lump_models].put(static_cast<std::int32_t>(faces.size()));
  }

  /// Lumps in any order, some bytes between them.
  std::string file(generate::Random& random) {
    Level_bytes all;
    all.put(std::int32_t{29});
    for (std::size_t k = 0; k < 30; ++k) all.put(std::int32_t{0});
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < lump.size(); ++k) order.push_back(k);
    random.shuffle(order);
    for (const std::size_t k : order) {
      if (random.chance(1, 4)) all.bytes += std::string(random.below(7), 'x');
      begin[k] = all.bytes.size();
      all.set(4 + 8 * k, static_cast<std::int32_t>(begin[k]));
      all.set(8 + 8 * k, static_cast<std::int32_t>(lump[k].bytes.size()));
      all.bytes += lump[k].bytes;
    }
    return all.bytes;
  }

 private:
  void put_faces(generate::Random& random) {
    std::vector<Exact_point> points(3 + random.below(6));
    for (Exact_point& p : points)
      for (Rational& x : p) {
        const std::int64_t halves = random.between(-20, 20);
        x = generate::ratio(halves, 2);
        lump[lump_vertices].put(static_cast<float>(halves) / 2);
      }
    lump[lump_edges].put(std::uint32_t{0});  // edge 0 is none, as it has no sign
    std::int32_t edge = 1, turn = 0;
    const std::size_t all = random.below(5), of_doors = random.below(2);
    for (std::size_t f = 0; f < all + of_doors; ++f) {
      std::vector<std::size_t> loop(3 + random.below(3));
      for (std::size_t& p : loop) p = random.below(points.size());
      Face_points face;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto from = static_cast<std::uint16_t>(loop[k]),
                   to = static_cast<std::uint16_t>(loop[(k + 1) % loop.size()]);
        const bool is_backwards = random.chance(1, 2);
        lump[lump_edges].put(is_backwards ? to : from);
        lump[lump_edges].put(is_backwards ? from : to);
        lump[lump_turns].put(is_backwards ? -edge : edge);
        ++edge;
        face.insert(face.begin(), points[from]);  // Quake's run clockwise
      }
      lump[lump_faces].put(std::uint32_t{0});
      lump[lump_faces].put(turn);
      lump[lump_faces].put(static_cast<std::uint16_t>(loop.size()));
      lump[lump_faces].bytes += std::string(10, '\0');
      turn += static_cast<std::int32_t>(loop.size());
      if (f < all) faces.push_back(loop_from_least(face));
    }
  }

  /// A byte for eight leaves; zeros as 0 and how many.
  static std::string packed(const std::vector<bool>& row) {
    std::string bytes((row.size() + 7) / 8, '\0'), text;
    for (std::size_t m = 0; m < row.size(); ++m)
      if (row[m]) bytes[m / 8] = static_cast<char>(bytes[m / 8] | 1 << m % 8);
    for (std::size_t k = 0; k < bytes.size();) {
      text += bytes[k];
      if (bytes[k++] != 0) continue;
      std::size_t run = 1;
      for (; k < bytes.size() && bytes[k] == 0 && run < 255; ++k) ++run;
      text += static_cast<char>(run);
    }
    return text;
  }

  void put_leaves(generate::Random& random) {
    const std::size_t count = 1 + (random.chance(1, 4) ? random.below(40) : random.below(5));
    visible_leaves = random.below(count);
    std::map<std::string, std::int32_t> known;
    for (std::size_t l = 0; l < count; ++l) {
      contents.push_back(-static_cast<std::int32_t>(1 + random.below(6)));
      lump[lump_leaves].put(contents.back());
      std::int32_t row_at = -1;
      if (l >= 1 && l <= visible_leaves) {
        std::vector<bool> row(visible_leaves, true);
        if (random.chance(7, 8)) {
          const std::uint64_t full = random.below(4);
          for (std::size_t m = 0; m < visible_leaves; ++m) row[m] = random.chance(full, 8);
          const std::string bytes = packed(row);
          const auto [at, is_new] =
              known.try_emplace(bytes, static_cast<std::int32_t>(lump[lump_visibility].bytes.size()));
          if (is_new) lump[lump_visibility].bytes += bytes;
          row_at = at->second;
        }
        rows.push_back(row);
      }
      lump[lump_leaves].put(row_at);
      lump[lump_leaves].bytes += std::string(12, '\0');
      std::vector<Face_id>& own = marked.emplace_back();
      lump[lump_leaves].put(static_cast<std::uint16_t>(lump[lump_marks].bytes.size() / 2));
      for (std::size_t k = faces.empty() ? 0 : random.below(3); k > 0; --k) {
        own.push_back(static_cast<Face_id>(random.below(faces.size())));
        lump[lump_marks].put(static_cast<std::uint16_t>(own.back()));
      }
      lump[lump_leaves].put(static_cast<std::uint16_t>(own.size()));
      lump[lump_leaves].put(std::uint32_t{0});
    }
  }

  void put_planes() {
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t i = 0; i < 3; ++i) lump[lump_planes].put(static_cast<float>(k == i));
      lump[lump_planes].put(static_cast<float>(k));
      lump[lump_planes].put(std::uint32_t{0});
    }
  }

  /// A tree whose leaves are any of those that there are.
  void put_nodes(generate::Random& random) {
    const auto a_leaf = [&] { return -1 - static_cast<std::int32_t>(random.below(contents.size())); };
    const std::size_t count = random.below(5);
    root = count == 0 ? a_leaf() : 0;
    for (std::size_t n = 0; n < count; ++n) children.push_back({a_leaf(), a_leaf()});
    for (std::size_t n = 1; n < count; ++n)  // below the one before it
      children[n - 1][random.below(2)] = static_cast<std::int32_t>(n);
    for (std::size_t n = 0; n < count; ++n) {
      lump[lump_nodes].put(static_cast<std::uint32_t>(n % 2));
      for (const std::int32_t child : children[n]) lump[lump_nodes].put(static_cast<std::int16_t>(child));
      lump[lump_nodes].bytes += std::string(16, '\0');
    }
  }
};

inline void check_level(const Quake_level& level, const Written_level& written,
                        const std::vector<std::vector<bool>>& rows) {
  require(shown_faces(level.soup) == written.faces, "a level has the faces that were written");
  require(level.root == written.root && level.visible_leaves == written.visible_leaves &&
              level.nodes.size() == written.children.size() && level.leaves.size() == written.marked.size(),
          "a level has the nodes and leaves that were written");
  require(level.planes.size() == 2 && level.planes[1].normal == std::array<float, 3>{0, 1, 0} &&
              level.planes[1].distance == 1,
          "a level has the planes that were written");
  for (std::size_t n = 0; n < level.nodes.size(); ++n)
    require(level.nodes[n].plane == n % 2 && level.nodes[n].children == written.children[n],
            "a node has what was written");
  for (std::size_t l = 0; l < level.leaves.size(); ++l) {
    const std::int32_t contents = written.contents[l];
    require(level.leaves[l].faces == written.marked[l] && level.leaves[l].contents == contents,
            "a leaf has what was written");
    const bool has_row = l >= 1 && l <= written.visible_leaves;
    require(level.is_open(l) == (has_row && contents != -2 && contents != -6),
            "eyes may be in leaves with a row that are neither solid nor sky");
    if (!has_row) continue;
    std::vector<std::size_t> seen;
    for (std::size_t m = 0; m < rows[l - 1].size(); ++m)
      if (rows[l - 1][m]) seen.push_back(m + 1);
    require(level.seen_from(l) == seen, "a leaf sees what was written");
  }
}

/// Makes one thing of a file wrong; false where it has none of that kind.
inline bool spoil(std::string& file, const Written_level& written, generate::Random& random) {
  Level_bytes level{file};
  const auto& begin = written.begin;
  const auto has = [&](std::size_t which) { return !written.lump[which].bytes.empty(); };
  using Level = Written_level;
  const std::uint64_t kind = random.below(12);
  if (kind == 0) level.set(0, std::int32_t{30});
  else if (kind == 1 && has(Level::lump_vertices)) level.set(begin[Level::lump_vertices] + 4, std::nanf(""));
  else if (kind == 2 && has(Level::lump_turns) && !written.faces.empty())
    level.set(begin[Level::lump_turns], std::int32_t{9999});
  else if (kind == 3 && !written.faces.empty())
    level.set(begin[Level::lump_edges] + 4, std::uint32_t{0x27102710});  // both ends
  else if (kind == 4 && !written.faces.empty()) level.set(begin[Level::lump_faces] + 4, std::int32_t{9999});
  else if (kind == 5 && has(Level::lump_nodes)) level.set(begin[Level::lump_nodes] + 4, std::int16_t{5});
  else if (kind == 6 && has(Level::lump_nodes)) level.set(begin[Level::lump_nodes] + 6, std::int16_t{-100});
  else if (kind == 7 && has(Level::lump_nodes)) level.set(begin[Level::lump_nodes] + 4, std::int16_t{0});  // the root
  else if (kind == 8 && has(Level::lump_leaves)) level.set(begin[Level::lump_leaves] + 22, std::uint16_t{9999});
  else if (kind == 9 && has(Level::lump_leaves))
    level.set(begin[Level::lump_models] + 52, static_cast<std::int32_t>(written.marked.size()));
  else if (kind == 10) level.set(begin[Level::lump_models] + 60, std::int32_t{9999});
  else if (kind == 11 && written.visible_leaves > 0 && has(Level::lump_visibility))
    level.set(begin[Level::lump_leaves] + 28 + 4,
              static_cast<std::int32_t>(written.lump[Level::lump_visibility].bytes.size()));
  else return false;
  file = level.bytes;
  return true;
}

/// Marks of a leaf that are no faces of the world are passed over; a leaf without a row sees all.
inline void try_level(generate::Random& random) {
  const bool has_tree = random.chance(15, 16);
  Written_level written(random, has_tree);
  std::string file = written.file(random);
  require(looks_like_quake_level(file), "a level is known by its first bytes");
  require(!looks_like_quake_level(std::string_view(file).substr(0, random.below(124))),
          "what is shorter than a header is no level");
  std::string of_another_version = file;
  of_another_version[random.below(4)] ^= static_cast<char>(1 << random.below(7));
  require(!looks_like_quake_level(of_another_version), "a file of another version is no level");
  if (random.chance(1, 2) && spoil(file, written, random)) {
    require(is_refused<Input_error>([&] {
              read_quake_level({"written", file});
            }),
            "a level in which one thing is wrong is refused");
    return;
  }
  const Input input{"written", file};
  check_level(read_quake_level(input), written, written.rows);
  if (!has_tree) return;
  std::vector<std::vector<bool>> rows = written.rows;
  for (std::vector<bool>& row : rows)
    for (std::size_t m = 0; m < row.size(); ++m) row[m] = random.chance(1, 3);
  const std::string other = with_visibility(file, rows);
  check_level(read_quake_level({"other", other}), written, rows);
}

}  // namespace fuzz
