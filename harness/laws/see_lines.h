#pragma once
// Lines as an eye sees them, held to brute force in rationals and to fields of view: checks of the subject `see`.

#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline::harness {

/// That all edges are listed, each with the pieces that it bounds and parts from its one end to the other; that a point
/// of each part is visible, or hidden by the piece that is named; that faces cross where they are said to; and that a
/// point of each two pieces' crossing, if it is visible, is on a line that is listed. Of a share of the scenes also of
/// pages through one line, where the eye is in the plane of one of them, or of concave outlines on a lattice.
Check lines_check();

/// That a field of view, which goes through points of the scene if it can, shows the same parts of lines as no field.
Check field_check();

/// 4 where a visible line of crossing is on the face.
void label_crossings(const Posed_scene& posed, Answer& answer);

/// An answer as methods give it that know no lines.
Answer without_lines(const Answer& answer);

}  // namespace sightline::harness
