#include <sightline/algorithms/solids/certificate.h>

namespace sightline {

Solid_certificate solid_certificate(const Operands& operands, const Set_options& options, const Set_result& result) {
  Solid_certificate certificate;
  certificate.operation = name(options.operation);
  certificate.inside = name(options.inside);
  certificate.operands = static_cast<std::uint32_t>(operands.size());
  // 1. Fragments, with numbers of faces that are the operands' own.
  for (const Result_fragment& fragment : result.fragments) {
    Solid_certificate::Fragment& claim = certificate.fragments.emplace_back();
    for (const Result_fragment::Part& part : fragment.parts) {
      const auto [operand, face] = operands.source_of(part.face);
      claim.parts.push_back({operand, face, part.piece, part.turned});
    }
    claim.vertices = fragment.corners;
    for (const Winding& w : fragment.front) claim.front.emplace_back(w.operand, w.number);
    claim.fate = fragment.fate == Result_fragment::Fate::kept     ? Solid_certificate::Fate::kept
                 : fragment.fate == Result_fragment::Fate::turned ? Solid_certificate::Fate::turned
                                                                  : Solid_certificate::Fate::dropped;
  }
  // 2. Pieces of faces that were cut, and what has no area.
  std::vector<bool> cut(operands.face_count());
  for (const Piece& piece : operands.pieces())
    if (piece.number > 0) cut[piece.face] = true;
  for (const Face_id face : operands.non_planar()) cut[face] = true;
  for (std::size_t i = 0; i < operands.pieces().size(); ++i) {
    const Piece& piece = operands.pieces()[i];
    if (!cut[piece.face]) continue;
    const auto [operand, face] = operands.source_of(piece.face);
    Solid_certificate::Piece& claim = certificate.pieces.emplace_back();
    claim.operand = operand;
    claim.face = face;
    claim.piece = piece.number;
    for (const Piece_corner& corner : operands.corners(i)) claim.vertices.push_back(operands.position(corner.point));
  }
  for (const Set_aside& entry : operands.set_aside()) {
    const auto [operand, face] = operands.source_of(entry.face);
    certificate.set_aside.push_back({operand, face, entry.why});
  }
  return certificate;
}

}  // namespace sightline
