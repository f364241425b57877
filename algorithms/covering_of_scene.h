#pragma once
// How engines tell a check what the scene is. The check trusts none of it, and does not include this file.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// A piece as one fragment.
Order_fragment whole_piece(const Scene& scene, const Piece& piece);

/// What a certificate needs beside its fragments: the pieces of faces that were cut, and what is set aside.
void add_pieces(Covering& covering, const Scene& scene);

/// The same, with the scene's convex pieces as fragments, in their order.
void add_all(Covering& covering, const Scene& scene);

}  // namespace sightline
