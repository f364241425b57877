#include <sightline/io/visibility_table.h>

#include <sightline/io/binary.h>
#include <sightline/io/bit_rows.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <optional>

namespace sightline {
namespace {

constexpr std::string_view first_line = "sightline pvs 1\n";

std::vector<bool> bits_of(const std::vector<Face_id>& faces, std::size_t size) {
  std::vector<bool> row(size);
  for (const Face_id face : faces) row[face] = true;
  return row;
}

class Table_reader {
 public:
  explicit Table_reader(const Input& input) : input_(input), bytes_(input.bytes) {}

  Visibility_table read() {
    if (!bytes_.starts_with(first_line))
      input_.fail_at_byte(0,
                          "no table: it does not begin with the line `sightline pvs 1`; make one by `sightline pvs`");
    at_ = first_line.size();
    Visibility_table table;
    const std::size_t length = number("the question's length");
    if (length > bytes_.size() - at_) fail("the question");
    table.question = bytes_.substr(at_, length);
    at_ += length;
    const std::size_t cells = number("the number of cells"), faces = number("the number of faces");
    // A byte of a row stands for 255 bytes of bits at most; so memory stays in proportion to the file.
    if (cells / 1024 > bytes_.size() || faces / 1024 > bytes_.size()) fail("as many cells and faces as are announced");
    table.cells = row(cells, "which cells were asked about");
    table.faces = row(faces, "which faces were asked about");
    for (std::size_t c = 0; c < cells; ++c)
      if (table.cells[c]) {
        Visibility_table::Row& own = table.rows.emplace_back();
        own.visible = faces_of(row(faces, "a row of visible faces"), table.faces);
        own.undecided = faces_of(row(faces, "a row of undecided faces"), table.faces);
      }
    if (at_ != bytes_.size()) input_.fail_at_byte(at_, "the file goes on behind its last row; make the table again");
    return table;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    input_.fail_at_byte(std::min(at_, bytes_.size()),
                        "the file ends, or is broken, where " + what + " should be; make the table again");
  }
  std::size_t number(const char* what) {
    if (bytes_.size() - at_ < 4) fail(what);
    at_ += 4;
    return load<std::uint32_t>(bytes_, at_ - 4, std::endian::little);
  }
  std::vector<bool> row(std::size_t size, const char* what) {
    std::optional<Unpacked_row> found = unpacked_row(bytes_, at_, size);
    if (!found) fail(what);
    at_ = found->end;
    return std::move(found->row);
  }
  std::vector<Face_id> faces_of(const std::vector<bool>& row, const std::vector<bool>& asked) const {
    std::vector<Face_id> faces;
    for (std::size_t f = 0; f < row.size(); ++f) {
      if (!row[f]) continue;
      if (!asked[f]) fail("a row of faces that were asked about");
      faces.push_back(static_cast<Face_id>(f));
    }
    return faces;
  }

  const Input& input_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

const Visibility_table::Row* Visibility_table::row_of(std::size_t cell) const {
  if (cell >= cells.size() || !cells[cell]) return nullptr;
  return &rows[static_cast<std::size_t>(
      std::count(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(cell), true))];
}

std::string table_bytes(const Visibility_table& table) {
  std::string bytes(first_line);
  store(bytes, static_cast<std::uint32_t>(table.question.size()));
  bytes += table.question;
  store(bytes, static_cast<std::uint32_t>(table.cells.size()));
  store(bytes, static_cast<std::uint32_t>(table.faces.size()));
  bytes += packed_row(table.cells) + packed_row(table.faces);
  for (const Visibility_table::Row& row : table.rows)
    bytes +=
        packed_row(bits_of(row.visible, table.faces.size())) + packed_row(bits_of(row.undecided, table.faces.size()));
  return bytes;
}

Visibility_table read_table(const Input& input) { return Table_reader(input).read(); }

Visibility_table joined(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names) {
  if (parts.empty()) throw Merge_error("no part to merge; name the files that `sightline pvs --shard` wrote");
  Visibility_table whole = parts[0];
  std::vector<std::size_t> part_of(whole.faces.size(), 0);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Visibility_table& part = parts[i];
    if (part.question != whole.question || part.cells != whole.cells || part.faces.size() != whole.faces.size())
      throw Merge_error(names[i] + " answers another question than " + names[0] + ": \"" + part.question +
                        "\", not \"" + whole.question + "\"; merge parts of one scene, with the same options");
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      if (!part.faces[f]) continue;
      if (whole.faces[f])
        throw Merge_error(names[i] + " and " + names[part_of[f]] + " both have face " + std::to_string(f) +
                          "; leave one of them out");
      whole.faces[f] = true;
      part_of[f] = i;
    }
    for (std::size_t r = 0; r < whole.rows.size(); ++r)
      for (const auto faces : {&Visibility_table::Row::visible, &Visibility_table::Row::undecided}) {
        const std::vector<Face_id>&own = whole.rows[r].*faces, &more = part.rows[r].*faces;
        std::vector<Face_id> both;
        std::merge(own.begin(), own.end(), more.begin(), more.end(), std::back_inserter(both));
        whole.rows[r].*faces = std::move(both);
      }
  }

  return whole;
}

Visibility_table merged(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names) {
  Visibility_table whole = joined(parts, names);

  // Which shards are missing: faces go round among them.
  std::vector<std::size_t> missing;
  for (std::size_t f = 0; f < whole.faces.size(); ++f)
    if (!whole.faces[f]) missing.push_back(f);
  if (missing.empty()) return whole;
  const std::size_t present =
      static_cast<std::size_t>(std::find(whole.faces.begin(), whole.faces.end(), true) - whole.faces.begin());
  std::size_t shards = 0;  // the step between the faces of the first part that has any
  for (const Visibility_table& part : parts) {
    std::vector<std::size_t> own;
    for (std::size_t f = 0; f < part.faces.size() && own.size() < 2; ++f)
      if (part.faces[f]) own.push_back(f);
    if (own.size() == 2) shards = own[1] - own[0];
    if (shards > 0) break;
  }
  std::string again;
  for (std::size_t s = 0; s < shards && s < whole.faces.size(); ++s)
    if (!whole.faces[s]) again += (again.empty() ? "" : ", ") + std::to_string(s) + "/" + std::to_string(shards);
  throw Merge_error("face " + std::to_string(missing[0]) + " and " + std::to_string(missing.size() - 1) +
                    " more are in no part" +
                    (present == whole.faces.size() || again.empty() ? "; run the shards that are missing"
                                                                    : "; run again --shard " + again));
}

std::uint64_t fingerprint(const Polygon_soup& soup) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    hash = (hash ^ 0xffu) * 0x100000001b3u;  // an end, which no text of a number has
  };
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) add(to_string(soup.coordinates[i]));
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      add("loop");
      for (const Point_id p : soup.loop(f, k)) add(std::to_string(p));
    }
  return hash;
}

}  // namespace sightline
