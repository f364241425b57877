#pragma once
// The face graph of a scene: which faces share an edge, where they close up, and which bodies are convex. OpenMesh
// carries it.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sightline {

struct Face_mesh;  ///< the OpenMesh: face_mesh.h

/// A node is a face of a polyhedron: pieces in one oriented plane that hang together by edges. An edge joins two nodes
/// that share one, walked in opposite directions. Degenerate: what is no manifold (an edge of three pieces, two pieces
/// that run along an edge in one direction, a vertex where two fans meet) has no edge there: OpenMesh refuses the piece
/// that comes last, which is then a node with vertices of its own; refused() counts these. T-junctions join nothing,
/// and corners on a straight side are no corners of a piece (see Scene), so a neighbour that has them as ends meets a
/// T-junction. Cost: O(corners) where no vertex has more than a few faces; O(n^2) of one of n, as its edges are looked
/// through for each. Exact: yes. Proof: P-50
class Face_graph {
 public:
  /// Two nodes and the edge that they share: its direction is counterclockwise round the first.
  struct Edge {
    std::uint32_t first, second;  ///< nodes
    std::uint32_t from, to;       ///< points of the scene
  };
  /// Nodes that hang together.
  struct Component {
    std::uint32_t node;  ///< one of them
    std::uint32_t nodes = 0, pieces = 0;
    bool closed = true;  ///< no piece has an edge without a neighbour
    /// Where the nodes are the faces of one convex body: a point inside. Proof: P-50.
    std::optional<Exact_point> inside;
  };

  /// Pre: the scene outlives the graph.
  explicit Face_graph(Scene&&) = delete;
  explicit Face_graph(const Scene& scene);

  const Scene& scene() const { return *scene_; }
  /// Face k of the mesh is piece k of the scene; its vertices are those of point(), at the approximate coordinates of
  /// Grid_points.
  const Face_mesh& mesh() const& { return *mesh_; }
  /// The point of the scene that a vertex of the mesh is at.
  std::uint32_t point(std::size_t vertex) const { return point_of_vertex_[vertex]; }

  std::size_t size() const { return piece_.size(); }
  std::uint32_t node(std::uint32_t piece) const { return node_[piece]; }
  std::uint32_t piece(std::uint32_t node) const { return piece_[node]; }  ///< the first of them
  Plane plane(std::uint32_t node) const { return scene_->pieces()[piece_[node]].support; }

  const std::vector<Edge>& edges() const& { return edges_; }
  std::span<const std::uint32_t> edges_of(std::uint32_t node) const& {
    return {incident_.data() + begin_[node], begin_[node + 1] - begin_[node]};
  }
  std::uint32_t across(std::uint32_t edge, std::uint32_t node) const {
    return edges_[edge].first ^ edges_[edge].second ^ node;
  }

  const std::vector<Component>& components() const& { return components_; }
  std::uint32_t component(std::uint32_t node) const { return component_[node]; }
  bool is_convex(std::uint32_t node) const { return components_[component_[node]].inside.has_value(); }
  /// Pieces that OpenMesh could not join to their neighbours.
  std::size_t refused() const { return refused_; }

  // Of a temporary nothing that would refer to what is gone.
  void mesh() const&& = delete;
  void edges() const&& = delete;
  void edges_of(std::uint32_t node) const&& = delete;
  void components() const&& = delete;

 private:
  struct Builder;

  const Scene* scene_;
  std::shared_ptr<const Face_mesh> mesh_;
  std::vector<std::uint32_t> point_of_vertex_, node_, piece_, component_;
  std::vector<Edge> edges_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> incident_;
  std::vector<Component> components_;
  std::size_t refused_ = 0;
};

}  // namespace sightline
