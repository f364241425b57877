#include <sightline/algorithms/cutset/view_cells.h>

#include <stdexcept>
#include <string>

namespace sightline {

std::uint32_t on_view_from(std::span<const std::array<Rational, 4>> planes, const Exact_point& eye) {
  std::uint32_t on_view = 0;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (const Rational value = planes[k][0] * eye[0] + planes[k][1] * eye[1] + planes[k][2] * eye[2] + planes[k][3];
        sgn(value) > 0)
      on_view |= 1u << k;
  return on_view;
}

std::vector<View_cell> view_cells(std::span<const std::array<Rational, 4>> planes, const std::function<void()>& ask) {
  using namespace view_cells_detail;
  if (planes.size() > most_view_faces)
    throw std::invalid_argument("views of " + std::to_string(planes.size()) + " faces; take a body of " +
                                std::to_string(most_view_faces) + " at most");
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (is_constant<3>(planes[k])) throw std::invalid_argument("plane " + std::to_string(k) + " has no normal");
  std::vector<View_cell> cells;
  for (const auto& [on, sample] : all_cells<3>(planes, 0, ask)) {
    const auto off_plane = [&sample = sample](const Form<3>& form) { return sgn(value<3>(form, sample)) != 0; };
    cells.push_back({on, std::all_of(planes.begin(), planes.end(), off_plane), sample});
  }
  return cells;
}

}  // namespace sightline
