// Tables of what cells see: rows of bits, files, parts.

#include <sightline/io/binary.h>
#include <sightline/io/bit_rows.h>
#include <sightline/io/visibility_table.h>

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace sightline {
namespace {

TEST(Bit_rows, are_as_quake_has_them) {
  using Bits = std::vector<bool>;
  EXPECT_EQ(packed_row({}), "");
  EXPECT_EQ(packed_row(Bits{true, false, true}), "\x05");
  EXPECT_EQ(packed_row(Bits(9)), std::string("\0\x02", 2));
  Bits row(8 * 300);
  row[8 * 300 - 1] = true;  // 299 bytes of 0 in two runs
  EXPECT_EQ(packed_row(row), std::string("\0\xFF\0\x2C\x80", 5));
}

TEST(Bit_rows, come_back) {
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    std::vector<bool> row(random() % 5000);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = random() % (1 + static_cast<unsigned>(k)) == 0;
    const std::string packed = packed_row(row);
    const auto found = unpacked_row("xy" + packed + "z", 2, row.size());
    ASSERT_TRUE(found);
    EXPECT_EQ(bits_of_row(found->ones, row.size()), row);
    EXPECT_EQ(packed_row(found->ones, row.size()), packed);
    EXPECT_EQ(found->end, 2 + packed.size());
    for (std::size_t cut = 0; cut < packed.size(); ++cut)
      EXPECT_FALSE(unpacked_row(std::string_view(packed).substr(0, cut), 0, row.size()));
  }
  EXPECT_FALSE(unpacked_row(std::string("\0\0\x01", 3), 0, 9));  // a run of none
}

/// The bytes of a table without their sum; and with it.
std::string without_sum(std::string bytes) {
  bytes.resize(bytes.size() - 8);
  return bytes;
}
std::string with_sum(std::string bytes) {
  store(bytes, sum_of_bytes(bytes));
  return bytes;
}
/// As older programs wrote it.
std::string in_old_format(const std::string& bytes) {
  std::string old = without_sum(bytes);
  const std::size_t digit = old.find('\n') - 1;
  old[digit] = static_cast<char>(old[digit] - 2);
  return old;
}

Visibility_table some_table() {
  return {"scene 1, candidates 5", {true, false, true}, {true, true, true, true}, {{{0, 3}, {}}, {{1}, {2, 3}}}};
}

TEST(Visibility_table, comes_back) {
  const Visibility_table table = some_table();
  const std::string bytes = table_bytes(table);
  const Visibility_table again = read_table({"t", bytes});
  EXPECT_EQ(again.question, table.question);
  EXPECT_EQ(again.cells, table.cells);
  EXPECT_EQ(again.faces, table.faces);
  ASSERT_NE(again.row_of(2), nullptr);
  EXPECT_EQ(again.row_of(1), nullptr);
  EXPECT_EQ(again.row_of(9), nullptr);
  EXPECT_EQ(again.row_of(0)->visible, (std::vector<Face_id>{0, 3}));
  EXPECT_EQ(again.row_of(2)->visible, (std::vector<Face_id>{1}));
  EXPECT_EQ(again.row_of(2)->undecided, (std::vector<Face_id>{2, 3}));
  EXPECT_EQ(table_bytes(again), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read_table({"t", std::string_view(bytes).substr(0, size)}), Input_error) << size;
  EXPECT_THROW(read_table({"t", bytes + "x"}), Input_error);
}

Visibility_table some_table_with_cells() {
  return {"scene 1, cells too",
          {true, false, true, true},
          {true, true},
          {{{0}, {}, {2}, {3}}, {{}, {1}, {0, 3}, {}}, {{}, {}, {2}, {0}}},
          {true, true, true, true}};
}

TEST(Visibility_table, with_cells_comes_back_symmetric) {
  const Visibility_table table = some_table_with_cells();
  const std::string bytes = table_bytes(table);
  EXPECT_TRUE(bytes.starts_with("sightline pvs 4\n"));
  const Visibility_table again = read_table({"t", bytes});
  EXPECT_EQ(again.lower_cells, table.lower_cells);
  ASSERT_EQ(again.rows.size(), table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    EXPECT_EQ(again.rows[r].visible, table.rows[r].visible);
    EXPECT_EQ(again.rows[r].undecided, table.rows[r].undecided);
    EXPECT_EQ(again.rows[r].cells, table.rows[r].cells);
    EXPECT_EQ(again.rows[r].cells_undecided, table.rows[r].cells_undecided);
  }
  EXPECT_EQ(table_bytes(again), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read_table({"t", std::string_view(bytes).substr(0, size)}), Input_error) << size;
  std::string below = without_sum(bytes);
  below.back() = below[below.size() - 2] = '\x01';  // of the last cell: that it sees cell 0, which is below it
  EXPECT_THROW(read_table({"t", with_sum(below)}), Input_error);
  below.pop_back();  // and nothing behind it
  EXPECT_THROW(read_table({"t", with_sum(below)}), Input_error);
}

TEST(Visibility_table, with_any_bit_flipped_is_refused_and_older_ones_are_read) {
  for (const Visibility_table& table : {some_table(), some_table_with_cells()}) {
    const std::string bytes = table_bytes(table);
    EXPECT_EQ(with_sum(without_sum(bytes)), bytes);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string other = bytes;
      other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
      EXPECT_THROW(read_table({"t", other}), Input_error) << bit;
    }
    EXPECT_EQ(table_bytes(read_table({"t", in_old_format(bytes)})), bytes);
  }
}

/// The part of a table with the faces and lower cells of a shard.
Visibility_table part_with_cells(Visibility_table table, std::size_t shard, std::size_t shards) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t c = 0; c < table.cells.size(); ++c)
    if (table.cells[c]) cells.push_back(c);
  for (std::size_t f = 0; f < table.faces.size(); ++f) table.faces[f] = f % shards == shard;
  for (std::size_t c = 0; c < table.cells.size(); ++c) table.lower_cells[c] = c % shards == shard;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    Visibility_table::Row& row = table.rows[r];
    for (auto* faces : {&row.visible, &row.undecided})
      std::erase_if(*faces, [&](Face_id face) { return face % shards != shard; });
    for (auto* others : {&row.cells, &row.cells_undecided})
      std::erase_if(*others, [&](std::uint32_t other) { return std::min(other, cells[r]) % shards != shard; });
  }
  return table;
}

TEST(Visibility_table, with_cells_is_one_again_of_its_parts) {
  const Visibility_table table = some_table_with_cells();
  std::vector<Visibility_table> parts;
  std::vector<std::string> names;
  for (const std::size_t shard : {2u, 0u, 1u}) {
    const std::string bytes = table_bytes(part_with_cells(table, shard, 3));
    parts.push_back(read_table({"t", bytes}));
    names.push_back("part" + std::to_string(shard));
  }
  EXPECT_EQ(table_bytes(merged(parts, names)), table_bytes(table));
  const auto error = [&](const std::vector<Visibility_table>& some) -> std::string {
    try {
      merged(some, {"a", "b", "c"});
    } catch (const Merge_error& found) {
      return found.what();
    }
    return "none";
  };
  Visibility_table without = parts[0];
  without.lower_cells.clear();
  EXPECT_NE(error({without, parts[1], parts[2]}).find("another question"), std::string::npos);
  without = parts[1];
  without.faces = {false, false};
  EXPECT_NE(error({parts[1], without, parts[2]}).find("both have cell 0"), std::string::npos);
  Visibility_table faces = parts[0];
  faces.lower_cells.assign(4, false);  // all faces are there, and cell 2 is not
  const std::string gap = error({faces, parts[1], parts[2]});
  EXPECT_NE(gap.find("cell 2 and 0 more are in no part; run again --shard 2/3"), std::string::npos) << gap;
}

TEST(Visibility_table, that_announces_more_than_it_holds_is_refused) {
  std::string bytes = without_sum(table_bytes({"", {}, {}, {}}));
  for (std::size_t k = 0; k < 4; ++k) bytes[bytes.size() - 8 + k] = '\xFF';  // four thousand million cells
  EXPECT_THROW(read_table({"t", with_sum(bytes)}), Input_error);
  // Without faces a row takes no byte: a million bytes are no eight million rows.
  const auto of_cells_alone = [](std::uint32_t cells) {
    std::string table = "sightline pvs 1\n";
    store(table, std::uint32_t{1});
    table += "x";
    store(table, cells);
    store(table, std::uint32_t{0});
    return table + std::string(cells / 8, '\xFF');
  };
  EXPECT_EQ(read_table({"t", of_cells_alone(1 << 16)}).rows.size(), std::size_t{1} << 16);
  EXPECT_THROW(read_table({"t", of_cells_alone(1 << 23)}), Input_error);
}

/// The part of a table with the faces of a shard.
Visibility_table part_of(Visibility_table table, std::size_t shard, std::size_t shards) {
  const auto is_other = [&](std::size_t face) { return face % shards != shard; };
  for (std::size_t f = 0; f < table.faces.size(); ++f)
    if (is_other(f)) table.faces[f] = false;
  for (Visibility_table::Row& row : table.rows) {
    std::erase_if(row.visible, is_other);
    std::erase_if(row.undecided, is_other);
  }
  return table;
}
std::string error_of(const std::vector<Visibility_table>& parts) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parts.size(); ++i) names.push_back("part" + std::to_string(i));
  try {
    merged(parts, names);
  } catch (const Merge_error& error) {
    return error.what();
  }
  return "";
}

TEST(Visibility_table, is_made_of_its_parts_in_any_order) {
  const Visibility_table table = some_table();
  EXPECT_EQ(table_bytes(merged({part_of(table, 1, 2), part_of(table, 0, 2)}, {"a", "b"})), table_bytes(table));
  EXPECT_EQ(table_bytes(merged({part_of(table, 2, 3), part_of(table, 0, 3), part_of(table, 1, 3)}, {"a", "b", "c"})),
            table_bytes(table));
  EXPECT_EQ(table_bytes(merged({table}, {"a"})), table_bytes(table));
}

TEST(Visibility_table, of_parts_that_do_not_fit_is_refused) {
  const Visibility_table table = some_table();
  Visibility_table other = part_of(table, 1, 2);
  other.question = "scene 2";
  EXPECT_NE(error_of({part_of(table, 0, 2), other}).find("another question"), std::string::npos);
  EXPECT_NE(error_of({part_of(table, 0, 2), part_of(table, 0, 2)}).find("both have face 0"), std::string::npos);
  EXPECT_NE(error_of({part_of(table, 0, 2), table}).find("both have face 0"), std::string::npos);
  EXPECT_NE(error_of({part_of(table, 0, 2)}).find("run again --shard 1/2"), std::string::npos)
      << error_of({part_of(table, 0, 2)});
  EXPECT_NE(error_of({}).find("no part"), std::string::npos);
}

TEST(Fingerprint, tells_scenes_apart) {
  const auto scene = [](int x, std::initializer_list<Point_id> face) {
    Polygon_soup soup;
    soup.add_point(x, 0, 0);
    soup.add_point(Rational(1, 3), 0, 0);
    soup.add_point(0, 1, 0);
    soup.add_face(face);
    return fingerprint(soup);
  };
  EXPECT_EQ(scene(1, {0, 1, 2}), scene(1, {0, 1, 2}));
  EXPECT_NE(scene(1, {0, 1, 2}), scene(2, {0, 1, 2}));
  EXPECT_NE(scene(1, {0, 1, 2}), scene(1, {0, 2, 1}));
  EXPECT_NE(scene(1, {0, 1, 2}), scene(1, {0, 1}));
}

}  // namespace
}  // namespace sightline
