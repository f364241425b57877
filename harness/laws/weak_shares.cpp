#include <sightline/harness/laws/weak_shares.h>

#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::harness {

namespace {

using Shares = std::array<Bounded, lights>;

std::optional<std::uint32_t> only_piece_of(const Scene& scene, Face_id face) {
  std::optional<std::uint32_t> only;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    if (scene.pieces()[piece].face != face) continue;
    if (only) return std::nullopt;
    only = piece;
  }
  return only;
}

/// Nothing where a part is undecided.
std::optional<Shares> shares_of(const Scene& scene, std::uint32_t piece, const std::vector<generate::Points>& sources) {
  constexpr std::size_t most_rectangles = 1500;
  std::size_t asked = 0;
  Partition_options options;
  options.out_of_time = [&] { return ++asked > most_rectangles; };
  Partition_counters counters;
  const Light_partition partition = Light_partitioner(scene).partition(piece, sources, options, counters);
  for (const auto& cell : partition.cells)
    if (cell.light == Light::undecided) return std::nullopt;
  return partition.shares();
}

/// Empty where the exact values may be the same, and are known closely.
std::string difference(const Shares& a, const Shares& b) {
  constexpr double width = 1e-3;
  for (std::size_t k = 0; k < lights; ++k)
    if (!(b[k].high - b[k].low < width))
      return std::string(name_of(static_cast<Light>(k))) + " is no number that is known well";
    else if (a[k].low > b[k].high || b[k].low > a[k].high)
      return std::string(name_of(static_cast<Light>(k))) + " is " + std::to_string(a[k].low) + " of it, and " +
             std::to_string(b[k].low);
  return {};
}

/// By a map that keeps planes, segments and shares of areas, or with what changes nothing.
std::optional<Image> any_image(const Posed_scene& posed, Random& random) {
  constexpr std::array images{begun_elsewhere, translated, scaled, rotated, stretched, mirrored, with_a_bystander};
  return images[random.below(images.size())](posed, random);
}

/// A convex polygon cut from a corner to a point of an edge beyond.
std::vector<generate::Points> two_parts(const generate::Points& polygon, Random& random) {
  const std::size_t count = polygon.size(), first = random.below(count), edge = 1 + random.below(count - 2);
  const auto corner = [&](std::size_t k) { return polygon[(first + k) % count]; };
  std::optional<Exact_point> middle;  // or the corner where the edge begins
  if (edge == 1 || random.chance(1, 2))
    middle = generate::along(corner(edge), Rational(generate::integer(random, 1, 7) / 8),
                             minus(corner(edge + 1), corner(edge)));
  generate::Points left, right;
  for (std::size_t k = 0; k <= edge; ++k) left.push_back(corner(k));
  if (middle) {
    left.push_back(*middle);
    right.push_back(*middle);
  } else {
    right.push_back(corner(edge));
  }
  for (std::size_t k = edge + 1; k <= count; ++k) right.push_back(corner(k));
  return {left, right};
}

}  // namespace

Check shares_check() {
  return {"shares", "shares of light are those of images of the scene, and of the source in two parts",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_pieces = 8;
            constexpr std::size_t few_pieces = 3;
            constexpr int most_bits = 64, most_bits_of_images = 150, most_bits_of_few = 3000;
            const Scene scene(posed.soup);
            if (scene.pieces().empty() || scene.pieces().size() > most_pieces || scene.bits() > most_bits)
              return Outcome::not_applicable();
            const Face_id face = scene.pieces()[random.below(scene.pieces().size())].face;
            const auto piece = only_piece_of(scene, face);
            if (!piece || answer.labels[face] == Answer::none) return Outcome::not_applicable();
            const std::optional<Shares> shares = shares_of(scene, *piece, {posed.source});
            if (!shares) return Outcome::undecided();

            // 1. From the source in two parts all is seen where both are, and nothing where neither is.
            const std::optional<Shares> by_parts = shares_of(scene, *piece, two_parts(posed.source, random));
            if (by_parts)
              if (const std::string flaw = difference(*shares, *by_parts); !flaw.empty())
                return Outcome::failed(face_name(face) + ": " + flaw + " from the source in two parts");

            // 2. An image.
            const std::optional<Image> image = any_image(posed, random);
            if (!image || !answer.planar) return Outcome{};
            const Scene moved(image->scene.soup);
            const auto other = only_piece_of(moved, face);
            const bool few = moved.pieces().size() <= few_pieces;
            if (!other || moved.bits() > (few ? most_bits_of_few : most_bits_of_images)) return Outcome{};
            const std::optional<Shares> of_image = shares_of(moved, *other, {image->scene.source});
            if (!of_image) return Outcome{};
            const std::string flaw = difference(*shares, *of_image);
            return flaw.empty() ? Outcome{} : Outcome::failed(face_name(face) + ": " + flaw + " in an image");
          }};
}

}  // namespace sightline::harness
