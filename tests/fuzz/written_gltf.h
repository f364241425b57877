#pragma once
// glTF files written for what is in them, and read: triangles, strips and fans with indices of all widths, below nodes
// that put them by matrices or by turns, scales and ways.

#include "refusals.h"
#include "support.h"

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/io/gltf.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <limits>
#include <string>
#include <vector>

namespace fuzz {

using Face_points = std::vector<Exact_point>;

/// The same loop, wherever it begins.
inline Face_points loop_from_least(Face_points loop) {
  Face_points least = loop;
  for (std::size_t k = 1; k < loop.size(); ++k) {
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    least = std::min(least, loop);
  }
  return least;
}
/// The faces of a soup, in order.
inline std::vector<Face_points> shown_faces(const Polygon_soup& soup) {
  std::vector<Face_points> faces;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    Face_points& loop = faces.emplace_back();
    for (const Point_id p : soup.loop(f)) loop.push_back(soup.point(p));
    loop = loop_from_least(loop);
  }
  return faces;
}

/// What a node does to a point: a matrix of rows and a way.
struct Node_map {
  std::array<Exact_point, 3> row{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Exact_point way{0, 0, 0};

  Exact_point of(const Exact_point& p) const {
    Exact_point q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = row[r][0] * p[0] + row[r][1] * p[1] + row[r][2] * p[2] + way[r];
    return q;
  }
  bool mirrors() const {
    return row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) -
               row[0][1] * (row[1][0] * row[2][2] - row[1][2] * row[2][0]) +
               row[0][2] * (row[1][0] * row[2][1] - row[1][1] * row[2][0]) <
           0;
  }
};

/// v -> p v p^-1 of a quaternion x, y, z, w, by multiplying quaternions.
inline Exact_point turned(const std::array<long, 4>& p, const Exact_point& v) {
  using Quaternion = std::array<Rational, 4>;
  const auto product = [](const Quaternion& a, const Quaternion& b) -> Quaternion {
    return {
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  };
  const Quaternion q{Rational(p[0]), Rational(p[1]), Rational(p[2]), Rational(p[3])};
  Rational size = 0;
  for (const Rational& x : q) size += x * x;
  const Quaternion back{-q[0] / size, -q[1] / size, -q[2] / size, q[3] / size};
  const Quaternion at = product(product(q, {v[0], v[1], v[2], Rational(0)}), back);
  return {at[0], at[1], at[2]};
}

/// A node's own map, and what a file says of it.
inline Node_map any_node(generate::Random& random, nlohmann::json& node) {
  Node_map map;
  const auto small = [&] { return static_cast<long>(random.between(-3, 3)); };
  if (random.chance(1, 4)) return map;
  if (random.chance(1, 2)) {
    nlohmann::json matrix = nlohmann::json::array();
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) map.row[r][c] = small();
      map.way[r] = small();
    }
    for (std::size_t c = 0; c < 4; ++c) {  // by column
      for (std::size_t r = 0; r < 3; ++r) matrix.push_back((c < 3 ? map.row[r][c] : map.way[r]).get_num().get_si());
      matrix.push_back(c < 3 ? 0 : 1);
    }
    node["matrix"] = matrix;
    return map;
  }
  if (random.chance(1, 2)) {
    std::array<long, 4> q{small(), small(), small(), small()};
    if (q == std::array<long, 4>{}) q[random.below(4)] = 1;
    node["rotation"] = q;
    for (std::size_t c = 0; c < 3; ++c) {
      Exact_point axis{0, 0, 0};
      axis[c] = 1;
      const Exact_point to = turned(q, axis);
      for (std::size_t r = 0; r < 3; ++r) map.row[r][c] = to[r];
    }
  }
  if (random.chance(1, 2)) {
    const std::array<long, 3> scale{small(), small(), small()};
    node["scale"] = scale;
    for (Exact_point& row : map.row)
      for (std::size_t c = 0; c < 3; ++c) row[c] *= scale[c];
  }
  if (random.chance(1, 2)) {
    const std::array<long, 3> way{small(), small(), small()};
    node["translation"] = way;
    for (std::size_t k = 0; k < 3; ++k) map.way[k] = way[k];
  }
  return map;
}

inline std::string in_base_64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

/// A file in the making: bytes, and what JSON says of them.
struct Written_gltf {
  std::string bytes;
  nlohmann::json json{{"asset", {{"version", "2.0"}}}};

  template <class Number>
  void put(Number value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  }
  void align(std::size_t to) {
    while (bytes.size() % to != 0) bytes += '\0';
  }
  /// An accessor of what was put since `begin`, in a view that begins `lead` bytes before that.
  std::size_t accessor(std::size_t begin, int component, std::size_t count, const char* type, std::size_t stride,
                       std::size_t lead) {
    nlohmann::json view{{"buffer", 0}, {"byteOffset", begin - lead}, {"byteLength", bytes.size() - begin + lead}};
    if (stride != 0) view["byteStride"] = stride;
    json["bufferViews"].push_back(view);
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"count", count},
                                 {"type", type}});
    if (lead != 0) json["accessors"].back()["byteOffset"] = lead;
    return json["accessors"].size() - 1;
  }
  std::string as_text() {
    json["buffers"] = {
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + in_base_64(bytes)}}};
    return json.dump();
  }
  /// With its bytes in a file beside it, whose name has letters that a URI writes by their numbers.
  std::string as_text_beside() {
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "in%20a%20bag/is%3a%2Bfed.bin"}}};
    return json.dump();
  }
  std::string as_binary() {
    json["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    align(4);
    Written_gltf file;
    file.bytes = "glTF";
    file.put(std::uint32_t{2});
    file.put(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bytes.size()));
    file.put(static_cast<std::uint32_t>(text.size()));
    file.bytes += "JSON" + text;
    file.put(static_cast<std::uint32_t>(bytes.size()));
    file.bytes += std::string("BIN\0", 4) + bytes;
    return file.bytes;
  }
};

/// Puts a primitive into a file, and gives its triangles.
inline std::vector<std::array<Exact_point, 3>> any_primitive(generate::Random& random, Written_gltf& file,
                                                             nlohmann::json& primitive) {
  // 1. Points, with room between them or none.
  std::vector<Exact_point> points(3 + random.below(6));
  const std::size_t stride = random.chance(1, 2) ? 0 : 12 + 4 * random.below(3);
  for (std::uint64_t k = random.below(4); k > 0; --k) file.put(2.0f);
  file.align(4);
  std::size_t begin = file.bytes.size();
  const auto any_lead = [&]() -> std::size_t { return random.chance(1, 2) ? 0 : 4 * random.below(begin / 4 + 1); };
  for (Exact_point& p : points) {
    for (Rational& x : p) {
      const std::int64_t eighths = random.between(-40, 40);
      x = generate::ratio(eighths, 8);
      file.put(static_cast<float>(eighths) / 8);
    }
    for (std::size_t k = 12; k < stride; k += 4) file.put(1.0f);
  }
  primitive["attributes"] = {{"POSITION", file.accessor(begin, 5126, points.size(), "VEC3", stride, any_lead())}};
  // 2. Its corners.
  static constexpr std::array modes{4, 5, 6};
  const int mode = modes[random.below(3)];
  if (mode != 4 || random.chance(1, 2)) primitive["mode"] = mode;
  std::vector<std::size_t> corners;
  if (random.chance(1, 4)) {
    if (mode == 4)  // all of them, in their order
      while (points.size() % 3 != 0) {
        points.pop_back();
        file.json["accessors"].back()["count"] = points.size();
      }
    for (std::size_t k = 0; k < points.size(); ++k) corners.push_back(k);
  } else {
    for (std::size_t k = mode == 4 ? 3 * random.below(4) : random.below(8); k > 0; --k)
      corners.push_back(random.below(points.size()));
    file.align(4);
    begin = file.bytes.size();
    const std::size_t width = random.below(3);
    for (const std::size_t k : corners) {
      if (width == 0) file.put(static_cast<std::uint8_t>(k));
      else if (width == 1) file.put(static_cast<std::uint16_t>(k));
      else file.put(static_cast<std::uint32_t>(k));
    }
    static constexpr std::array components{5121, 5123, 5125};
    if (corners.empty() && random.chance(1, 2)) file.put(std::uint32_t{0});
    primitive["indices"] = file.accessor(begin, components[width], corners.size(), "SCALAR", 0, any_lead());
  }
  // 3. Its triangles: of a strip each second one is turned round; those of a fan have its first corner last.
  std::vector<std::array<Exact_point, 3>> triangles;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({points[corners[a]], points[corners[b]], points[corners[c]]});
  };
  if (mode == 4)
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3) add(k, k + 1, k + 2);
  for (std::size_t k = 0; mode != 4 && k + 2 < corners.size(); ++k) {
    if (mode == 6) add(0, k + 1, k + 2);
    else if (k % 2 == 0) add(k, k + 1, k + 2);
    else add(k + 1, k, k + 2);
  }
  return triangles;
}

/// Of a coordinate that is no number the byte is told at which it is in the file.
inline void try_place_of_nonsense(generate::Random& random) {
  Written_gltf file;
  for (std::uint64_t k = random.below(4); k > 0; --k) file.put(2.0f);
  const std::size_t begin = file.bytes.size(), bad = random.below(9);
  for (std::size_t k = 0; k < 9; ++k)
    file.put(k == bad ? std::numeric_limits<float>::infinity() : static_cast<float>(random.between(-3, 3)));
  const std::size_t points = file.accessor(begin, 5126, 3, "VEC3", 0, 0);
  file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", points}}}}}}}};
  file.json["nodes"] = {{{"mesh", 0}}};
  const std::string bytes = file.as_binary();
  // The one word of the file's data that is infinite, by its bits; the data are all that is behind the JSON.
  const std::size_t at = bytes.size() - file.bytes.size() + begin + 4 * bad;
  std::string said;
  try {
    sightline::read_glb(Input{"written", bytes});
  } catch (const Input_error& error) {
    said = error.what();
  }
  require(said.find("byte " + std::to_string(at) + ":") != std::string::npos, "an error tells the byte that it is at");
}

/// A file of few meshes below few nodes has the triangles that were written, in order; one matrix that is no map of
/// points is refused.
inline void try_gltf(generate::Random& random) {
  Written_gltf file;
  std::vector<std::vector<std::array<Exact_point, 3>>> meshes;
  for (std::size_t m = 1 + random.below(2); m > 0; --m) {
    nlohmann::json primitives = nlohmann::json::array();
    std::vector<std::array<Exact_point, 3>>& triangles = meshes.emplace_back();
    for (std::size_t k = 1 + random.below(2); k > 0; --k) {
      const auto own = any_primitive(random, file, primitives.emplace_back());
      triangles.insert(triangles.end(), own.begin(), own.end());
    }
    file.json["meshes"].push_back({{"primitives", primitives}});
  }
  // Nodes: each below an earlier one or none; shown in the order in which they are come to.
  const std::size_t count = 1 + random.below(4);
  std::vector<Node_map> own(count);
  std::vector<std::vector<std::size_t>> children(count);
  std::vector<std::optional<std::size_t>> mesh_of(count);
  std::vector<std::size_t> roots;
  bool is_broken = false;
  for (std::size_t n = 0; n < count; ++n) {
    nlohmann::json node = nlohmann::json::object();
    own[n] = any_node(random, node);
    if (node.contains("matrix") && random.chance(1, 30)) {
      node["matrix"][4 * random.below(4) + 3] = 2;
      is_broken = true;
    }
    if (random.chance(3, 4)) {
      mesh_of[n] = random.below(meshes.size());
      node["mesh"] = *mesh_of[n];
    }
    file.json["nodes"].push_back(node);
    if (n > 0 && random.chance(1, 2)) children[random.below(n)].push_back(n);
    else roots.push_back(n);
  }
  for (std::size_t n = 0; n < count; ++n)
    if (!children[n].empty()) file.json["nodes"][n]["children"] = children[n];
  if (random.chance(1, 2)) {
    file.json["scenes"] = {{{"nodes", roots}}};
    if (random.chance(1, 2)) {
      file.json["scenes"].push_back(nlohmann::json::object());
      std::swap(file.json["scenes"][0], file.json["scenes"][1]);
      file.json["scene"] = 1;
    }
  }
  std::vector<Face_points> expected;
  const auto show = [&](auto& self, std::size_t n, std::vector<std::size_t> path) -> void {
    path.push_back(n);
    Node_map whole;  // for its sense
    for (std::size_t c = 0; c < 3; ++c) {
      Exact_point axis{0, 0, 0}, zero{0, 0, 0};
      axis[c] = 1;
      for (auto at = path.rbegin(); at != path.rend(); ++at) {
        axis = own[*at].of(axis);
        zero = own[*at].of(zero);
      }
      for (std::size_t r = 0; r < 3; ++r) whole.row[r][c] = axis[r] - zero[r];
    }
    if (mesh_of[n])
      for (std::array<Exact_point, 3> triangle : meshes[*mesh_of[n]]) {
        for (Exact_point& p : triangle)
          for (auto at = path.rbegin(); at != path.rend(); ++at) p = own[*at].of(p);
        if (whole.mirrors()) std::swap(triangle[1], triangle[2]);
        expected.push_back(loop_from_least({triangle.begin(), triangle.end()}));
      }
    for (const std::size_t child : children[n]) self(self, child, path);
  };
  for (const std::size_t n : roots) show(show, n, {});

  std::vector<Face_points> found;
  const std::size_t form = random.below(3);
  const std::string bytes = form == 0 ? file.as_binary() : form == 1 ? file.as_text() : file.as_text_beside();
  const Gltf_neighbour neighbour = [&](const std::string& path) {
    require(path == "in a bag/is:+fed.bin", "a file beside it is asked for by its name");
    return file.bytes;
  };
  const bool refused = is_refused<Input_error>([&] {
    const Input input{"written", bytes};
    found = shown_faces(form == 0 ? sightline::read_glb(input) : sightline::read_gltf(input, {}, neighbour));
  });
  require(refused == is_broken, "a file is refused iff a matrix is no map of points");
  require(refused || found == expected, "a file has the triangles that were written");
}

}  // namespace fuzz
