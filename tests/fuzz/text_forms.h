#pragma once
// Files of one triangle of which one line is written in each of its forms, right and wrong: which of these are taken is
// known, and what is taken is the triangle.

#include "readers.h"
#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/format.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// A line of a file, from 1, and what may stand there instead, and what must not.
struct Line_forms {
  std::size_t line;
  std::vector<std::string_view> right, wrong;
};

struct File_forms {
  Format format;
  std::vector<std::string_view> lines;
  std::vector<Line_forms> forms;
};

inline const std::vector<File_forms>& file_forms() {
  static const std::vector<File_forms> all{
      {Format::ply,
       {"ply", "format ascii 1.0", "element vertex 3", "property float x", "property float y", "property float z",
        "element face 1", "property list uchar int vertex_indices", "end_header", "0 0 0", "1 0 0", "0 1 0", "3 0 1 2"},
       {{1, {}, {"ply\ncomment", "ply\nobj_info", "comment\nply", "plyx", "ply 1", "format", "element vertex 3\nply"}},
        {2,
         {"format ascii 1.0\ncomment", "  format\tascii 1.0 ", "format ascii 1.0\nelement extra 0\nproperty int x",
          "format ascii 1.0\nelement empty 7"},
         {"", "form ascii 1.0", "element ascii 1.0", "format", "format text 1.0", "format ascii 1.1", "format ascii",
          "format ascii 1.0 1", "format ascii 1.0\nformat ascii 1.0", "format ascii 1.0\nproperty float x",
          "format binary_little_endian 1.0"}},
        {3,
         {"element vertex +3"},
         {"", "element vertex 2", "element vertex 4", "element vertex", "element vertex x", "element vertex -3",
          "element vertex 3 3", "element", "element tristrips 0", "element points 3", "elements vertex 3",
          "element vertex 3\nelement vertex 3", "element vertex 4294967299", "element vertex 3.0"}},
        {5,
         {"property int y", "property uint8 y", "property double y", "property float32 y", "property int16 y"},
         {"", "property float x", "property float w", "property list uchar float y", "property single y", "property y",
          "property float", "property float y 1", "properties float y", "property float y\nproperty float more"}},
        {7, {"element face 1\ncomment a face"}, {"element face 2", "element face 0", ""}},
        {8,
         {"property list int uint vertex_indices", "property list uint16 int8 vertex_index"},
         {"", "property list float int vertex_indices", "property list uchar float vertex_indices",
          "property uchar vertex_indices", "property list uchar int corners", "property list uchar vertex_indices",
          "property list uchar int", "property list uchar int vertex_indices more",
          "property list uchar int vertex_indices\nproperty list uchar int vertex_indices"}},
        {9, {"comment\nend_header"}, {"", "end_header 1", "end", "end_header\nend_header"}},
        {11, {"1.0 0e3 -0", "1e0 0 0", "+1 0 0"}, {"", "1 0", "1 0 0 0", "1 0 x", "1 0 nan", "1 0 inf"}},
        {13,
         {"3\t0 1 2 "},
         {"", "2 0 1 2", "4 0 1 2", "3 0 1", "3 0 1 3", "3 0 1 -1", "3 0 1 2 0", "-3 0 1 2", "3 0 1 x", "3 0 1 2.5",
          "3 0 1 2\n3 0 1 2"}}}},
      {Format::off,
       {"OFF", "3 1 0", "0 0 0", "1 0 0", "0 1 0", "3 0 1 2"},
       {{1,
         {"COFF", "NOFF", "STOFF", "STCNOFF", "# a triangle\nOFF", ""},
         {"off", "OF", "OFFX", "4OFF", "nOFF", "ST4OFF", "OFF BINARY", "CSTOFF", "COFFC", "OFF 3"}},
        {2,
         {"3 1 9", "3 1", "3 1 -7", "3 1 0 # edges"},
         {"3 1 0 0", "3", "2 1 0", "4 1 0", "3 2 0", "3 0 0", "x 1 0", "3 x 0", "3 1 x", "-3 1 0", "3 -1 0", "3.0 1 0",
          "4294967299 1 0", ""}},
        {4,
         {"1 0 0 1 2 3 4", "1.0 0e9 -0", "1e0 .0 0.", "# at one\n1 0 0"},
         {"", "1 0", "1 0 0 1 2 3 4 5", "1 0 x", "1 0 nan", "1 0 0x0", "1 0 0 red", "1 0 1/2/3", "1,0,0"}},
        {6,
         {"3 0 1 2 1 2 3 4", "3 0 1 2 0.5"},
         {"", "2 0 1 2 1 2 3 4", "4 0 1 2", "3 0 1", "3 0 1 3", "3 0 1 -1", "3 0 1 -0", "-3 0 1 2", "3 0 1 x",
          "3 0 1 2.5", "3 0 1 2 1 2 3 4 5", "3 0 1 2\n3 0 1 2", "3 0 1 2 x"}}}},
      {Format::obj,
       {"# a triangle", "v 0 0 0", "v 1 0 0", "v 0 1 0", "f 1 2 3"},
       {{1,
         {"", "g", "o a", "s off", "usemtl", "mtllib none.mtl", "vt 1", "vn 0 0 1", "vp 1", "l 1 2", "p 1", "mg 1 2",
          "lod 1"},
         {"x", "f_interp", "V 0 0 0", "curv 0 1 1 2", "deg 3", "end", "vx 0", "fa 1 2 3"}},
        {3,
         {"v 1 0 0 1", "v 1 0 0 1.0", "v 1 0 0 0.5 0 1", "v 1 0 0 1 0.5 0 1", "v  1.0\t0e3 -0"},
         {"v 1 0", "v", "v 1 0 x", "v 1 0 0 2", "v 1 0 0 0", "v 1 0 0 1 2", "v 1 0 0 2 0.5 0 1", "v 1 0 0 1 2 3 4 5",
          "v 1 0 0 1 2 x", "v 1 0 inf", "v 1/1 0 0"}},
        {5,
         {"f 1/1 2/2 3/3", "f 1//1 2//7 3//-1", "f 1/1/1 2/2/2 3/3/3", "f -3 -2 -1", "fo 1 2 3", "f 1/ 2/ 3/",
          "f 1 2 \\\n3"},
         {"f 1 2 4", "f 1 2 0", "f 1 2 -4", "f 1 2 x", "f 1 2 3/x", "f 1 2 3/1/x", "f 1 2 3/1/1/1", "f 1 2 /3",
          "f 1.0 2 3", "f 1 2 3,"}}}},
      {Format::stl,
       {"solid", "facet normal 0 0 1", "outer loop", "vertex 0 0 0", "vertex 1 0 0", "vertex 0 1 0", "endloop",
        "endfacet", "endsolid"},
       {{1,
         {"solid named by some words", "SOLID", "solid\nendsolid\nsolid next", "  solid"},
         {"", "solids", "facet", "solid\nsolid", "solid\nendfacet"}},
        {2,
         {"facet normal 1 2 3", "FACET Normal 0 0 1", "facet\nnormal 0\n0 1", "facet normal 0 0 0"},
         {"", "facet 0 0 1", "facet normal 0 0", "facet normal 0 0 1 0", "facet normal 0 0 x", "face normal 0 0 1"}},
        {3, {"outer\nloop", "Outer LOOP"}, {"", "outer", "loop", "outer loops", "outer loop outer loop"}},
        {5,
         {"vertex\n1 0 0", "VERTEX 1.0 0e5 -0"},
         {"vertex 1 0", "vertex 1 0 0 0", "vertex 1 0 x", "vertex 1 0 nan", "vertices 1 0 0", "1 0 0"}},
        {7, {"ENDLOOP"}, {"", "endloops", "vertex", "endloop endloop"}},
        {8, {"endFacet"}, {"", "endfacets", "endloop", "endsolid"}},
        {9,
         {"endsolid\nsolid\nendsolid", "endsolid of some name"},
         {"endsolids", "endsolid\nfacet", "vertex 0 0 0"}}}}};
  return all;
}

/// One of them; the triangle iff it is right.
inline void try_forms(generate::Random& random) {
  const File_forms& file = file_forms()[random.below(file_forms().size())];
  const Line_forms& of_line = file.forms[random.below(file.forms.size())];
  const bool is_right = random.chance(1, 3) && !of_line.right.empty();
  const std::vector<std::string_view>& forms = is_right ? of_line.right : of_line.wrong;
  const std::string_view form = forms[random.below(forms.size())];
  const std::string_view end = random.chance(1, 4) ? "\r\n" : "\n";
  std::string text;
  for (std::size_t k = 0; k < file.lines.size(); ++k) {
    const std::string_view line = k + 1 == of_line.line ? form : file.lines[k];
    for (const char c : line) {
      if (c == '\n') text += end;
      else text += c;
    }
    text += end;
  }
  const std::optional<Polygon_soup> soup = scene_in(text, file.format);
  if (soup.has_value() != is_right)
    throw Finding((is_right ? "a line that is right is refused: " : "a line that is wrong is taken: ") +
                  std::string(form));
  if (!soup) return;
  require(soup->point_count() == 3 && soup->face_count() == 1 && soup->loop(0).size() == 3, "it is a triangle");
  for (std::size_t k = 0; k < 3; ++k)
    require(soup->loop(0)[k] == k && soup->point(static_cast<Point_id>(k)) == Exact_point{k == 1, k == 2, 0},
            "a triangle has its corners in their order");
}

}  // namespace fuzz
