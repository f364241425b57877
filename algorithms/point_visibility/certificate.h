#pragma once
// A visible surface as a certificate that a sceptic can check.

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <vector>

namespace sightline {

/// What verify_visible() checks: all pieces, which parts of them are seen, and the cones in which nothing is. Pre:
/// `field` are the rays that the view was made with, none for the whole sphere. Exact: yes
Visible_certificate visible_certificate(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                        const Exact_point& eye, const std::vector<Exact_point>& field = {});

/// Writes the same without holding it: 8 bytes for each ray of a part, and what the scene's pieces take. `progress` is
/// called now and then, and may throw to give up.
void write_visible_certificate(std::ostream& out, const Exact_view& view, const Visible_surface<Exact_view>& surface,
                               const Exact_point& eye, const std::vector<Exact_point>& field = {},
                               const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace sightline
