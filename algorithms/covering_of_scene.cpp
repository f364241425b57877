#include <sightline/algorithms/covering_of_scene.h>

#include <sightline/kernel/scene/polygon_soup.h>

#include <vector>

namespace sightline {

Order_fragment whole_piece(const Scene& scene, const Piece& piece) {
  Order_fragment fragment;
  fragment.face = piece.face;
  fragment.piece = piece.number;
  fragment.vertices = scene.corner_points(piece);
  return fragment;
}

void add_pieces(Covering& covering, const Scene& scene) {
  std::vector<bool> cut(scene.counters().faces_read);
  for (const Piece& piece : scene.pieces())
    if (piece.number > 0) cut[piece.face] = true;
  for (const Face_id face : scene.non_planar()) cut[face] = true;
  for (const Piece& piece : scene.pieces()) {
    if (!cut[piece.face]) continue;
    Covering::Piece& part = covering.pieces.emplace_back();
    part.face = piece.face;
    part.piece = piece.number;
    part.vertices = scene.corner_points(piece);
  }
  for (const Set_aside& entry : scene.set_aside()) covering.set_aside.push_back({entry.face, entry.why});
}

void add_all(Covering& covering, const Scene& scene) {
  for (const Piece& piece : scene.pieces()) covering.fragments.push_back(whole_piece(scene, piece));
  add_pieces(covering, scene);
}

}  // namespace sightline
