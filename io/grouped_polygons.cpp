// Groups of polygons as OBJ, PLY, VTK's XML and binary glTF.

#include <sightline/io/grouped_polygons.h>

#include <sightline/io/base64.h>
#include <sightline/io/binary.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace sightline {

namespace {

using Json = nlohmann::ordered_json;
using Polygons = Grouped_polygons;

/// The shortest decimal that is this double.
std::string text_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::int64_t id_of(const Polygons::Polygon& polygon) {
  return polygon.face == Polygons::no_face ? -1 : static_cast<std::int64_t>(polygon.face);
}

/// Calls visit(polygon's number, its first corner, the one behind its last).
template <class Visit>
void each_polygon(const Polygons& all, Visit visit) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < all.polygons().size(); ++i) {
    visit(i, begin, all.polygons()[i].end);
    begin = all.polygons()[i].end;
  }
}

// ---- OBJ

std::string obj_bytes(const Polygons& all) {
  std::string text;
  for (const Polygons::Point& p : all.points())
    text += "v " + text_of(p[0]) + ' ' + text_of(p[1]) + ' ' + text_of(p[2]) + '\n';
  std::uint32_t group = ~std::uint32_t{0};
  each_polygon(all, [&](std::size_t i, std::size_t begin, std::size_t end) {
    if (all.polygons()[i].group != group) {
      group = all.polygons()[i].group;
      const std::string& name = all.groups()[group].name;
      text += "g " + name + "\nusemtl " + name + '\n';
    }
    text += 'f';
    for (std::size_t k = begin; k < end; ++k) text += ' ' + std::to_string(all.corners()[k] + 1);
    text += '\n';
  });
  return text;
}

// ---- PLY

std::string ply_bytes(const Polygons& all) {
  std::size_t most = 0;
  each_polygon(all, [&](std::size_t, std::size_t begin, std::size_t end) { most = std::max(most, end - begin); });
  const bool is_short = most < 256;  // what some readers take for granted
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment written by sightline\n";
  for (std::size_t g = 0; g < all.groups().size(); ++g)
    bytes += "comment group " + std::to_string(g) + " is " + all.groups()[g].name + '\n';
  bytes += "element vertex " + std::to_string(all.points().size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(all.polygons().size()) + "\nproperty list " + std::string(is_short ? "uchar" : "uint") +
           " int vertex_indices\nproperty int face\nproperty uint group\n";
  for (const Polygons::Column& column : all.columns()) bytes += "property uint " + column.name + '\n';
  bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (const Polygons::Point& p : all.points())
    for (const double x : p) store(bytes, x);
  each_polygon(all, [&](std::size_t i, std::size_t begin, std::size_t end) {
    if (is_short) store(bytes, static_cast<std::uint8_t>(end - begin));
    else store(bytes, static_cast<std::uint32_t>(end - begin));
    for (std::size_t k = begin; k < end; ++k) store(bytes, all.corners()[k]);
    store(bytes, static_cast<std::int32_t>(id_of(all.polygons()[i])));
    store(bytes, all.polygons()[i].group);
    for (const Polygons::Column& column : all.columns()) store(bytes, column.values[i]);
    for (const std::uint8_t part : all.groups()[all.polygons()[i].group].colour) store(bytes, part);
  });
  return bytes;
}

// ---- VTK

/// An array of `count` numbers, which `fill` appends.
std::string data_array(std::string_view type, std::string_view name, int components,
                       const std::function<void(std::string&)>& fill) {
  std::string bytes, header;
  fill(bytes);
  store(header, std::uint64_t{bytes.size()});
  std::string text = "<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + '"';
  if (components > 1) text += " NumberOfComponents=\"" + std::to_string(components) + '"';
  return text + " format=\"binary\">" + base64(header + bytes) + "</DataArray>\n";
}

/// In comments, which may have no -- and not end with - : arrays of strings are what many readers do not know.
std::string group_names(const Polygons& all) {
  std::string text;
  for (std::size_t g = 0; g < all.groups().size(); ++g) {
    std::string name = all.groups()[g].name;
    for (std::size_t k = 1; k < name.size(); ++k)
      if (name[k - 1] == '-' && name[k] == '-') name[k] = '_';
    text += "<!-- group " + std::to_string(g) + " is " + name + " -->\n";
  }
  return text;
}

std::string vtk_bytes(const Polygons& all, bool unstructured) {
  const std::string kind = unstructured ? "UnstructuredGrid" : "PolyData", cells = unstructured ? "Cells" : "Polys";
  const std::string count = std::to_string(all.polygons().size());
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind +
                     "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" + kind + ">\n" +
                     group_names(all) + "<Piece NumberOfPoints=\"" + std::to_string(all.points().size());
  text += unstructured
              ? "\" NumberOfCells=\"" + count + "\">\n"
              : "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + count + "\">\n";
  text += "<Points>\n" +
          data_array("Float64", "Points", 3,
                     [&](std::string& bytes) {
                       for (const Polygons::Point& p : all.points())
                         for (const double x : p) store(bytes, x);
                     }) +
          "</Points>\n<" + cells + ">\n";
  text += data_array("Int64", "connectivity", 1, [&](std::string& bytes) {
    for (const std::uint32_t corner : all.corners()) store(bytes, std::int64_t{corner});
  });
  text += data_array("Int64", "offsets", 1, [&](std::string& bytes) {
    for (const Polygons::Polygon& polygon : all.polygons()) store(bytes, static_cast<std::int64_t>(polygon.end));
  });
  constexpr std::uint8_t vtk_polygon = 7;
  if (unstructured)
    text += data_array("UInt8", "types", 1, [&](std::string& bytes) {
      for (std::size_t i = 0; i < all.polygons().size(); ++i) store(bytes, vtk_polygon);
    });
  text += "</" + cells + ">\n<CellData Scalars=\"group\">\n";
  text += data_array("Int64", "face", 1, [&](std::string& bytes) {
    for (const Polygons::Polygon& polygon : all.polygons()) store(bytes, id_of(polygon));
  });
  text += data_array("UInt32", "group", 1, [&](std::string& bytes) {
    for (const Polygons::Polygon& polygon : all.polygons()) store(bytes, polygon.group);
  });
  for (const Polygons::Column& column : all.columns())
    text += data_array("UInt32", column.name, 1, [&](std::string& bytes) {
      for (const std::uint32_t value : column.values) store(bytes, value);
    });
  text += data_array("UInt8", "colour", 3, [&](std::string& bytes) {
    for (const Polygons::Polygon& polygon : all.polygons())
      for (const std::uint8_t part : all.groups()[polygon.group].colour) store(bytes, part);
  });
  return text + "</CellData>\n</Piece>\n</" + kind + ">\n</VTKFile>\n";
}

// ---- glTF

/// The middle of the box of all points.
Polygons::Point middle_of(const std::vector<Polygons::Point>& points) {
  Polygons::Point middle{};
  for (std::size_t axis = 0; axis < 3 && !points.empty(); ++axis) {
    const auto [least, most] = std::minmax_element(points.begin(), points.end(),
                                                   [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    middle[axis] = (*least)[axis] / 2 + (*most)[axis] / 2;
  }
  return middle;
}

/// Of the power of two that points beside their middle are divided by, so that floats hold them: 0 where they do.
int exponent_of(const std::vector<Polygons::Point>& points, const Polygons::Point& middle) {
  double reach = 0;
  for (const Polygons::Point& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) reach = std::max(reach, std::fabs(p[axis] - middle[axis]));
  return reach == 0 || (reach >= 0x1p-100 && reach <= 0x1p100) ? 0 : std::ilogb(reach);
}

/// What the format's colours are: light, not what a screen is told.
double linear(std::uint8_t part) {
  const double s = part / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// A glTF file as it is put together: its tree, and the numbers that it speaks of.
class Gltf_writer {
 public:
  explicit Gltf_writer(const Polygons& all)
      : all_(all),
        middle_(middle_of(all.points())),
        exponent_(exponent_of(all.points(), middle_)),
        first_(all.polygons().size()) {
    each_polygon(all, [&](std::size_t i, std::size_t begin, std::size_t) { first_[i] = begin; });
  }

  std::string bytes() {
    Json primitives = Json::array(), materials = Json::array();
    for (std::uint32_t g = 0; g < all_.groups().size(); ++g)
      if (add_group(g, primitives, materials.size())) materials.push_back(material(all_.groups()[g]));
    Json tree{{"asset", {{"version", "2.0"}, {"generator", "sightline"}}}, {"scene", 0}};
    tree["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    tree["nodes"] = Json::array({{{"translation", middle_}}});
    if (exponent_ != 0) tree["nodes"][0]["scale"] = std::vector<double>(3, std::ldexp(1, exponent_));
    if (!primitives.empty()) {
      tree["nodes"][0]["mesh"] = 0;
      tree["meshes"] = Json::array({{{"primitives", std::move(primitives)}}});
      tree["materials"] = std::move(materials);
      tree["accessors"] = std::move(accessors_);
      tree["bufferViews"] = std::move(views_);
      tree["buffers"] = Json::array({{{"byteLength", numbers_.size()}}});
    }
    return joined(tree.dump());
  }

 private:
  static Json material(const Polygons::Group& group) {
    const auto [red, green, blue] = group.colour;
    return {{"name", group.name},
            {"doubleSided", true},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {linear(red), linear(green), linear(blue), 1}},
              {"metallicFactor", 0},
              {"roughnessFactor", 1}}}};
  }

  /// A group's polygons as fans of triangles, with corners of their own, so that each has its face. Returns whether
  /// there are any.
  bool add_group(std::uint32_t group, Json& primitives, std::size_t material) {
    std::vector<std::uint32_t> triangles, owners;
    std::vector<float> places;
    std::array<float, 3> least, most;
    least.fill(std::numeric_limits<float>::infinity());
    most.fill(-std::numeric_limits<float>::infinity());
    for (std::uint32_t i = 0; i < all_.polygons().size(); ++i) {
      if (all_.polygons()[i].group != group) continue;
      const std::uint32_t base = static_cast<std::uint32_t>(owners.size());
      const std::size_t end = all_.polygons()[i].end;
      for (std::size_t k = first_[i]; k < end; ++k) {
        const Polygons::Point& p = all_.points()[all_.corners()[k]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          places.push_back(static_cast<float>(std::ldexp(p[axis] - middle_[axis], -exponent_)));
          least[axis] = std::min(least[axis], places.back());
          most[axis] = std::max(most[axis], places.back());
        }
        owners.push_back(i);
      }
      for (std::uint32_t k = base + 2; k < owners.size(); ++k) triangles.insert(triangles.end(), {base, k - 1, k});
    }
    if (triangles.empty()) return false;
    Json attributes{{"POSITION", add_numbers(places, "VEC3")}};
    accessors_.back()["min"] = least;
    accessors_.back()["max"] = most;
    attributes["_FACE"] =
        add_column(owners, [&](std::uint32_t i) { return static_cast<float>(id_of(all_.polygons()[i])); });
    for (const Polygons::Column& column : all_.columns()) {
      std::string name = "_" + column.name;
      for (char& c : name)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      attributes[name] = add_column(owners, [&](std::uint32_t i) { return static_cast<float>(column.values[i]); });
    }
    primitives.push_back(
        {{"attributes", std::move(attributes)}, {"indices", add_numbers(triangles, "SCALAR")}, {"material", material}});
    return true;
  }

  template <class Value>
  std::size_t add_column(const std::vector<std::uint32_t>& owners, Value value) {
    std::vector<float> values;
    for (const std::uint32_t i : owners) values.push_back(value(i));
    return add_numbers(values, "SCALAR");
  }

  template <class Value>
  std::size_t add_numbers(const std::vector<Value>& values, const char* type) {
    constexpr int floats = 5126, unsigned_ints = 5125, array_buffer = 34962, element_array_buffer = 34963;
    constexpr bool is_float = std::is_same_v<Value, float>;
    views_.push_back({{"buffer", 0},
                      {"byteOffset", numbers_.size()},
                      {"byteLength", values.size() * sizeof(Value)},
                      {"target", is_float ? array_buffer : element_array_buffer}});
    for (const Value value : values) store(numbers_, value);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", is_float ? floats : unsigned_ints},
                          {"count", std::string_view(type) == "VEC3" ? values.size() / 3 : values.size()},
                          {"type", type}});
    return accessors_.size() - 1;
  }

  /// Header, tree and numbers, as one file.
  std::string joined(std::string tree) const {
    constexpr std::uint32_t magic = 0x46546C67, version = 2, json = 0x4E4F534A, bin = 0x004E4942;
    while (tree.size() % 4 != 0) tree += ' ';
    const bool has_numbers = !numbers_.empty();
    std::string bytes;
    store(bytes, magic);
    store(bytes, version);
    store(bytes, static_cast<std::uint32_t>(12 + 8 + tree.size() + (has_numbers ? 8 + numbers_.size() : 0)));
    store(bytes, static_cast<std::uint32_t>(tree.size()));
    store(bytes, json);
    bytes += tree;
    if (has_numbers) {
      store(bytes, static_cast<std::uint32_t>(numbers_.size()));
      store(bytes, bin);
      bytes += numbers_;
    }
    return bytes;
  }

  const Polygons& all_;
  Polygons::Point middle_;
  int exponent_;
  std::vector<std::size_t> first_;  // corner of a polygon
  Json accessors_ = Json::array(), views_ = Json::array();
  std::string numbers_;  // four bytes each
};

}  // namespace

std::size_t Grouped_polygons::Hash::operator()(const Point& p) const {
  std::uint64_t hash = 0;
  for (const double x : p) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

std::uint32_t Grouped_polygons::add_group(std::string name, std::array<std::uint8_t, 3> colour) {
  groups_.push_back({std::move(name), colour});
  return static_cast<std::uint32_t>(groups_.size() - 1);
}

void Grouped_polygons::add_polygon(std::uint32_t group, Face_id face, const std::vector<Exact_point>& corners) {
  for (const Exact_point& corner : corners) {
    Point p;
    for (int axis = 0; axis < 3; ++axis) {
      p[static_cast<std::size_t>(axis)] = nearest_double(corner[axis]) + 0.0;  // no -0
      if (!std::isfinite(p[static_cast<std::size_t>(axis)]))
        throw std::overflow_error("a corner of face " + std::to_string(face) +
                                  " is too large for doubles, which files for drawing hold; scale the scene down");
    }
    corners_.push_back(known_.try_emplace(p, static_cast<std::uint32_t>(points_.size())).first->second);
    if (corners_.back() == points_.size()) points_.push_back(p);
  }
  polygons_.push_back({group, face, corners_.size()});
}

void Grouped_polygons::add_column(std::string name, std::vector<std::uint32_t> values) {
  columns_.push_back({std::move(name), std::move(values)});
}

std::optional<Drawing_format> drawing_format_of_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (const auto& [name, format] : {std::pair(".obj", Drawing_format::obj),
                                     {".ply", Drawing_format::ply},
                                     {".glb", Drawing_format::glb},
                                     {".vtp", Drawing_format::vtp},
                                     {".vtu", Drawing_format::vtu}})
    if (ending == name) return format;
  return {};
}

std::string drawing_bytes(const Grouped_polygons& polygons, Drawing_format format) {
  switch (format) {
    case Drawing_format::obj: return obj_bytes(polygons);
    case Drawing_format::ply: return ply_bytes(polygons);
    case Drawing_format::glb: return Gltf_writer(polygons).bytes();
    case Drawing_format::vtp: return vtk_bytes(polygons, false);
    case Drawing_format::vtu: return vtk_bytes(polygons, true);
  }
  return {};
}

}  // namespace sightline
