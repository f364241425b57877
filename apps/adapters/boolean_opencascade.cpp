// An adapter for `sightline judge`: set operations by OpenCASCADE, whose solids have tolerances. What it declines, and
// what it takes no solid for, as an edge of other than two faces, is left open.

#include "adapter.h"

#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/io/off.h>
#include <sightline/kernel/scene/convex_parts.h>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_TVertex.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Ax2.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace {

using namespace sightline;

/// What OpenCASCADE declines to answer, or takes no solid for.
struct Declined {};

using Triangle = std::array<Point_id, 3>;

gp_Pnt point_of(const Polygon_soup& solid, Point_id p) {
  const Exact_point at = solid.point(p);
  return {nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])};
}

// ---- Solids from triangles

/// A closed surface as shapes that share their vertices and edges.
class Surface {
 public:
  explicit Surface(const Polygon_soup& solid) : solid_(solid) {
    for (Point_id p = 0; p < solid.point_count(); ++p)
      vertices_.push_back(BRepBuilderAPI_MakeVertex(point_of(solid, p)).Vertex());
    for (Face_id face = 0; face < solid.face_count(); ++face)
      for (const std::vector<Point_id>& corners : triangles_of(solid, face))
        triangles_.push_back({corners[0], corners[1], corners[2]});
  }

  /// Its bodies: each a shell that turns outwards, and those inside it that turn inwards.
  TopTools_ListOfShape solids() {
    std::vector<Shell> shells = connected();
    std::sort(shells.begin(), shells.end(), [](const Shell& a, const Shell& b) { return a.volume > b.volume; });
    std::vector<TopoDS_Solid> bodies;
    for (const Shell& shell : shells) {
      if (shell.volume > 0) {
        builder_.MakeSolid(bodies.emplace_back());
        builder_.Add(bodies.back(), shell.shape);
      } else {
        builder_.Add(bodies.at(holder(bodies, shell)), shell.shape);
      }
    }
    TopTools_ListOfShape all;
    for (const TopoDS_Solid& body : bodies) all.Append(body);
    return all;
  }

 private:
  struct Shell {
    TopoDS_Shell shape;
    double volume = 0;
    Point_id corner = 0;
  };

  /// The edge between two points, as it runs from the first one.
  TopoDS_Shape edge(Point_id from, Point_id to) {
    TopoDS_Edge& made = edges_[std::minmax(from, to)];
    if (made.IsNull()) {
      BRepBuilderAPI_MakeEdge maker(vertices_[std::min(from, to)], vertices_[std::max(from, to)]);
      if (!maker.IsDone()) throw Declined();  // as its ends are nearer to each other than a tolerance
      made = maker.Edge();
    }
    return made.Oriented(from < to ? TopAbs_FORWARD : TopAbs_REVERSED);
  }

  TopoDS_Face face(const Triangle& triangle) {
    const gp_Pnt a = point_of(solid_, triangle[0]), b = point_of(solid_, triangle[1]),
                 c = point_of(solid_, triangle[2]);
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t k = 0; k < 3; ++k) builder_.Add(wire, edge(triangle[k], triangle[(k + 1) % 3]));
    wire.Closed(true);
    BRepBuilderAPI_MakeFace maker(gp_Pln(a, gp_Dir(gp_Vec(a, b).Crossed(gp_Vec(a, c)))), wire, false);
    if (!maker.IsDone()) throw Declined();
    return maker.Face();
  }

  /// Six times the volume below a triangle.
  double volume_below(const Triangle& triangle) const {
    const gp_Vec a(point_of(solid_, 0), point_of(solid_, triangle[0]));
    const gp_Vec b(point_of(solid_, 0), point_of(solid_, triangle[1]));
    const gp_Vec c(point_of(solid_, 0), point_of(solid_, triangle[2]));
    return a.Dot(b.Crossed(c));
  }

  /// Which triangles hang together by edges, each of two triangles that run along it either way.
  std::vector<Shell> connected() {
    std::map<std::pair<Point_id, Point_id>, std::size_t> along;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (!along.emplace(std::pair(triangles_[t][k], triangles_[t][(k + 1) % 3]), t).second) throw Declined();
    std::vector<std::size_t> root(triangles_.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t t) {
      while (root[t] != t) t = root[t] = root[root[t]];
      return t;
    };
    for (const auto& [ends, triangle] : along) {
      const auto other = along.find({ends.second, ends.first});
      if (other == along.end()) throw Declined();
      root[find(triangle)] = find(other->second);
    }
    std::map<std::size_t, Shell> shells;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Shell& shell = shells[find(t)];
      if (shell.shape.IsNull()) builder_.MakeShell(shell.shape);
      builder_.Add(shell.shape, face(triangles_[t]));
      shell.volume += volume_below(triangles_[t]);
      shell.corner = triangles_[t][0];
    }
    std::vector<Shell> all;
    for (auto& [number, shell] : shells) {
      shell.shape.Closed(true);
      all.push_back(shell);
    }
    return all;
  }

  /// The smallest body that holds a shell which turns inwards.
  std::size_t holder(const std::vector<TopoDS_Solid>& bodies, const Shell& shell) const {
    for (std::size_t k = bodies.size(); k-- > 0;) {
      BRepClass3d_SolidClassifier classifier(bodies[k]);
      classifier.Perform(point_of(solid_, shell.corner), Precision::Confusion());
      if (classifier.State() == TopAbs_IN) return k;
    }
    throw Declined();
  }

  const Polygon_soup& solid_;
  TopoDS_Builder builder_;
  std::vector<TopoDS_Vertex> vertices_;
  std::map<std::pair<Point_id, Point_id>, TopoDS_Edge> edges_;
  std::vector<Triangle> triangles_;
};

// ---- The operation

template <class Operation>
TopoDS_Shape combined(const TopTools_ListOfShape& a, const TopTools_ListOfShape& b) {
  Operation operation;
  operation.SetArguments(a);
  operation.SetTools(b);
  operation.SetNonDestructive(true);
  operation.Build();
  if (!operation.IsDone() || operation.HasErrors()) throw Declined();
  return operation.Shape();
}

TopTools_ListOfShape solids_in(const TopoDS_Shape& shape) {
  TopTools_ListOfShape solids;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) solids.Append(solid.Current());
  return solids;
}

TopoDS_Shape combined(const TopTools_ListOfShape& a, const TopTools_ListOfShape& b, Set_operation operation) {
  switch (operation) {
    case Set_operation::unite: return combined<BRepAlgoAPI_Fuse>(a, b);
    case Set_operation::intersect: return combined<BRepAlgoAPI_Common>(a, b);
    case Set_operation::subtract: return combined<BRepAlgoAPI_Cut>(a, b);
    case Set_operation::differ: break;
  }
  const TopoDS_Shape first = combined<BRepAlgoAPI_Cut>(a, b), second = combined<BRepAlgoAPI_Cut>(b, a);
  const TopTools_ListOfShape of_first = solids_in(first), of_second = solids_in(second);
  if (of_first.IsEmpty()) return second;
  if (of_second.IsEmpty()) return first;
  return combined<BRepAlgoAPI_Fuse>(of_first, of_second);
}

// ---- Triangles from solids

// Not by BRep_Tool: a header that it asks for is missing from Debian 12's packages.
gp_Pnt point_of(const TopoDS_Vertex& vertex) {
  return Handle(BRep_TVertex)::DownCast(vertex.TShape())->Pnt().Transformed(vertex.Location().Transformation());
}

/// The loops of a face as its vertices, the outer one first, counterclockwise as seen from its front.
std::vector<std::vector<TopoDS_Vertex>> loops_of(const TopoDS_Face& face) {
  std::vector<std::vector<TopoDS_Vertex>> loops;
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const TopoDS_Wire outer = BRepTools::OuterWire(forward);
  for (TopExp_Explorer wires(forward, TopAbs_WIRE); wires.More(); wires.Next()) {
    const TopoDS_Wire& wire = TopoDS::Wire(wires.Current());
    std::vector<TopoDS_Vertex> loop;
    for (BRepTools_WireExplorer edges(wire, forward); edges.More(); edges.Next()) loop.push_back(edges.CurrentVertex());
    if (face.Orientation() == TopAbs_REVERSED) std::reverse(loop.begin(), loop.end());
    loops.insert(wire.IsSame(outer) ? loops.begin() : loops.end(), loop);
  }
  if (loops.empty() || loops[0].size() < 3) throw Declined();
  return loops;
}

/// A face, whose corners may be off its plane by a rounding, as triangles: places in its loops, one after the other.
std::vector<std::vector<std::uint32_t>> triangles_between(const std::vector<std::vector<gp_Pnt>>& loops) {
  const std::vector<gp_Pnt>& outer = loops[0];
  gp_Vec normal;
  for (std::size_t i = 1; i + 1 < outer.size(); ++i)
    normal += gp_Vec(outer[0], outer[i]).Crossed(gp_Vec(outer[0], outer[i + 1]));
  const gp_Ax2 axes(outer[0], gp_Dir(normal));
  std::vector<std::array<Rational, 2>> points;
  std::vector<std::vector<std::uint32_t>> places;
  Integer common = 1;
  for (const std::vector<gp_Pnt>& loop : loops) {
    places.emplace_back();
    for (const gp_Pnt& p : loop) {
      const gp_Vec from(outer[0], p);
      places.back().push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({exact(from.Dot(gp_Vec(axes.XDirection()))), exact(from.Dot(gp_Vec(axes.YDirection())))});
      for (const Rational& x : points.back()) common = lcm(common, x.get_den());
    }
  }
  std::vector<Planar_point> planar;
  for (const std::array<Rational, 2>& p : points)
    planar.push_back({Integer(Rational(p[0] * common).get_num()), Integer(Rational(p[1] * common).get_num())});
  const Convex_parts parts = triangles(planar, places);
  if (parts.contour != Contour::simple) throw Declined();
  return parts.pieces;
}

/// The faces of a shape's solids, as triangles between its vertices.
Polygon_soup surface_of(const TopoDS_Shape& shape) {
  Polygon_soup soup;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  for (int v = 1; v <= vertices.Extent(); ++v) {
    const gp_Pnt at = point_of(TopoDS::Vertex(vertices(v)));
    soup.add_point(at.X(), at.Y(), at.Z());
  }
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
    for (TopExp_Explorer faces(solid.Current(), TopAbs_FACE); faces.More(); faces.Next()) {
      std::vector<Point_id> corners;
      std::vector<std::vector<gp_Pnt>> points;
      for (const std::vector<TopoDS_Vertex>& loop : loops_of(TopoDS::Face(faces.Current()))) {
        points.emplace_back();
        for (const TopoDS_Vertex& vertex : loop) {
          corners.push_back(static_cast<Point_id>(vertices.FindIndex(vertex) - 1));
          points.back().push_back(point_of(vertex));
        }
      }
      for (const std::vector<std::uint32_t>& t : triangles_between(points))
        soup.add_face({corners[t[0]], corners[t[1]], corners[t[2]]});
    }
  return soup;
}

void solve(const adapter::Task& task) {
  std::ofstream out(task.answer);
  try {
    const std::array<Polygon_soup, 2> solids = judge::solids_of(task.soup, task.query.first);
    const TopTools_ListOfShape a = Surface(solids[0]).solids(), b = Surface(solids[1]).solids();
    write_qoff(surface_of(combined(a, b, task.query.operation)), out);
  } catch (const Declined&) {
    out << "abstained\n";
  } catch (const Standard_Failure&) {
    out << "abstained\n";
  }
  if (!out.flush()) throw std::runtime_error(task.answer + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::boolean, solve); }
