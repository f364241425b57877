#include "sightline_files.h"

#include "../support/files.h"

#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <set>
#include <utility>

namespace sightline::app {

Sightline_files::Sightline_files(std::filesystem::path folder, const Level_cells& level, const Model& model)
    : folder_(std::move(folder)), level_(level), model_(model), pieces_(harness::flat_faces_of(level.scene())) {
  make_folder(folder_);
}

std::optional<std::string> Sightline_files::write(Cell_id cell, std::size_t leaf, const Cell_sightline& line) const {
  const std::string name = fmt::format("leaf-{}-cell-{}-face-{}.json", leaf, cell, line.face);
  if (!write(name, cell, line.from, line.to, line.face, false)) return std::nullopt;
  return name;
}

std::optional<std::string> Sightline_files::write(const std::array<Cell_id, 2>& cells,
                                                  const std::array<std::size_t, 2>& leaves,
                                                  const std::array<Exact_point, 2>& ends) const {
  const std::string name = fmt::format("leaves-{}-{}.json", leaves[0], leaves[1]);
  std::array<std::vector<Exact_point>, 2> corners;
  for (const std::size_t end : {0u, 1u})
    for (const std::uint32_t wall : level_.cells()[cells.at(end)].walls)
      for (const std::uint32_t corner : level_.walls()[wall].corners)
        corners.at(end).push_back(level_.points()[corner]);
  constexpr std::size_t most_tries = 64;
  for (std::size_t tried = 0; tried < most_tries; ++tried) {
    // The line itself, then lines between points beside its ends, on the way to corners of their cells.
    std::array<Exact_point, 2> beside = ends;
    Rational part = tried == 0 ? 0 : 1;
    for (std::size_t k = 0; k < 2 + tried / 4; ++k) part /= 2;
    for (const std::size_t end : {0u, 1u}) {
      const Exact_point& corner = corners.at(end)[(tried * (1 + 2 * end)) % corners.at(end).size()];
      beside.at(end) = generate::along(ends.at(end), part, minus(corner, ends.at(end)));
    }
    for (const std::size_t first : {0u, 1u}) {
      const Exact_ray ray{beside.at(first), minus(beside.at(1 - first), beside.at(first))};
      const std::vector<Face_hit> hits = trace(model_, std::vector{ray}, Ray_start::closed, {1, {}, 0}).front();
      // Two faces that are met at once: the border of both, as a rule.
      if (hits.size() != 1 || hits[0].side == Met_side::along || hits[0].t <= 1) continue;
      if (write(name, cells.at(first), ray.origin, generate::along(ray.origin, hits[0].t, ray.direction), hits[0].face,
                hits[0].side == Met_side::back))
        return name;
    }
  }
  return std::nullopt;
}

std::vector<Exact_point> Sightline_files::source_about(const Exact_point& point, const Exact_point& direction,
                                                       Cell_id cell) const {
  std::size_t k = 0;  // the triangle has one coordinate
  for (std::size_t i = 1; i < 3; ++i)
    if (abs(direction[i]) > abs(direction[k])) k = i;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const auto is_within = [&](const Exact_point& p) { return level_.about(p) == std::vector<Cell_id>{cell}; };
  const bool can_be_within = is_within(point);
  for (Rational size = 1;; size /= 2) {
    std::vector<Exact_point> corners(3, point);
    corners[0][i] -= size;
    corners[0][j] -= size;
    corners[1][i] += 2 * size;
    corners[2][j] += 2 * size;
    if (direction[k] < 0) std::swap(corners[1], corners[2]);
    if (!can_be_within || std::all_of(corners.begin(), corners.end(), is_within)) return corners;
  }
}

bool Sightline_files::write(const std::string& name, Cell_id cell, const Exact_point& from, const Exact_point& to,
                            Face_id face, bool is_back) const {
  const std::vector<Piece>& pieces = level_.scene().pieces();
  std::set<Face_id> others;
  std::optional<std::size_t> fragment;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].face != face) others.insert(pieces[i].face);
    else if (pieces_[i].height(to) == 0 && pieces_[i].side_within(to) > 0) fragment = i;
  }
  if (!fragment) return false;
  Weak_certificate certificate;
  add_all(certificate, level_.scene());
  certificate.two_sided = is_back;
  certificate.sources.push_back(source_about(from, minus(to, from), cell));
  certificate.visible.push_back({*fragment, 0, from, to});
  certificate.undecided.assign(others.begin(), others.end());
  write_file((folder_ / name).string(), [&](std::ostream& out) { write_certificate(out, certificate); });
  return true;
}

}  // namespace sightline::app
