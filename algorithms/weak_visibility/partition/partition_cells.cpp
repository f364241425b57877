// Sectors that touch and are alike as cells, and the borders between cells.

#include <sightline/algorithms/weak_visibility/partition/partition_builder.h>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace sightline::partition_detail {

using Interval = CGAL::Interval_nt<>;

// ---- What touches what

void Partition_builder::join_leaf(std::size_t number) {
  const Leaf& leaf = leaves_[number];
  const std::vector<Curve_arrangement::Slab>& slabs = leaf.arrangement.slabs();
  // The stretch of a limit that a sector of a slab beside it touches for sure.
  const auto stretch = [&](std::size_t slab, std::size_t k, std::size_t limit) {
    const std::vector<Curve_arrangement::Arc>& arcs = slabs[slab].arcs;
    return std::array<double, 2>{k == 0 ? leaf.box.y0 : leaf.arrangement.value(arcs[k - 1], limit).high,
                                 k == arcs.size() ? leaf.box.y1 : leaf.arrangement.value(arcs[k], limit).low};
  };
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    const std::size_t count = slabs[s].y.size();
    for (std::size_t k = 0; k + 1 < count; ++k) meet(leaf.first[s] + k, leaf.first[s] + k + 1);
    const double from = leaf.arrangement.limit(s).high, to = leaf.arrangement.limit(s + 1).low;
    level_sides_[leaf.box.y0].after.push_back({from, to, leaf.first[s]});
    level_sides_[leaf.box.y1].before.push_back({from, to, leaf.first[s] + count - 1});
    // At its right.
    Side side;
    for (std::size_t k = 0; k < count; ++k) {
      const std::array<double, 2> own = stretch(s, k, s + 1);
      const Touch touch{own[0], own[1], leaf.first[s] + k};
      (s + 1 < slabs.size() ? side : upright_sides_[leaf.box.x1]).before.push_back(touch);
    }
    if (s == 0)
      for (std::size_t k = 0; k < count; ++k) {
        const std::array<double, 2> own = stretch(0, k, 0);
        upright_sides_[leaf.box.x0].after.push_back({own[0], own[1], leaf.first[0] + k});
      }
    if (s + 1 == slabs.size()) continue;
    for (std::size_t k = 0; k < slabs[s + 1].y.size(); ++k) {
      const std::array<double, 2> own = stretch(s + 1, k, s + 1);
      side.after.push_back({own[0], own[1], leaf.first[s + 1] + k});
    }
    const Bounded x = leaf.arrangement.limit(s + 1);
    for (std::size_t i = 0, j = 0; i < side.before.size() && j < side.after.size();) {
      const Touch &a = side.before[i], &b = side.after[j];
      const double low = std::max(a.from, b.from), high = std::min(a.to, b.to);
      if (low < high) {
        meet(a.sector, b.sector);
        uprights_.push_back({x.low, x.high, a.sector, b.sector, low, high});
      }
      ++(a.to < b.to ? i : j);
    }
  }
}

void Partition_builder::join_sides(std::map<double, Side>& sides, bool upright) {
  for (auto& [at, side] : sides) {
    for (std::vector<Touch>* touches : {&side.before, &side.after})
      std::sort(touches->begin(), touches->end(), [](const Touch& a, const Touch& b) { return a.from < b.from; });
    for (std::size_t i = 0, j = 0; i < side.before.size() && j < side.after.size();) {
      const Touch &a = side.before[i], &b = side.after[j];
      const double low = std::max(a.from, b.from), high = std::min(a.to, b.to);
      if (low < high) {
        meet(a.sector, b.sector);
        if (upright) uprights_.push_back({at, at, a.sector, b.sector, low, high});
      }
      ++(a.to < b.to ? i : j);
    }
  }
}

std::size_t Partition_builder::root(std::size_t sector) {
  while (parents_[sector] != sector) sector = parents_[sector] = parents_[parents_[sector]];
  return sector;
}

// ---- Cells and borders

void Partition_builder::collect_cells(Light_partition& result) {
  join_alike();
  measure_sectors();
  number_cells(result);
  measure_cells(result);
  if (options_->all_borders) name_edges(result);
}

/// Sectors that touch, and of which the same is seen.
void Partition_builder::join_alike() {
  parents_.resize(sectors_.size());
  std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  for (const auto& [a, b] : contacts_) {
    const Sector &p = sectors_[a], &q = sectors_[b];
    if (p.inside && q.inside && p.light == q.light && p.outline == q.outline) parents_[root(a)] = root(b);
  }
}

/// Roughly, so that a cell's point is where it is wide.
void Partition_builder::measure_sectors() {
  for (const Leaf& leaf : leaves_)
    for (std::size_t s = 0; s < leaf.first.size(); ++s) {
      const Curve_arrangement::Slab& slab = leaf.arrangement.slabs()[s];
      const double x = slab.x.get_d(), width = leaf.arrangement.limit(s + 1).low - leaf.arrangement.limit(s).high;
      double below = leaf.box.y0;
      for (std::size_t k = 0; k < slab.y.size(); ++k) {
        const double above = k < slab.arcs.size() ? leaf.arrangement.near(slab.arcs[k], x) : leaf.box.y1;
        sectors_[leaf.first[s] + k].size = std::min(width, above - below);
        below = above;
      }
    }
}

void Partition_builder::number_cells(Light_partition& result) {
  cell_of_.assign(sectors_.size(), Light_partition::none);
  std::vector<double> widest;
  for (std::size_t k = 0; k < sectors_.size(); ++k) {
    const Sector& sector = sectors_[k];
    if (!sector.inside) continue;
    std::size_t& cell = cell_of_[root(k)];
    if (cell == Light_partition::none) {
      cell = result.cells.size();
      result.cells.push_back({sector.light, {sector.x, sector.y}, {0, 0}, {}});
      widest.push_back(sector.size);
    } else if (sector.size > widest[cell]) {
      widest[cell] = sector.size;
      result.cells[cell].at = {sector.x, sector.y};
    }
  }
  for (std::size_t k = 0; k < sectors_.size(); ++k)
    if (sectors_[k].inside) cell_of_[k] = cell_of_[root(k)];
}

/// Areas, as shares of the piece's: what two parts of one cell have between them adds nothing.
void Partition_builder::measure_cells(Light_partition& result) {
  if (result.cells.size() == 1) {
    result.cells[0].area = {1, 1};  // all of the piece, however thin
    return;
  }
  std::vector<Interval> areas(result.cells.size(), Interval(0));
  for (const Leaf& leaf : leaves_)
    for (std::size_t s = 0; s < leaf.first.size(); ++s) {
      const Curve_arrangement::Slab& slab = leaf.arrangement.slabs()[s];
      const auto bounds = [](const Bounded& b) { return Interval(b.low, b.high); };
      const Interval width = bounds(leaf.arrangement.limit(s + 1)) - bounds(leaf.arrangement.limit(s));
      const auto cell = [&](std::size_t k) { return cell_of_[leaf.first[s] + k]; };
      const auto add = [&](std::size_t of, const Interval& area) {
        if (of != Light_partition::none) areas[of] += area;
      };
      add(cell(0), -width * Interval(leaf.box.y0));
      add(cell(slab.arcs.size()), width * Interval(leaf.box.y1));
      for (std::size_t k = 0; k < slab.arcs.size(); ++k) {
        if (cell(k) == cell(k + 1)) continue;
        const Interval area = bounds(leaf.arrangement.area_below(slab.arcs[k], s, is_over() ? 4 : 14));
        add(cell(k), area);
        add(cell(k + 1), -area);
      }
    }
  const Bounded near_area = bounds_of(piece_area_);
  const Interval whole(near_area.low, near_area.high);
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const Interval share = areas[k] / whole;
    result.cells[k].area = {std::max(share.inf(), 0.0), std::min(share.sup(), 1.0)};
  }
}

/// The edges that bound what is seen from a cell.
void Partition_builder::name_edges(Light_partition& result) const {
  std::vector<const std::vector<std::vector<std::uint32_t>>*> outlines(outlines_.size());
  for (const auto& [outline, number] : outlines_) outlines[number] = &outline;
  std::vector<char> known(result.cells.size());
  for (std::size_t k = 0; k < sectors_.size(); ++k) {
    if (!sectors_[k].inside || sectors_[k].light == Light::undecided || known[cell_of_[k]] != 0) continue;
    known[cell_of_[k]] = 1;
    const auto& outline = *outlines[sectors_[k].outline];
    auto& all = result.cells[cell_of_[k]].edges;
    all.resize(sources_.size() + never_seen_);
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      auto& edges = all[sources_[s].number];
      for (const std::uint32_t line : outline[s]) {
        const std::array<Filtered, 2>& hull = sources_[s].lines.lines()[line].hull;
        edges.push_back({occluders_->scene().position(hull[0].exact), occluders_->scene().position(hull[1].exact)});
      }
    }
  }
}

void Partition_builder::collect_borders(Light_partition& result) {
  for (const Border_curve& curve : curves_) result.curves.push_back(curve.curve);
  collect_arcs(result);
  collect_uprights(result);
  collect_strips(result);
}

void Partition_builder::collect_arcs(Light_partition& result) const {
  for (const Leaf& leaf : leaves_)
    for (std::size_t s = 0; s < leaf.first.size(); ++s) {
      const Curve_arrangement::Slab& slab = leaf.arrangement.slabs()[s];
      for (std::size_t k = 0; k < slab.arcs.size(); ++k) {
        const Curve_arrangement::Arc& arc = slab.arcs[k];
        const std::size_t below = cell_of_[leaf.first[s] + k], above = cell_of_[leaf.first[s] + k + 1];
        if (below == above) continue;
        result.borders.push_back({leaf.curves[arc.curve],
                                  arc.upper,
                                  below,
                                  above,
                                  {leaf.arrangement.limit(s), leaf.arrangement.limit(s + 1)},
                                  {leaf.arrangement.value(arc, s), leaf.arrangement.value(arc, s + 1)}});
      }
    }
  const auto key = [](const Light_partition::Border& b) { return std::tuple(b.curve, b.upper, b.below, b.above); };
  std::sort(result.borders.begin(), result.borders.end(), [&](const auto& a, const auto& b) {
    return std::pair(key(a), a.x[0].low) < std::pair(key(b), b.x[0].low);
  });
  std::vector<Light_partition::Border> joined;
  for (const Light_partition::Border& border : result.borders) {
    if (!joined.empty() && key(joined.back()) == key(border) && joined.back().x[1].high >= border.x[0].low) {
      if (joined.back().x[1].high >= border.x[1].high) continue;  // narrower than doubles tell
      joined.back().x[1] = border.x[1];
      joined.back().y[1] = border.y[1];
    } else joined.push_back(border);
  }
  result.borders = std::move(joined);
}

void Partition_builder::collect_uprights(Light_partition& result) const {
  std::vector<Light_partition::Upright> uprights;
  for (const Upright_contact& contact : uprights_) {
    const std::size_t left = cell_of_[contact.left], right = cell_of_[contact.right];
    if (left != right)
      uprights.push_back(
          {{contact.x0, contact.x1}, left, right, {{{contact.y0, contact.y0}, {contact.y1, contact.y1}}}});
  }
  const auto upright_key = [](const auto& u) { return std::tuple(u.left, u.right, u.x.low); };
  std::sort(uprights.begin(), uprights.end(), [&](const auto& a, const auto& b) {
    return std::pair(upright_key(a), a.y[0].low) < std::pair(upright_key(b), b.y[0].low);
  });
  for (const Light_partition::Upright& upright : uprights) {
    constexpr double near = 0x1p-45;
    if (!result.uprights.empty() && result.uprights.back().left == upright.left &&
        result.uprights.back().right == upright.right &&
        std::fabs(result.uprights.back().x.low - upright.x.low) < near &&
        upright.y[0].low - result.uprights.back().y[1].high < near)
      result.uprights.back().y[1] = upright.y[1];
    else result.uprights.push_back(upright);
  }
  for (const Light_partition::Upright& upright : result.uprights)
    result.border_lines.push_back({{upright.x.low, upright.y[0].low}, {upright.x.low, upright.y[1].low}});
}

/// What a picture fills and draws.
void Partition_builder::collect_strips(Light_partition& result) const {
  for (const Leaf& leaf : leaves_)
    for (std::size_t s = 0; s < leaf.first.size(); ++s) {
      const Curve_arrangement::Slab& slab = leaf.arrangement.slabs()[s];
      const double from = leaf.arrangement.limit(s).low, to = leaf.arrangement.limit(s + 1).high;
      const auto points = [&](std::size_t k) {  // k arcs are below it
        std::vector<std::array<double, 2>> found;
        const bool is_side = k == 0 || k > slab.arcs.size();
        const int steps = is_side || curves_[leaf.curves[slab.arcs[k - 1].curve]].curve.is_line() ? 1 : 8;
        for (int n = 0; n <= steps; ++n) {
          const double x = n == steps ? to : from + (to - from) * n / steps;
          found.push_back({x, k == 0    ? leaf.box.y0
                              : is_side ? leaf.box.y1
                                        : leaf.arrangement.near(slab.arcs[k - 1], x)});
        }
        return found;
      };
      for (std::size_t k = 0; k < slab.y.size(); ++k) {
        const std::size_t cell = cell_of_[leaf.first[s] + k];
        if (cell != Light_partition::none) result.strips.push_back({cell, points(k), points(k + 1)});
        if (k < slab.arcs.size() && cell != cell_of_[leaf.first[s] + k + 1])
          result.border_lines.push_back(points(k + 1));
      }
    }
}

}  // namespace sightline::partition_detail
