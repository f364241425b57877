#pragma once
// Partitions of faces by the light of a source, held to which faces the source sees.

#include <sightline/algorithms/weak_visibility/partition/light_partition.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline::harness {

/// What is wrong with edges, two points on each, as those that bound what a point of a piece's inside sees of a source;
/// empty: nothing. Each has to lie on an edge, or where a piece's plane meets that of the source or of the piece, and
/// their images have to be those that brute force finds. Pre: the source is convex. Exact: yes
std::string flaw_of_edges(const Scene& scene, std::uint32_t piece, const generate::Points& source,
                          const Exact_point& eye, const std::vector<std::array<Exact_point, 2>>& edges);

/// What a point of a piece's inside sees of a source, by all shadows: it is lit where what it sees is bounded by the
/// source's own edges, dark where nothing bounds it. Pre: the source is convex. Degenerate: what only touches is no
/// light. Exact: yes
Light light_at(const Scene& scene, std::uint32_t piece, const generate::Points& source, const Exact_point& eye);

/// That a face is hidden iff all of it is in umbra, of a share of small scenes; one of its faces each.
Check partition_check();
/// What is seen from cells, and the edges that bound it, of a share of the smallest.
Check outline_check();

}  // namespace sightline::harness
