#include <sightline/io/gltf.h>

#include <sightline/io/binary.h>
#include <sightline/io/decimal.h>
#include <sightline/io/grid_limit.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

namespace {

using Tree = nlohmann::json;

constexpr std::size_t header_size = 12, chunk_header_size = 8, json_begin = header_size + chunk_header_size;
constexpr std::string_view glb_magic = "glTF";
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr std::size_t most_bits = 4096;  // of a number that a node puts points by
constexpr std::size_t most_points_beside_the_files = 1000000, most_triangles_beside_the_files = 8000000;

// ---- JSON with its numbers as they stand there

/// Builds a tree in which a number with a point or an exponent is its text, as `binary`, which JSON has not.
class Tree_builder : public nlohmann::json_sax<Tree> {
 public:
  bool null() override { return put(Tree()); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t, const string_t& text) override {
    return put(Tree::binary(std::vector<std::uint8_t>(text.begin(), text.end())));
  }
  bool string(string_t& value) override { return put(value); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Tree::object()); }
  bool key(string_t& name) override {
    keys_.back() = name;
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Tree::array()); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string&, const Tree::exception& error) override {
    constexpr int beyond_doubles = 406;
    error_at = position;
    is_too_large = error.id == beyond_doubles;
    return false;
  }

  Tree root;
  std::optional<std::size_t> error_at;  ///< how many bytes were read until then, one more at the end
  bool is_too_large = false;            ///< as it is a number beyond doubles

 private:
  static constexpr std::size_t deepest = 100;

  Tree* add(Tree value) {
    if (open_.empty()) {
      root = std::move(value);
      return &root;
    }
    Tree& in = *open_.back();
    if (!in.is_array()) return &(in[keys_.back()] = std::move(value));
    in.push_back(std::move(value));
    return &in.back();
  }
  bool put(Tree value) {
    add(std::move(value));
    return true;
  }
  bool open(Tree empty) {
    if (open_.size() == deepest) return false;
    open_.push_back(add(std::move(empty)));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }
  std::vector<Tree*> open_;  // an array grows only while nothing in it is open
  std::vector<std::string> keys_;
};

/// Where the word begins of which the last byte that was read is a part, or is behind; the end where all was read.
std::size_t begin_of_word(std::string_view text, std::size_t read) {
  if (read > text.size()) return text.size();
  const auto is_of_word = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '+' ||
           c == '-';
  };
  std::size_t at = read - std::min<std::size_t>(read, 1);
  while (at > 0 && is_of_word(text[at - 1])) --at;
  return at;
}

// ---- Where nodes put things

/// x -> linear x + shift.
struct Placement {
  std::array<std::array<Rational, 3>, 3> linear;  // by row
  std::array<Rational, 3> shift;
  bool is_identity = false;

  static Placement identity() {
    Placement p{};
    for (std::size_t k = 0; k < 3; ++k) p.linear[k][k] = 1;
    p.is_identity = true;
    return p;
  }
  Exact_point of(const Exact_point& x) const {
    Exact_point y;
    for (std::size_t r = 0; r < 3; ++r)
      y[r] = linear[r][0] * x[0] + linear[r][1] * x[1] + linear[r][2] * x[2] + shift[r];
    return y;
  }
  /// Of the largest numerator or denominator.
  std::size_t bits() const {
    std::size_t most = 0;
    const auto take = [&](const Rational& x) {
      most = std::max({most, mpz_sizeinbase(x.get_num_mpz_t(), 2), mpz_sizeinbase(x.get_den_mpz_t(), 2)});
    };
    for (const auto& row : linear) std::for_each(row.begin(), row.end(), take);
    std::for_each(shift.begin(), shift.end(), take);
    return most;
  }
  std::vector<Integer> denominators() const {
    std::vector<Integer> all;
    const auto take = [&](const Rational& x) { all.push_back(x.get_den()); };
    for (const auto& row : linear) std::for_each(row.begin(), row.end(), take);
    std::for_each(shift.begin(), shift.end(), take);
    return all;
  }
  bool mirrors() const {
    const auto& m = linear;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
  }
};

/// First `inner`, then `outer`.
Placement composed(const Placement& outer, const Placement& inner) {
  if (outer.is_identity) return inner;
  if (inner.is_identity) return outer;
  Placement both{};
  both.shift = outer.of(inner.shift);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) both.linear[r][c] += outer.linear[r][k] * inner.linear[k][c];
  return both;
}

// ---- The file

/// A buffer, and for messages where it is.
struct Buffer {
  std::string_view bytes;
  std::size_t file_offset = 0;  // in the file that is read, where it is there
  std::string beside = {};      // or else its own name
  std::string own = {};         // and its bytes
};

/// A part of a buffer that holds `count` elements, each `stride` bytes behind the one before.
struct Elements {
  std::string_view bytes;
  const Buffer* buffer;
  std::size_t count, stride;
  std::uint64_t component;
};

// ---- Buffers beside the JSON

/// What a data: URI holds, or nothing where it is none in base64.
std::optional<std::string> data_of(std::string_view uri) {
  constexpr std::string_view scheme = "data:", coded = ";base64,",
                             digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t comma = uri.find(coded);
  if (!uri.starts_with(scheme) || comma == std::string_view::npos) return std::nullopt;
  std::string_view text = uri.substr(comma + coded.size());
  for (int k = 0; k < 2 && text.ends_with('='); ++k) text.remove_suffix(1);
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t digit = digits.find(text[i]);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    if (i % 4 != 0) bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 255);
  }
  return bytes;
}

/// The path below a file's folder that a relative URI stands for; nothing where it is none.
std::optional<std::string> path_of(std::string_view uri) {
  if (uri.empty() || uri.front() == '/' || uri.find(':') != std::string_view::npos) return std::nullopt;
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path += uri[i];
      continue;
    }
    unsigned value = 0;
    const char* const first = uri.data() + i + 1;
    if (uri.size() - i < 3 || std::from_chars(first, first + 2, value, 16).ptr != first + 2 || value == 0)
      return std::nullopt;
    path += static_cast<char>(value);
    i += 2;
  }
  const std::filesystem::path parts = path;
  if (parts.is_absolute() || std::find(parts.begin(), parts.end(), "..") != parts.end()) return std::nullopt;
  return parts.lexically_normal().string();
}

class Gltf_reader {
 public:
  Gltf_reader(const Input& input, const Gltf_neighbour& neighbour, const Read_options& options)
      : input_(input), neighbour_(neighbour), options_(options) {}

  Polygon_soup read_binary() {
    read_chunks();
    return read_scene();
  }
  Polygon_soup read_text() {
    json_begin_ = 0;
    const std::size_t mark = input_.bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    read_json(input_.bytes.substr(mark));
    return read_scene();
  }

 private:
  Polygon_soup read_scene() {
    const Tree& version = at(tree_, "asset", "version");
    if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2."))
      fail("asset.version", "only glTF 2 is read; convert the file");
    if (const Tree* required = find(tree_, "extensionsRequired"); required != nullptr && !required->empty())
      fail("extensionsRequired", "the file requires " + quoted(required->dump()) +
                                     ", which is not read; write it without compression and quantization");
    for (const std::size_t node : roots()) place(node, Placement::identity(), 0);
    return std::move(soup_);
  }

  // ---- Errors, and what JSON holds

  /// `place` is where in the JSON.
  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    const std::string where = place + ": " + message;
    if (json_begin_ == 0) throw Input_error::of_file(input_.name, where);
    input_.fail_at_byte(json_begin_, "in the JSON, " + where);
  }
  static std::string item(const std::string& list, std::size_t index) {
    return list + '[' + std::to_string(index) + ']';
  }
  static std::string quoted(const std::string& text) { return printable(text, 60, true); }

  static const Tree* find(const Tree& in, const char* key) {
    if (!in.is_object()) return nullptr;
    const auto found = in.find(key);
    return found == in.end() ? nullptr : &*found;
  }
  const Tree& at(const Tree& in, const std::string& place, const char* key) const {
    const Tree* const holder = &in == &tree_ ? find(in, place.c_str()) : &in;
    const Tree* const found = holder == nullptr ? nullptr : find(*holder, key);
    if (found == nullptr) fail(place + "." + key, "it is missing; repair the file");
    return *found;
  }
  /// list[index] of the whole tree.
  const Tree& entry(const char* list, std::uint64_t index, const std::string& asked_by) const {
    const Tree* const all = find(tree_, list);
    if (all == nullptr || !all->is_array() || index >= all->size())
      fail(asked_by, "there is no " + item(list, index) + "; repair the file");
    return (*all)[index];
  }
  std::uint64_t whole(const Tree& value, const std::string& place) const {
    if (!value.is_number_unsigned())
      fail(place, quoted(value.is_binary() ? text_of(value) : value.dump()) + " is no count or index; repair the file");
    return value.get<std::uint64_t>();
  }
  std::uint64_t whole_or(const Tree& in, const char* key, std::uint64_t otherwise, const std::string& place) const {
    const Tree* const found = find(in, key);
    return found == nullptr ? otherwise : whole(*found, place + "." + key);
  }
  /// The list of a key; nothing in it where there is no such key.
  const Tree& list_of(const Tree& in, const char* key, const std::string& place) const {
    static const Tree none = Tree::array();
    const Tree* const found = find(in, key);
    if (found == nullptr) return none;
    if (!found->is_array()) fail(place + "." + key, "it is no list; repair the file");
    return *found;
  }
  /// A number with a point or an exponent, as it stands there.
  static std::string text_of(const Tree& value) { return {value.get_binary().begin(), value.get_binary().end()}; }
  Rational number(const Tree& value, const std::string& place) const {
    std::string text;
    if (value.is_binary()) text = text_of(value);
    else if (value.is_number_integer()) text = value.dump();
    else fail(place, "it is no number; repair the file");
    try {
      const Input digits{input_.name, text};
      Text_reader reader(digits, Text_reader::Comments::none);
      reader.next_line();
      return value_of(read_coordinate(reader, reader.next_token(), Number_syntax::decimal, options_));
    } catch (const Input_error&) {
      fail(place, quoted(text) + " is a number out of all proportion; repair the file");
    }
  }
  template <std::size_t Count>
  std::array<Rational, Count> numbers(const Tree& value, const std::string& place) const {
    if (!value.is_array() || value.size() != Count)
      fail(place, "it is no list of " + std::to_string(Count) + " numbers; repair the file");
    std::array<Rational, Count> all;
    for (std::size_t k = 0; k < Count; ++k) all[k] = number(value[k], item(place, k));
    return all;
  }

  // ---- Chunks and buffers

  std::uint32_t word(std::size_t offset) const {
    if (input_.bytes.size() < offset + 4)
      input_.fail_at_byte(input_.bytes.size(), "the file ends early; get all of it");
    return load<std::uint32_t>(input_.bytes, offset, std::endian::little);
  }
  void read_chunks() {
    if (!looks_like_glb(input_.bytes)) input_.fail_at_byte(0, "no \"glTF\" is there; give a glTF 2 in binary (.glb)");
    if (word(4) != 2) input_.fail_at_byte(4, "version " + std::to_string(word(4)) + "; only glTF 2 is read");
    const std::size_t length = word(8);
    if (length > input_.bytes.size())
      input_.fail_at_byte(8, "the file should have " + std::to_string(length) + " bytes, but has " +
                                 std::to_string(input_.bytes.size()) + "; get all of it");
    if (length < input_.bytes.size()) input_.fail_at_byte(length, "data behind the file's end; remove them");
    const std::size_t json_length = word(header_size);
    if (word(header_size + 4) != json_chunk) input_.fail_at_byte(header_size + 4, "the first chunk is no JSON");
    if (json_length > length - std::min(length, json_begin))
      input_.fail_at_byte(header_size, "the JSON is longer than the file; repair it");
    read_json(input_.bytes.substr(json_begin, json_length));
    const std::size_t next = json_begin + json_length;
    if (next == length) return;
    const std::size_t binary_length = word(next);
    if (word(next + 4) != binary_chunk) return;  // what comes behind it is for extensions
    if (binary_length > length - (next + chunk_header_size))
      input_.fail_at_byte(next, "the binary chunk is longer than the file; repair it");
    binary_ = {input_.bytes.substr(next + chunk_header_size, binary_length), next + chunk_header_size};
  }
  void read_json(std::string_view text) {
    const auto fail_at_place = [&](std::size_t at, const std::string& message) {
      if (json_begin_ == 0) input_.fail(text.data() + at, message);
      input_.fail_at_byte(json_begin_ + at, message);
    };
    Tree_builder builder;
    // The parser takes a zero for the end; behind it a chunk may be filled up.
    const std::size_t end = std::min(text.find('\0'), text.size());
    if (!Tree::sax_parse(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), &builder)) {
      const std::string message = !builder.error_at      ? "the JSON is too deep"
                                  : builder.is_too_large ? "a number beyond the range of doubles; repair the file"
                                                         : "this is no JSON; repair the file";
      fail_at_place(builder.error_at ? begin_of_word(text, *builder.error_at) : 0, message);
    }
    const std::string_view filling(json_begin_ == 0 ? "" : "\0 ", json_begin_ == 0 ? 0 : 2);
    const std::size_t behind = std::min(text.find_first_not_of(filling, end), text.size());
    if (behind != text.size()) fail_at_place(behind, "this is behind the end of the JSON; remove it");
    tree_ = std::move(builder.root);
  }

  /// The bytes of a buffer: of the binary chunk, of a data: URI, or of a file beside this one.
  const Buffer& buffer(std::uint64_t index, const std::string& asked_by) {
    if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
    const std::string place = item("buffers", index);
    const Tree* const uri = find(entry("buffers", index, asked_by), "uri");
    if (uri == nullptr && index == 0 && binary_.bytes.data() != nullptr) return binary_;
    if (uri == nullptr || !uri->is_string()) fail(place, "its data are not in this file; repair the file");
    const std::string& text = uri->get_ref<const std::string&>();
    Buffer& made = buffers_[index];
    if (std::optional<std::string> data = data_of(text)) {
      made.own = std::move(*data);
      made.beside = place;
    } else if (const std::optional<std::string> path = path_of(text); !path) {
      fail(place + ".uri", quoted(text) + " is neither data in base64 nor a file beside this one; write a .glb");
    } else if (!neighbour_) {
      fail(place, "its data are not in this file, but in " + quoted(text) + "; read it by its name, or write a .glb");
    } else {
      const auto [file, is_new] = files_.try_emplace(*path);
      if (is_new) bytes_beside_ += (file->second = neighbour_(*path)).size();
      made.bytes = file->second;
      made.beside = quoted(*path);
      return made;
    }
    made.bytes = made.own;
    bytes_beside_ += made.own.size();
    return made;
  }
  [[noreturn]] void fail_at(const Elements& elements, std::size_t offset, const std::string& message) const {
    const Buffer& in = *elements.buffer;
    const std::size_t at = in.file_offset + static_cast<std::size_t>(elements.bytes.data() - in.bytes.data()) + offset;
    if (in.beside.empty()) input_.fail_at_byte(at, message);
    throw Input_error::of_file(input_.name, "in " + in.beside + ", byte " + std::to_string(at) + ": " + message);
  }
  /// Of all files.
  std::size_t bytes() const { return input_.bytes.size() + bytes_beside_; }

  /// The elements of an accessor, all of which are there.
  Elements elements(std::uint64_t accessor, const std::string& asked_by, const std::string& type,
                    const std::set<std::uint64_t>& components) {
    const std::string place = item("accessors", accessor);
    const Tree& of = entry("accessors", accessor, asked_by);
    if (find(of, "sparse") != nullptr) fail(place + ".sparse", "sparse accessors are not read; write them out");
    if (find(of, "bufferView") == nullptr) fail(place, "it has no bufferView; write its numbers out");
    if (at(of, place, "type") != type) fail(place + ".type", "it is no " + type + "; repair the file");
    Elements all{};
    all.component = whole(at(of, place, "componentType"), place + ".componentType");
    if (!components.contains(all.component))
      fail(place + ".componentType", std::to_string(all.component) + " is none of those that are read");
    all.count = whole(at(of, place, "count"), place + ".count");
    const std::size_t component_size = all.component == 5126 || all.component == 5125 ? 4
                                       : all.component - 5120 < 2                     ? 1
                                                                                      : 2;
    const std::size_t size = component_size * (type == "VEC3" ? 3 : 1);
    // 1. The view, in its buffer.
    const std::uint64_t view_index = whole(at(of, place, "bufferView"), place + ".bufferView");
    const std::string view_place = item("bufferViews", view_index);
    const Tree& view = entry("bufferViews", view_index, place + ".bufferView");
    const Buffer& in = buffer(whole(at(view, view_place, "buffer"), view_place + ".buffer"), view_place + ".buffer");
    const std::uint64_t begin = whole_or(view, "byteOffset", 0, view_place),
                        length = whole(at(view, view_place, "byteLength"), view_place + ".byteLength");
    if (begin > in.bytes.size() || length > in.bytes.size() - begin)
      fail(view_place, "it goes beyond its buffer; repair the file");
    // 2. The elements, in the view.
    all.stride = whole_or(view, "byteStride", size, view_place);
    if (all.stride < size || all.stride > 252) fail(view_place + ".byteStride", "elements overlap; repair the file");
    const std::uint64_t offset = whole_or(of, "byteOffset", 0, place);
    if (offset > length ||
        (all.count > 0 && (length - offset < size || all.count - 1 > (length - offset - size) / all.stride)))
      fail(place, "it goes beyond its bufferView; repair the file");
    all.bytes = in.bytes.substr(begin + offset, length - offset);
    all.buffer = &in;
    return all;
  }

  // ---- Nodes

  std::vector<std::size_t> ids(const Tree& list, const std::string& place) const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < list.size(); ++k) all.push_back(whole(list[k], item(place, k)));
    return all;
  }
  std::vector<std::size_t> roots() const {
    const Tree& nodes = list_of(tree_, "nodes", "the file");
    if (!list_of(tree_, "scenes", "the file").empty()) {
      const std::uint64_t shown = whole_or(tree_, "scene", 0, "the file");
      return ids(list_of(entry("scenes", shown, "scene"), "nodes", item("scenes", shown)),
                 item("scenes", shown) + ".nodes");
    }
    std::vector<bool> is_child(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (const std::size_t child : ids(list_of(nodes[n], "children", item("nodes", n)), item("nodes", n)))
        if (child < nodes.size()) is_child[child] = true;
    std::vector<std::size_t> all;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (!is_child[n]) all.push_back(n);
    return all;
  }

  Placement own_placement(const Tree& node, const std::string& place) const {
    Placement p = Placement::identity();
    if (const Tree* const matrix = find(node, "matrix")) {
      const std::array<Rational, 16> m = numbers<16>(*matrix, place + ".matrix");  // by column
      if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        fail(place + ".matrix", "its last row is not 0 0 0 1; repair the file");
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) p.linear[r][c] = m[4 * c + r];
        p.shift[r] = m[12 + r];
      }
      p.is_identity = false;
      return p;
    }
    if (const Tree* const rotation = find(node, "rotation")) {
      const auto [x, y, z, w] = numbers<4>(*rotation, place + ".rotation");
      const Rational length = x * x + y * y + z * z + w * w;
      if (length == 0) fail(place + ".rotation", "it is about no axis; repair the file");
      p.linear = {
          {{(w * w + x * x - y * y - z * z) / length, 2 * (x * y - w * z) / length, 2 * (x * z + w * y) / length},
           {2 * (x * y + w * z) / length, (w * w - x * x + y * y - z * z) / length, 2 * (y * z - w * x) / length},
           {2 * (x * z - w * y) / length, 2 * (y * z + w * x) / length, (w * w - x * x - y * y + z * z) / length}}};
      p.is_identity = false;
    }
    if (const Tree* const scale = find(node, "scale")) {
      const std::array<Rational, 3> s = numbers<3>(*scale, place + ".scale");
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) p.linear[r][c] *= s[c];
      p.is_identity = false;
    }
    if (const Tree* const translation = find(node, "translation")) {
      p.shift = numbers<3>(*translation, place + ".translation");
      p.is_identity = false;
    }
    return p;
  }

  void place(std::size_t index, const Placement& above, std::size_t depth) {
    const std::string name = item("nodes", index);
    const Tree& node = entry("nodes", index, depth == 0 ? "scenes" : "nodes");
    if (!placed_.insert(index).second) fail(name, "it has two parents, or is below itself; repair the file");
    if (depth > 1000) fail(name, "it is more than 1000 nodes deep; flatten the file");
    const Placement here = composed(above, own_placement(node, name));
    if (here.bits() > most_bits) fail(name, "it is put by numbers out of all proportion; repair the file");
    if (const Tree* const mesh = find(node, "mesh")) add_mesh(whole(*mesh, name + ".mesh"), name, here);
    for (const std::size_t child : ids(list_of(node, "children", name), name + ".children"))
      place(child, here, depth + 1);
  }

  // ---- Meshes

  void add_mesh(std::uint64_t mesh, const std::string& node, const Placement& here) {
    const std::string name = item("meshes", mesh);
    const Tree& primitives = list_of(entry("meshes", mesh, node + ".mesh"), "primitives", name);
    std::map<std::uint64_t, Point_id> first_points;  // by accessor
    const bool mirrors = here.mirrors();
    for (std::size_t k = 0; k < primitives.size(); ++k) {
      const std::string place = item(name + ".primitives", k);
      const std::uint64_t mode = whole_or(primitives[k], "mode", 4, place);
      const Tree* const attributes = find(primitives[k], "attributes");
      const Tree* const position = attributes == nullptr ? nullptr : find(*attributes, "POSITION");
      if (mode > 6) fail(place + ".mode", "there is no mode " + std::to_string(mode) + "; repair the file");
      if (mode < 4 || position == nullptr) continue;
      const std::uint64_t accessor = whole(*position, place + ".attributes.POSITION");
      const Elements points = elements(accessor, place, "VEC3", {5126});
      const auto [first, is_new] = first_points.try_emplace(accessor, static_cast<Point_id>(soup_.point_count()));
      if (is_new) add_points(points, here, place);
      std::optional<Elements> indices;
      if (const Tree* const found = find(primitives[k], "indices"))
        indices = elements(whole(*found, place + ".indices"), place, "SCALAR", {5121, 5123, 5125});
      add_triangles(mode, points, indices, first->second, mirrors, place);
    }
  }

  void add_points(const Elements& points, const Placement& here, const std::string& place) {
    if (points.count > bytes() / 12 + most_points_beside_the_files - soup_.point_count() ||
        soup_.point_count() > bytes() / 12 + most_points_beside_the_files)
      fail(place, "nodes repeat meshes to too many points; write a file with fewer copies");
    const std::size_t all = soup_.point_count() + points.count;
    bool is_in_proportion = Grid_limit::allows(all, here.bits(), bytes());
    for (const Integer& denominator : here.denominators())
      is_in_proportion = is_in_proportion && grid_.include(denominator, all, bytes());
    if (!is_in_proportion)
      fail(place, std::string("nodes make of it ") + Grid_limit::words + "; turn it by shorter numbers, or not at all");
    for (std::size_t p = 0; p < points.count; ++p) {
      std::array<double, 3> x;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t offset = p * points.stride + 4 * k;
        x[k] = static_cast<double>(load<float>(points.bytes, offset, std::endian::little));
        if (!std::isfinite(x[k])) fail_at(points, offset, "a coordinate is not a finite number; repair the point");
      }
      if (here.is_identity) soup_.add_point(x[0], x[1], x[2]);
      else {
        const Exact_point y = here.of({exact(x[0]), exact(x[1]), exact(x[2])});
        soup_.add_point(y[0], y[1], y[2]);
      }
    }
  }

  void add_triangles(std::uint64_t mode, const Elements& points, const std::optional<Elements>& indices, Point_id first,
                     bool mirrors, const std::string& place) {
    const std::size_t count = indices ? indices->count : points.count;
    const auto corner = [&](std::size_t k) {
      std::uint64_t index = k;
      if (indices) {
        const std::size_t offset = k * indices->stride;
        const auto order = std::endian::little;
        index = indices->component == 5121   ? load<std::uint8_t>(indices->bytes, offset, order)
                : indices->component == 5123 ? load<std::uint16_t>(indices->bytes, offset, order)
                                             : load<std::uint32_t>(indices->bytes, offset, order);
        if (index >= points.count)
          fail_at(*indices, offset,
                  "there is no point " + std::to_string(index) + " of " + std::to_string(points.count) +
                      "; repair the index");
      }
      return static_cast<Point_id>(first + index);
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (mirrors) soup_.add_face({corner(a), corner(c), corner(b)});
      else soup_.add_face({corner(a), corner(b), corner(c)});
    };
    if (mode == 4 && count % 3 != 0)
      fail(place, "its " + std::to_string(count) + " corners are no triangles; repair the file");
    const std::size_t triangles = mode == 4 ? count / 3 : count < 3 ? 0 : count - 2;
    if (triangles + soup_.face_count() > bytes() + most_triangles_beside_the_files)
      fail(place, "nodes repeat meshes to too many triangles; write a file with fewer copies");
    for (std::size_t t = 0; t < triangles; ++t) {
      if (mode == 4) add(3 * t, 3 * t + 1, 3 * t + 2);
      else if (mode == 5) add(t, t + 1 + t % 2, t + 2 - t % 2);
      else add(t + 1, t + 2, 0);
    }
  }

  const Input& input_;
  const Gltf_neighbour& neighbour_;
  Read_options options_;
  std::size_t json_begin_ = json_begin;  // in the file; 0 where it is the file
  Tree tree_;
  Buffer binary_;                             // the chunk; no bytes where there is none
  std::map<std::uint64_t, Buffer> buffers_;   // those that were asked for
  std::map<std::string, std::string> files_;  // bytes by path: each is read once, however many buffers it is
  std::size_t bytes_beside_ = 0;              // of all that is not in the file
  std::set<std::size_t> placed_;
  Grid_limit grid_;
  Polygon_soup soup_;
};

}  // namespace

bool looks_like_glb(std::string_view bytes) { return bytes.starts_with(glb_magic); }

Polygon_soup read_glb(const Input& input, const Read_options& options, const Gltf_neighbour& neighbour) {
  return Gltf_reader(input, neighbour, options).read_binary();
}
Polygon_soup read_gltf(const Input& input, const Read_options& options, const Gltf_neighbour& neighbour) {
  return Gltf_reader(input, neighbour, options).read_text();
}

}  // namespace sightline
