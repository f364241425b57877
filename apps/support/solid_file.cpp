#include "solid_file.h"

#include <sightline/io/format.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/off.h>
#include <sightline/io/write.h>

#include <fmt/format.h>

namespace sightline::app {

Check surface_ending() {
  return none_of([](const std::string& name) {
    switch (format_of_ending(name).value_or(Format::map)) {
      case Format::obj:
      case Format::off:
      case Format::qoff:
      case Format::ply:
      case Format::ply_binary:
      case Format::stl: return std::string();
      case Format::map:
      case Format::bsp:
      case Format::glb:
      case Format::gltf: break;
    }
    return name + " does not end as a format that holds surfaces does; name a file .qoff .obj .off .ply .stl";
  });
}

std::optional<Rounded_surface> write_solid(const Polygon_soup& soup, const std::string& out, bool to_float,
                                           std::size_t snap_rounds, const Rounding_progress& progress) {
  const std::optional<Format> format = format_of_ending(out);
  if (format == Format::qoff) {
    write_scene(soup, out);
    return std::nullopt;
  }
  const bool triangles = format == Format::stl;
  if (!to_float && !triangles) try {
      write_scene(soup, out);
      return std::nullopt;
    } catch (const Not_representable&) {
    }
  const Rounding to = to_float ? Rounding::to_float : Rounding::to_double;
  try {
    Rounded_surface near =
        snap_rounds > 0 ? snapped(soup, to, triangles, progress, snap_rounds) : rounded(soup, to, triangles, progress);
    write_scene(near.soup, out);
    return near;
  } catch (const std::domain_error&) {
    throw std::runtime_error(fmt::format("{}: a coordinate is beyond what {} hold; write .qoff{}", out,
                                         to_float ? "floats" : "doubles",
                                         to_float ? ", or leave out --round float" : ""));
  }
}

std::string warning_of_denominator(const Polygon_soup& soup, const std::string& file, const std::string& reads_it) {
  Common_denominator common;  // as its reader asks
  for (std::size_t k = 0; k < soup.coordinates.size(); ++k)
    if (!common.include(soup.coordinates[k].get_den()))
      return fmt::format("its points have a common denominator of more than {} bits: {} with --coordinates double{}",
                         largest_common_denominator_bits,
                         reads_it.empty() ? "commands read " + file : reads_it + " reads " + file + ", other commands",
                         reads_it.empty() ? " only" : "");
  return "";
}

Json rounding_json(const Rounded_surface& near, const Polygon_soup& soup) {
  Json crossing = Json::array(), vanished = Json::array(), added = Json::array();
  for (const auto& [one, other] : near.crossing) crossing.push_back({one, other});
  for (const Point_id p : near.vanished) vanished.push_back(point_json(soup.point(p)));
  for (const Point_id p : near.added) added.push_back(point_json(near.soup.point(p)));
  return {{"moved", near.moved},         {"farthest", near.farthest},   {"not_planar", near.not_planar},
          {"turned", near.turned},       {"collapsed", near.collapsed}, {"crossing", std::move(crossing)},
          {"misplaced", near.misplaced}, {"rounds", near.rounds},       {"vanished", std::move(vanished)},
          {"added", std::move(added)},   {"coarser", near.coarser},     {"sound", near.is_sound()}};
}

std::string rounding_text(const Rounded_surface& near) {
  std::string text = fmt::format("{} points, by {:.2g} at most; {} faces no longer planar, now triangles", near.moved,
                                 near.farthest, near.not_planar.size());
  if (!near.turned.empty()) text += fmt::format("; {} turned over", near.turned.size());
  if (!near.is_sound())
    text += fmt::format("; {} without area, {} pairs cross that did not, {} inside out: give --snap, or write .qoff",
                        near.collapsed.size(), near.crossing.size(), near.misplaced.size());
  else if (near.rounds > 0)
    text +=
        fmt::format("; snapped in {} rounds{}, by which {} points vanished and {} came: nothing is broken", near.rounds,
                    near.coarser == 0 ? "" : fmt::format(", to a grid of 2^{} of the numbers' steps", near.coarser),
                    near.vanished.size(), near.added.size());
  return text;
}

}  // namespace sightline::app
