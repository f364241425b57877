#include <sightline/io/quake_bsp.h>

#include <sightline/io/binary.h>
#include <sightline/io/bit_rows.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace sightline {
namespace {

constexpr std::int32_t version = 29;
enum Lump : std::size_t {
  lump_entities = 0,
  lump_planes = 1,
  lump_vertices = 3,
  lump_visibility = 4,
  lump_nodes = 5,
  lump_faces = 7,
  lump_leaves = 10,
  lump_marks = 11,
  lump_edges = 12,
  lump_turns = 13,  // signed numbers of edges
  lump_models = 14,
  lumps = 15
};
constexpr std::size_t header_bytes = 4 + 8 * lumps;

/// Where a part of the file is, and how long.
struct Quake_lump {
  std::size_t offset, size;
};

template <class Value>
Value at(std::string_view bytes, std::size_t offset) {
  return load<Value>(bytes, offset, std::endian::little);
}

/// A lump as a list of records of one size.
struct Records {
  std::size_t offset, count, record;
  std::size_t operator[](std::size_t i) const { return offset + i * record; }
};

class Level_reader {
 public:
  explicit Level_reader(const Input& input) : input_(input), bytes_(input.bytes) {}

  Quake_level read() {
    check_header();
    check_lumps();
    read_planes();
    read_soup();
    read_leaves();
    read_nodes();
    check_visibility();
    return std::move(level_);
  }
  std::vector<Map_place> read_places() const {
    check_header();
    const Quake_lump found = lump(lump_entities);
    const std::string_view text = bytes_.substr(found.offset, found.size);
    return read_map_places({input_.name + ", its entities", text.substr(0, text.find('\0'))});
  }

 private:
  void check_header() const {
    if (bytes_.size() < header_bytes)
      input_.fail_at_byte(bytes_.size(), "the file ends within the header of " + std::to_string(header_bytes) +
                                             " bytes of a level; fetch it again if it is cut off");
    if (const std::int32_t found = at<std::int32_t>(bytes_, 0); found != version)
      input_.fail_at_byte(0, "a level of version " + std::to_string(found) + ", not " + std::to_string(version) +
                                 "; compile it for Quake");
  }

  /// No two lumps have a byte in common, so that one may be replaced.
  void check_lumps() const {
    std::vector<std::pair<Quake_lump, std::size_t>> all;
    for (std::size_t i = 0; i < lumps; ++i)
      if (const Quake_lump found = lump(i); found.size > 0) all.push_back({found, i});
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first.offset < b.first.offset; });
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::size_t before = k == 0 ? header_bytes : all[k - 1].first.offset + all[k - 1].first.size;
      if (all[k].first.offset < before)
        input_.fail_at_byte(4 + 8 * all[k].second, "lump " + std::to_string(all[k].second) +
                                                       " begins within another or the header; compile the level again");
    }
  }

  Quake_lump lump(std::size_t which) const {
    const std::size_t entry = 4 + 8 * which;
    const std::int64_t offset = at<std::int32_t>(bytes_, entry), size = at<std::int32_t>(bytes_, entry + 4);
    if (offset < 0 || size < 0 || offset + size > static_cast<std::int64_t>(bytes_.size()))
      input_.fail_at_byte(entry, "lump " + std::to_string(which) + " is not within the file of " +
                                     std::to_string(bytes_.size()) + " bytes; fetch it again if it is cut off");
    return {static_cast<std::size_t>(offset), static_cast<std::size_t>(size)};
  }
  Records records(Lump which, std::size_t record) const {
    const Quake_lump found = lump(which);
    if (found.size % record != 0)
      input_.fail_at_byte(4 + 8 * which + 4, "lump " + std::to_string(which) + " of " + std::to_string(found.size) +
                                                 " bytes is no whole number of records of " + std::to_string(record) +
                                                 "; compile the level again");
    return {found.offset, found.size / record, record};
  }
  /// A number that names one of `count` things.
  std::size_t index(std::int64_t number, std::size_t count, const char* what, std::size_t place) const {
    if (number < 0 || number >= static_cast<std::int64_t>(count))
      input_.fail_at_byte(place, std::string(what) + " " + std::to_string(number) + " of " + std::to_string(count) +
                                     "; compile the level again");
    return static_cast<std::size_t>(number);
  }
  /// The first of `length` things in a row, of `count` that there are.
  std::size_t first_of(std::int64_t first, std::int64_t length, std::size_t count, const char* what,
                       std::size_t place) const {
    if (first < 0 || length < 0 || first + length > static_cast<std::int64_t>(count))
      input_.fail_at_byte(place, std::string(what) + " " + std::to_string(first) + " and " + std::to_string(length) +
                                     " in a row, of " + std::to_string(count) + "; compile the level again");
    return static_cast<std::size_t>(first);
  }
  float finite(std::size_t offset) const {
    const float value = at<float>(bytes_, offset);
    if (!std::isfinite(value)) input_.fail_at_byte(offset, "not a finite number; compile the level again");
    return value;
  }

  void read_planes() {
    const Records planes = records(lump_planes, 20);
    for (std::size_t i = 0; i < planes.count; ++i)
      level_.planes.push_back(
          {{finite(planes[i]), finite(planes[i] + 4), finite(planes[i] + 8)}, finite(planes[i] + 12)});
  }

  /// The faces of model 0, which is the world.
  void read_soup() {
    const Records points = records(lump_vertices, 12), edges = records(lump_edges, 4), turns = records(lump_turns, 4),
                  faces = records(lump_faces, 20), models = records(lump_models, 64);
    if (models.count == 0)
      input_.fail_at_byte(4 + 8 * lump_models, "no model, not even of the world; compile the level again");
    for (std::size_t i = 0; i < points.count; ++i)
      level_.soup.add_point(double{finite(points[i])}, double{finite(points[i] + 4)}, double{finite(points[i] + 8)});
    const std::int64_t first = at<std::int32_t>(bytes_, models[0] + 56),
                       count = at<std::int32_t>(bytes_, models[0] + 60);
    const std::size_t begin = first_of(first, count, faces.count, "faces from", models[0] + 56);
    if (begin != 0) input_.fail_at_byte(models[0] + 56, "the world's faces are not the first; compile the level again");
    // Each corner of a face takes an entry of the list of turns, but faces could share entries.
    std::size_t corners_left = turns.count;
    std::vector<Point_id> loop;
    for (std::size_t f = begin; f < begin + static_cast<std::size_t>(count); ++f) {
      const std::size_t size = at<std::uint16_t>(bytes_, faces[f] + 8);
      const std::size_t turn = first_of(at<std::int32_t>(bytes_, faces[f] + 4), static_cast<std::int64_t>(size),
                                        turns.count, "edges from", faces[f] + 4);
      if (size > corners_left)
        input_.fail_at_byte(faces[f] + 4, "faces have more edges than the file lists; compile the level again");
      corners_left -= size;
      loop.clear();
      for (std::size_t k = turn; k < turn + size; ++k) {
        const std::int64_t number = at<std::int32_t>(bytes_, turns[k]);
        const std::size_t edge = index(number < 0 ? -number : number, edges.count, "edge", turns[k]);
        const std::size_t end = edges[edge] + (number < 0 ? 2u : 0u);
        loop.push_back(static_cast<Point_id>(index(at<std::uint16_t>(bytes_, end), points.count, "point", end)));
      }
      std::reverse(loop.begin(), loop.end());  // Quake's run clockwise
      level_.soup.add_face(loop);
    }
    world_faces_ = static_cast<std::size_t>(count);
    level_.visible_leaves = static_cast<std::size_t>(std::max(0, at<std::int32_t>(bytes_, models[0] + 52)));
    level_.root = at<std::int32_t>(bytes_, models[0] + 36);
    root_place_ = models[0] + 36;
    visible_place_ = models[0] + 52;
  }

  void read_leaves() {
    const Records leaves = records(lump_leaves, 28), marks = records(lump_marks, 2);
    std::size_t marks_left = marks.count;
    for (std::size_t i = 0; i < leaves.count; ++i) {
      Quake_level::Leaf leaf{at<std::int32_t>(bytes_, leaves[i]), at<std::int32_t>(bytes_, leaves[i] + 4), {}};
      const std::size_t count = at<std::uint16_t>(bytes_, leaves[i] + 22);
      const std::size_t first = first_of(at<std::uint16_t>(bytes_, leaves[i] + 20), static_cast<std::int64_t>(count),
                                         marks.count, "marks from", leaves[i] + 20);
      if (count > marks_left)
        input_.fail_at_byte(leaves[i] + 20, "leaves have more faces than the file lists; compile the level again");
      marks_left -= count;
      for (std::size_t k = first; k < first + count; ++k) {
        const std::size_t face = at<std::uint16_t>(bytes_, marks[k]);
        if (face < world_faces_) leaf.faces.push_back(static_cast<Face_id>(face));
      }
      level_.leaves.push_back(std::move(leaf));
    }
    if (level_.visible_leaves > 0 && level_.visible_leaves >= level_.leaves.size())
      input_.fail_at_byte(visible_place_, "more leaves with rows than there are leaves; compile the level again");
  }

  void read_nodes() {
    const Records nodes = records(lump_nodes, 24);
    const auto child = [&](std::int64_t number, std::size_t place) {
      if (number < 0) index(-1 - number, level_.leaves.size(), "leaf", place);
      else index(number, nodes.count, "node", place);
      return static_cast<std::int32_t>(number);
    };
    std::vector<char> is_child(nodes.count, 0);
    for (std::size_t i = 0; i < nodes.count; ++i) {
      Quake_level::Node node{static_cast<std::uint32_t>(
                                 index(at<std::int32_t>(bytes_, nodes[i]), level_.planes.size(), "plane", nodes[i])),
                             {}};
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t place = nodes[i] + 4 + 2 * side;
        // Levels of more than 32,768 nodes count on: what is not a node is a leaf from the end.
        const std::int64_t number = at<std::uint16_t>(bytes_, place);
        node.children[side] = child(number < static_cast<std::int64_t>(nodes.count) ? number : number - 65536, place);
        if (node.children[side] < 0) continue;
        if (is_child[static_cast<std::size_t>(node.children[side])]++ != 0)
          input_.fail_at_byte(
              place, "node " + std::to_string(node.children[side]) + " is a child twice; compile the level again");
      }
      level_.nodes.push_back(node);
    }
    if (level_.nodes.empty() && level_.leaves.empty()) return;
    child(level_.root, root_place_);
    // A child once at most, and never the root: no way down comes back.
    if (level_.root >= 0 && is_child[static_cast<std::size_t>(level_.root)] != 0)
      input_.fail_at_byte(root_place_, "the root is a child of a node; compile the level again");
  }

  void check_visibility() {
    const Quake_lump found = lump(lump_visibility);
    level_.visibility = bytes_.substr(found.offset, found.size);
    for (std::size_t l = 0; l < level_.leaves.size(); ++l)
      if (level_.visibility.empty() || l == 0 || l > level_.visible_leaves) level_.leaves[l].visible_at = -1;
    const Records leaves = records(lump_leaves, 28);
    std::set<std::int64_t> known;
    std::size_t bytes_left = found.size;  // rows may be those of several leaves, but have no bytes in common otherwise
    for (std::size_t l = 1; l <= level_.visible_leaves && !level_.leaves.empty(); ++l) {
      const std::int64_t begin = level_.leaves[l].visible_at;
      if (begin == -1 || !known.insert(begin).second) continue;
      const auto row = begin < 0
                           ? std::nullopt
                           : unpacked_row(level_.visibility, static_cast<std::size_t>(begin), level_.visible_leaves);
      if (!row)
        input_.fail_at_byte(leaves[l] + 4, "the row of what leaf " + std::to_string(l) +
                                               " sees does not end within its lump; compile the level again");
      const std::size_t size = row->end - static_cast<std::size_t>(begin);
      if (size > bytes_left)
        input_.fail_at_byte(leaves[l] + 4, "the row of what leaf " + std::to_string(l) +
                                               " sees overlaps that of another leaf; compile the level again");
      bytes_left -= size;
    }
  }

  const Input& input_;
  std::string_view bytes_;
  Quake_level level_;
  std::size_t world_faces_ = 0, root_place_ = 0, visible_place_ = 0;
};

}  // namespace

bool looks_like_quake_level(std::string_view bytes) {
  return bytes.size() >= header_bytes && at<std::int32_t>(bytes, 0) == version;
}

std::vector<std::size_t> Quake_level::seen_from(std::size_t leaf) const {
  std::vector<std::size_t> seen;
  const std::int32_t begin = leaves[leaf].visible_at;
  if (begin < 0) {
    for (std::size_t l = 1; l <= visible_leaves; ++l) seen.push_back(l);
    return seen;
  }
  const Unpacked_row row = *unpacked_row(visibility, static_cast<std::size_t>(begin), visible_leaves);
  for (const std::uint32_t one : row.ones) seen.push_back(one + 1);
  return seen;
}

Quake_level read_quake_level(const Input& input) { return Level_reader(input).read(); }

std::vector<Map_place> read_level_places(const Input& input) { return Level_reader(input).read_places(); }

Polygon_soup read_quake_bsp(const Input& input) { return read_quake_level(input).soup; }

std::string with_visibility(std::string_view bytes, const std::vector<std::vector<bool>>& rows) {
  // 1. The new lump, and where each row begins in it.
  std::string lump;
  std::map<std::string, std::int32_t> begins;
  std::vector<std::int32_t> begin;
  for (const std::vector<bool>& row : rows) {
    std::string bytes_of_row = packed_row(row);
    const auto [place, fresh] = begins.try_emplace(bytes_of_row, static_cast<std::int32_t>(lump.size()));
    if (fresh) lump += bytes_of_row;
    begin.push_back(place->second);
  }

  // 2. In the old one's place where it fits, else behind all.
  std::string level(bytes);
  const auto put = [&](std::size_t offset, std::int32_t value) {
    std::string four;
    store(four, value);
    level.replace(offset, 4, four);
  };
  const std::size_t entry = 4 + 8 * lump_visibility;
  const auto old_size = static_cast<std::size_t>(at<std::int32_t>(bytes, entry + 4));
  std::size_t offset = static_cast<std::size_t>(at<std::int32_t>(bytes, entry));
  if (lump.size() <= old_size) {
    level.replace(offset, lump.size(), lump);
  } else {
    level.resize((level.size() + 3) / 4 * 4);
    offset = level.size();
    level += lump;
  }
  put(entry, static_cast<std::int32_t>(offset));
  put(entry + 4, static_cast<std::int32_t>(lump.size()));

  // 3. The leaves say where their rows are.
  const auto leaves = static_cast<std::size_t>(at<std::int32_t>(bytes, 4 + 8 * lump_leaves));
  for (std::size_t l = 0; l < rows.size(); ++l) put(leaves + 28 * (l + 1) + 4, begin[l]);
  return level;
}

}  // namespace sightline
