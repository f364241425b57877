#pragma once
// The OpenMesh that carries a face graph.

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

namespace sightline {

struct Face_mesh_traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};

struct Face_mesh : OpenMesh::PolyMesh_ArrayKernelT<Face_mesh_traits> {};

}  // namespace sightline
