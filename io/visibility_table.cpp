#include <sightline/io/visibility_table.h>

#include <sightline/io/binary.h>
#include <sightline/io/bit_rows.h>
#include <sightline/kernel/quoted.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <optional>

namespace sightline {
namespace {

/// What a table begins with. The first two are of older programs.
struct Kind {
  std::string_view first_line;
  bool has_cells, has_sum;
};
constexpr std::array<Kind, 4> kinds{{{"sightline pvs 1\n", false, false},
                                     {"sightline pvs 2\n", true, false},
                                     {"sightline pvs 3\n", false, true},
                                     {"sightline pvs 4\n", true, true}}};
constexpr std::size_t most_said = 400;  // bytes of a question
constexpr std::size_t most_rows_beside_the_file = 1 << 16;

class Table_reader {
 public:
  explicit Table_reader(const Input& input) : input_(input), bytes_(input.bytes) {}

  Visibility_table read() {
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) { return bytes_.starts_with(one.first_line); });
    if (kind == kinds.end())
      input_.fail_at_byte(0,
                          "no table: it does not begin with a line from `sightline pvs 1` to `sightline pvs 4`; make "
                          "one by `sightline pvs`");
    at_ = kind->first_line.size();
    if (kind->has_sum) take_sum();
    Visibility_table table = read_body(kind->has_cells);
    if (kind->has_sum && sum_of_bytes(bytes_) != sum_)
      throw Input_error::of_file(input_.name,
                                 "is damaged: some byte is another one than was written; make the table again");
    return table;
  }

 private:
  /// The last bytes are the sum of all others.
  void take_sum() {
    if (bytes_.size() - at_ < sizeof sum_) fail("the sum of its bytes");
    bytes_.remove_suffix(sizeof sum_);
    sum_ = load<std::uint64_t>(input_.bytes, bytes_.size(), std::endian::little);
  }
  Visibility_table read_body(bool has_cells) {
    Visibility_table table;
    const std::size_t length = number("the question's length");
    if (length > bytes_.size() - at_) fail("the question");
    table.question = bytes_.substr(at_, length);
    at_ += length;
    const std::size_t cells = number("the number of cells"), faces = number("the number of faces");
    // A byte of a row stands for 255 bytes of bits at most; so memory stays in proportion to the file.
    if (cells / 1024 > bytes_.size() || faces / 1024 > bytes_.size()) fail("as many cells and faces as are announced");
    const std::vector<std::uint32_t> asked = row(cells, "which cells were asked about");
    table.cells = bits_of_row(asked, cells);
    table.faces = bits_of_row(row(faces, "which faces were asked about"), faces);
    if (has_cells) table.lower_cells = bits_of_row(row(cells, "which lower cells were asked about"), cells);
    // Where there are no faces a row takes no byte.
    if (asked.size() > (faces > 0 ? (bytes_.size() - at_) / 2 : bytes_.size() + most_rows_beside_the_file))
      fail("a row for each cell that was asked about");
    table.rows.resize(asked.size());
    for (std::size_t r = 0; r < asked.size(); ++r) {
      Visibility_table::Row& own = table.rows[r];
      own.visible = row_among(table.faces, "a row of visible faces");
      own.undecided = row_among(table.faces, "a row of undecided faces");
      if (have_one_in_common(own.visible, own.undecided)) fail("a row of undecided faces that are not visible, too,");
      if (!has_cells || !table.lower_cells[asked[r]]) continue;
      for (const auto list : {&Visibility_table::Row::cells, &Visibility_table::Row::cells_undecided})
        for (const std::uint32_t other : row_among(table.cells, "a row of cells")) {
          if (other <= asked[r]) fail("a row of cells above the own one");
          const auto place = std::lower_bound(asked.begin(), asked.end(), other) - asked.begin();
          (own.*list).push_back(other);
          (table.rows[static_cast<std::size_t>(place)].*list).push_back(asked[r]);
        }
    }
    for (Visibility_table::Row& own : table.rows)  // of lower cells and of higher ones, each ascending
      for (std::vector<std::uint32_t>* list : {&own.cells, &own.cells_undecided}) std::sort(list->begin(), list->end());
    if (at_ != bytes_.size()) input_.fail_at_byte(at_, "the file goes on behind its last row; make the table again");
    return table;
  }
  [[noreturn]] void fail(const std::string& what) const {
    input_.fail_at_byte(std::min(at_, bytes_.size()),
                        "the file ends, or is broken, where " + what + " should be; make the table again");
  }
  /// Pre: both ascend.
  static bool have_one_in_common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    return std::any_of(b.begin(), b.end(),
                       [&](std::uint32_t one) { return std::binary_search(a.begin(), a.end(), one); });
  }
  std::size_t number(const char* what) {
    if (bytes_.size() - at_ < 4) fail(what);
    at_ += 4;
    return load<std::uint32_t>(bytes_, at_ - 4, std::endian::little);
  }
  std::vector<std::uint32_t> row(std::size_t size, const char* what) {
    std::optional<Unpacked_row> found = unpacked_row(bytes_, at_, size);
    if (!found) fail(what);
    at_ = found->end;
    return std::move(found->ones);
  }
  std::vector<std::uint32_t> row_among(const std::vector<bool>& asked, const char* what) {
    std::vector<std::uint32_t> numbers = row(asked.size(), what);
    for (const std::uint32_t number : numbers)
      if (!asked[number]) fail("a row of what was asked about");
    return numbers;
  }

  const Input& input_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t sum_ = 0;
};

}  // namespace

const Visibility_table::Row* Visibility_table::row_of(std::size_t cell) const {
  if (cell >= cells.size() || !cells[cell]) return nullptr;
  return &rows[static_cast<std::size_t>(
      std::count(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(cell), true))];
}

std::string table_bytes(const Visibility_table& table) {
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const Kind& one) { return one.has_sum && one.has_cells == table.has_cells(); });
  std::string bytes(kind->first_line);
  store(bytes, static_cast<std::uint32_t>(table.question.size()));
  bytes += table.question;
  store(bytes, static_cast<std::uint32_t>(table.cells.size()));
  store(bytes, static_cast<std::uint32_t>(table.faces.size()));
  bytes += packed_row(table.cells) + packed_row(table.faces) + packed_row(table.lower_cells);
  std::size_t r = 0;
  for (std::size_t c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    const Visibility_table::Row& row = table.rows[r++];
    for (const auto* faces : {&row.visible, &row.undecided}) bytes += packed_row(*faces, table.faces.size());
    if (!table.has_cells() || !table.lower_cells[c]) continue;
    for (const auto* cells : {&row.cells, &row.cells_undecided})
      bytes += packed_row({std::upper_bound(cells->begin(), cells->end(), c), cells->end()}, table.cells.size());
  }
  store(bytes, sum_of_bytes(bytes));
  return bytes;
}

Visibility_table read_table(const Input& input) { return Table_reader(input).read(); }

Visibility_table joined(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names) {
  if (parts.empty()) throw Merge_error("no part to merge; name the files that `sightline pvs --shard` wrote");
  Visibility_table whole = parts[0];
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Visibility_table& part = parts[i];
    if (part.question != whole.question || part.cells != whole.cells || part.faces.size() != whole.faces.size() ||
        part.lower_cells.size() != whole.lower_cells.size())
      throw Merge_error(names[i] + " answers another question than " + names[0] + ": \"" +
                        printable(part.question, most_said, false) + "\", not \"" +
                        printable(whole.question, most_said, false) +
                        "\"; merge parts of one scene, with the same options");
    const auto add = [&](const char* what, std::vector<bool> Visibility_table::*bits) {
      for (std::size_t k = 0; k < (part.*bits).size(); ++k) {
        if (!(part.*bits)[k]) continue;
        if ((whole.*bits)[k]) {
          std::size_t other = 0;
          while (!(parts[other].*bits)[k]) ++other;
          throw Merge_error(names[i] + " and " + names[other] + " both have " + what + " " + std::to_string(k) +
                            "; leave one of them out");
        }
        (whole.*bits)[k] = true;
      }
    };
    add("face", &Visibility_table::faces);
    add("cell", &Visibility_table::lower_cells);
    for (std::size_t r = 0; r < whole.rows.size(); ++r)
      for (const auto list : {&Visibility_table::Row::visible, &Visibility_table::Row::undecided,
                              &Visibility_table::Row::cells, &Visibility_table::Row::cells_undecided}) {
        const std::vector<std::uint32_t>&own = whole.rows[r].*list, &more = part.rows[r].*list;
        std::vector<std::uint32_t> both;
        std::merge(own.begin(), own.end(), more.begin(), more.end(), std::back_inserter(both));
        whole.rows[r].*list = std::move(both);
      }
  }
  return whole;
}

Visibility_table merged(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names) {
  Visibility_table whole = joined(parts, names);

  // Which shards are missing: faces and cells go round among them.
  const auto check = [&](const char* what, std::vector<bool> Visibility_table::*bits) {
    const std::vector<bool>& all = whole.*bits;
    const auto missing = std::count(all.begin(), all.end(), false);
    if (missing == 0) return;
    const auto first = std::find(all.begin(), all.end(), false) - all.begin();
    std::size_t shards = 0;  // the step between the numbers of the first part that has any
    for (const Visibility_table& part : parts) {
      std::vector<std::size_t> own;
      for (std::size_t k = 0; k < all.size() && own.size() < 2; ++k)
        if ((part.*bits)[k]) own.push_back(k);
      if (own.size() == 2) shards = own[1] - own[0];
      if (shards > 0) break;
    }
    std::string again;
    for (std::size_t s = 0; s < shards && s < all.size(); ++s)
      if (!all[s]) again += (again.empty() ? "" : ", ") + std::to_string(s) + "/" + std::to_string(shards);
    if (shards == 0) again = std::to_string(first) + "/N, of as many as there are";  // more than faces: one each
    throw Merge_error(std::string(what) + " " + std::to_string(first) + " and " + std::to_string(missing - 1) +
                      " more are in no part" +
                      (again.empty() ? "; run the shards that are missing" : "; run again --shard " + again));
  };
  check("face", &Visibility_table::faces);
  check("cell", &Visibility_table::lower_cells);
  return whole;
}

std::uint64_t fingerprint(const Polygon_soup& soup) {
  std::uint64_t hash = sum_of_bytes("");
  const auto add = [&](std::string_view bytes) {
    hash = sum_of_bytes("\xff", sum_of_bytes(bytes, hash));  // an end, which no text of a number has
  };
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) add(to_string(soup.coordinates[i]));
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      add(k == 0 ? "loop" : "hole");
      for (const Point_id p : soup.loop(f, k)) add(std::to_string(p));
    }
  return hash;
}

}  // namespace sightline
