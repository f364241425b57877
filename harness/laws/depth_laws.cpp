#include <sightline/harness/laws/depth_laws.h>

#include <sightline/algorithms/baseline/blended_depth.h>
#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sightline::harness {

namespace depth_laws {

/// Pieces as seen from an eye, in doubles.
struct Seen_pieces {
  std::vector<std::vector<Triple>> arms;

  Seen_pieces(const Scene& scene, const Exact_point& eye) {
    for (const Flat_face& face : flat_faces_of(scene)) {
      std::vector<Triple>& own = arms.emplace_back();
      for (const Exact_point& p : face.corners) {
        const Exact_point arm = minus(p, eye);
        own.push_back({nearest_double(arm[0]), nearest_double(arm[1]), nearest_double(arm[2])});
      }
    }
  }
};

/// The direction of a pixel's centre, one unit forward, and how that changes by a 64th of a pixel.
struct Pixel_ray {
  Triple direction, right, up;
};

struct Clip {
  double near, far;
  int bits;

  double depth(double forward) const { return far / (far - near) * (1 - near / forward); }
  double steps() const { return bits == 32 ? 0x1p24 : std::ldexp(1.0, bits) - 1; }
};

struct Depth_hit {
  std::uint32_t piece;
  double forward, depth;
  double slack;  ///< how far a depth in floats may be off
};

/// What a ray meets, nearest first; nothing where it comes near an edge or the near plane, or depths are near others.
std::optional<std::vector<Depth_hit>> hits_of(const Seen_pieces& pieces, const Pixel_ray& ray, const Clip& clip) {
  const auto length = [](const Triple& v) { return std::sqrt(dot(v, v)); };
  const double margin = (length(ray.right) + length(ray.up)) / length(ray.direction) + 1e-5;
  std::vector<Depth_hit> hits;
  for (std::uint32_t piece = 0; piece < pieces.arms.size(); ++piece) {
    const std::vector<Triple>& arms = pieces.arms[piece];
    const std::size_t size = arms.size();
    // 1. On which side of the planes through the eye and the edges.
    bool left = false, right = false;
    for (std::size_t k = 0; k < size; ++k) {
      const Triple across = cross(arms[k], arms[(k + 1) % size]);
      const double side = dot(across, ray.direction);
      if (std::fabs(side) <= margin * length(across) * length(ray.direction)) return std::nullopt;
      left = left || side > 0;
      right = right || side < 0;
    }
    if (left && right) continue;
    // 2. How far forward.
    Triple normal{};
    for (std::size_t k = 1; k + 1 < size; ++k) {
      const Triple part = cross(minus(arms[k], arms[0]), minus(arms[k + 1], arms[0]));
      for (std::size_t c = 0; c < 3; ++c) normal[c] += part[c];
    }
    const auto depth_along = [&](const Triple& by) {
      Triple direction = ray.direction;
      for (std::size_t c = 0; c < 3; ++c) direction[c] += by[c];
      return clip.depth(dot(normal, arms[0]) / dot(normal, direction));
    };
    const double forward = dot(normal, arms[0]) / dot(normal, ray.direction), depth = clip.depth(forward);
    if (forward < 0) continue;  // behind the eye
    if (std::fabs(forward / clip.near - 1) < 0.05 || forward > 0.95 * clip.far) return std::nullopt;
    if (forward < clip.near) continue;
    const double slack =
        std::fabs(depth_along(ray.right) - depth) + std::fabs(depth_along(ray.up) - depth) + 1e-5 + 1 / clip.steps();
    hits.push_back({piece, forward, depth, slack});
  }
  std::sort(hits.begin(), hits.end(), [](const Depth_hit& a, const Depth_hit& b) { return a.depth < b.depth; });
  for (std::size_t k = 0; k + 1 < hits.size(); ++k)
    if (hits[k].depth + 2 * hits[k].slack >= hits[k + 1].depth - 2 * hits[k + 1].slack) return std::nullopt;
  return hits;
}

struct Depth_case {
  Polygon_soup soup;
  Scene scene;
  Exact_point eye;
  Depth_buffer_options options;
};

Depth_case any_case(Random& random) {
  generate::Faces faces;
  generate::add_any(faces, 3 + random.below(6), random);
  const Polygon_soup soup = generate::soup_of(faces);
  Depth_case drawn{soup, Scene(soup), generate::lattice(random, 6), {}};
  constexpr std::array<int, 6> all_bits{32, 24, 24, 16, 10, 31};
  drawn.options.size = static_cast<std::uint32_t>(random.between(1, 24));
  drawn.options.bits = all_bits[random.below(all_bits.size())];
  if (random.chance(1, 3)) drawn.options.near = static_cast<float>(random.between(1, 16)) / 8;
  if (random.chance(1, 3)) drawn.options.far = static_cast<float>(random.between(4, 32));
  return drawn;
}

/// A near plane loses nothing that is farther than the far one by less than 4096, where nobody says where they are.
std::string flaw_of_planes(const Depth_buffer_options& options, const Clip& clip,
                           const std::vector<Depth_hit>& everything) {
  for (const Depth_hit& hit : everything) {
    if (options.far == 0 && hit.forward > clip.far) return "the far plane is before what is seen";
    if (options.near == 0 && hit.forward < clip.near && clip.near > clip.far / 4095)
      return "the near plane is behind what is seen";
  }
  return {};
}

std::string name_of(std::uint32_t piece) {
  return piece == Depth_buffer::nothing ? "nothing" : "piece " + std::to_string(piece);
}

/// The six images of a cube around the eye.
std::string flaw_of_buffer(const Depth_case& drawn) {
  const Depth_buffer buffer = depth_buffer(drawn.scene, drawn.eye, drawn.options);
  const Clip clip{buffer.near, buffer.far, drawn.options.bits}, all{1e-9, 1e9, 32};
  const std::uint32_t size = drawn.options.size;
  if (buffer.size != size || buffer.bits != drawn.options.bits) return "its size or its bits are others";
  if (drawn.scene.pieces().empty()) return {};
  if (buffer.not_finite != 0) return "small numbers count as not finite";
  if (drawn.options.near != 0 && buffer.near != drawn.options.near) return "the near plane is another one";
  if (drawn.options.far != 0 && buffer.far != drawn.options.far) return "the far plane is another one";
  const Seen_pieces pieces(drawn.scene, drawn.eye);
  bool any = false;
  for (std::size_t side = 0; side < cube_sides.size(); ++side)
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t x = 0; x < size; ++x) {
        const Cube_side& cube = cube_sides[side];
        const auto towards = [&](std::size_t axis, double by) {
          Triple v{};
          v[cube.axis[axis]] = by * cube.sense[axis];
          return v;
        };
        const double step = 1.0 / size / 32;
        Pixel_ray ray{towards(2, 1), towards(0, step), towards(1, step)};
        for (std::size_t k = 0; k < 3; ++k)
          ray.direction[k] += towards(0, (2.0 * x + 1) / size - 1)[k] + towards(1, (2.0 * y + 1) / size - 1)[k];
        if (const auto everything = hits_of(pieces, ray, all))
          if (const std::string flaw = flaw_of_planes(drawn.options, clip, *everything); !flaw.empty()) return flaw;
        const auto hits = hits_of(pieces, ray, clip);
        if (!hits) continue;
        any = any || !hits->empty();
        const std::uint32_t expected = hits->empty() ? Depth_buffer::nothing : hits->front().piece,
                            found = buffer.piece(side, x, y);
        const std::string place =
            "side " + std::to_string(side) + ", pixel " + std::to_string(x) + "," + std::to_string(y);
        if (found != expected)
          return place + " shows " + name_of(found) + ", a ray meets " + name_of(expected) + " first";
        if (hits->empty()) continue;
        const std::uint32_t stored = buffer.depths[buffer.pixel(side, x, y)];
        const double depth =
            clip.bits == 32 ? double{std::bit_cast<float>(stored)} : static_cast<double>(stored) / clip.steps();
        if (!(std::fabs(depth - hits->front().depth) <= 2 * hits->front().slack))
          return place + " has depth " + std::to_string(depth) + ", not " + std::to_string(hits->front().depth);
      }
  if (any && buffer.triangles == 0) return "what is seen is not counted";
  return {};
}

std::vector<Tint> any_tints(std::size_t count, Random& random) {
  constexpr std::array<double, 5> alphas{0, 0.25, 0.5, 1, 1};
  std::vector<Tint> tints(count);
  for (Tint& tint : tints) {
    tint.alpha = alphas[random.below(alphas.size())];
    for (double& c : tint.colour) c = static_cast<double>(random.between(0, 8)) / 8;
  }
  return tints;
}

bool is_near(const Layer& a, const Layer& b, double slack) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::fabs(a.colour[k] - b.colour[k]) <= slack)) return false;
  return std::fabs(a.alpha - b.alpha) <= 1e-9;
}

/// What was drawn later and lies behind is lost.
Layer in_order_of_faces(std::vector<Depth_hit> hits, const std::vector<Tint>& tints, double least_alpha) {
  std::sort(hits.begin(), hits.end(), [](const Depth_hit& a, const Depth_hit& b) { return a.piece < b.piece; });
  double least = 2;
  Layer layer;
  for (const Depth_hit& hit : hits) {
    if (tints[hit.piece].alpha < least_alpha || hit.depth >= least) continue;
    least = hit.depth;
    layer.put_before(tints[hit.piece]);
  }
  return layer;
}

/// Over what hides all the weighted mean of what is before that.
Layer by_weights(const std::vector<Depth_hit>& hits, const std::vector<Tint>& tints) {
  Colour sum{};
  double weights = 0, through = 1;
  for (const Depth_hit& hit : hits) {  // nearest first
    const Tint& tint = tints[hit.piece];
    if (tint.alpha >= 1) break;
    const double weight = tint.alpha * std::max(1e-2, 3e3 * std::pow(1 - hit.depth, 3));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * tint.colour[k];
    weights += weight;
    through *= 1 - tint.alpha;
  }
  Layer layer = in_order_of_faces(hits, tints, 1);
  if (weights > 0) {
    for (double& c : sum) c /= weights;
    layer.put_before({sum, 1 - through});
  }
  return layer;
}

/// One image: what is seen, and what is blended.
std::string flaw_of_image(const Depth_case& drawn, Random& random) {
  if (drawn.scene.pieces().empty()) return {};
  const Pixel_view pixels = generate::any_pixel_view(drawn.soup, drawn.eye, random);
  const double volume = dot(pixels.look, cross(pixels.right, pixels.up)),
               sizes = dot(pixels.look, pixels.look) * dot(pixels.right, pixels.right) * dot(pixels.up, pixels.up);
  // Directions nearly in a plane, or of very different lengths, of which floats know little.
  if (!(volume * volume > 1e-6 * sizes) || !(sizes > 0x1p-60 && sizes < 0x1p60)) return {};
  const std::vector<Tint> tints = any_tints(drawn.scene.pieces().size(), random);
  const Depth_image image = depth_image(drawn.scene, pixels, drawn.options);
  const Blended_depth blended = depth_blended(drawn.scene, pixels, tints, drawn.options),
                      weighted = weighted_blended(drawn.scene, pixels, tints, drawn.options);
  if (image.not_finite != 0) return {};  // nothing is before the eye
  if (image.near != blended.near || image.far != weighted.far) return "images of one view have other planes";
  const Clip clip{image.near, image.far, drawn.options.bits}, all{1e-9, 1e9, 32};
  const Seen_pieces pieces(drawn.scene, drawn.eye);
  for (std::uint32_t y = 0; y < pixels.height; ++y)
    for (std::uint32_t x = 0; x < pixels.width; ++x) {
      Pixel_ray ray{pixels.ray(x, y), pixels.right, pixels.up};
      for (std::size_t k = 0; k < 3; ++k) {
        ray.right[k] /= 32.0 * pixels.width;
        ray.up[k] /= 32.0 * pixels.height;
      }
      if (const auto everything = hits_of(pieces, ray, all))
        if (const std::string flaw = flaw_of_planes(drawn.options, clip, *everything); !flaw.empty()) return flaw;
      const auto hits = hits_of(pieces, ray, clip);
      if (!hits) continue;
      const std::size_t at = std::size_t{y} * pixels.width + x;
      const std::uint32_t expected = hits->empty() ? Piece_image::nothing : hits->front().piece;
      const std::string place = "pixel " + std::to_string(x) + "," + std::to_string(y);
      if (image.image.pieces[at] != expected)
        return place + " shows " + name_of(image.image.pieces[at]) + ", a ray meets " + name_of(expected) + " first";
      if (!is_near(blended.layers[at], in_order_of_faces(*hits, tints, 0), 1e-9))
        return place + " blends otherwise than its faces in their order";
      const bool is_steep =
          std::any_of(hits->begin(), hits->end(), [](const Depth_hit& hit) { return 1 - hit.depth < 200 * hit.slack; });
      if (!is_steep && !is_near(weighted.layers[at], by_weights(*hits, tints), 0.04))
        return place + " is not the weighted mean of its faces";
    }
  return {};
}

template <class Run>
bool is_refused(Run run) {
  try {
    run();
  } catch (const std::invalid_argument&) {
    return true;
  }
  return false;
}

/// What is out of bounds is refused, and what is at them is not.
std::string flaw_of_bounds(Random& random) {
  struct Planes {
    float near, far;
    bool wrong;
  };
  const std::array<std::uint32_t, 4> sizes{0, 1, 2, 16385};
  const std::array<int, 5> all_bits{0, 1, 31, 32, 33};
  const std::array<Planes, 9> all_planes{{{0, 0, false},
                                          {1, 2, false},
                                          {0, 4, false},
                                          {1, 0, false},
                                          {2, 1, true},
                                          {1, 1, true},
                                          {-1, 1, true},
                                          {0, 1, true},
                                          {8, 0, true}}};
  const std::size_t which = random.below(3);
  const std::size_t i = which == 0 ? random.below(sizes.size()) : 2, j = which == 1 ? random.below(all_bits.size()) : 2;
  const Planes& planes = all_planes[which == 2 ? random.below(all_planes.size()) : 0];
  const Depth_buffer_options options{sizes[i], all_bits[j], planes.near, planes.far};
  const bool wrong = i == 0 || i == 3 || j == 0 || j == 4 || planes.wrong;
  const Exact_point eye{0, 0, 0};
  const Scene scene(generate::soup_of({generate::rectangle(-1, 1, -1, 1, 3)}));
  Pixel_view pixels{eye, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, options.size, 3};
  if (random.chance(1, 2)) std::swap(pixels.width, pixels.height);
  const bool buffer_refused = is_refused([&] { depth_buffer(scene, eye, options); }),
             image_refused = is_refused([&] { depth_image(scene, pixels, options); });
  if (buffer_refused != wrong || image_refused != wrong)
    return "size " + std::to_string(options.size) + ", bits " + std::to_string(options.bits) + ", planes " +
           std::to_string(options.near) + " and " + std::to_string(options.far) + " are refused, or are not";
  pixels.width = pixels.height = 4;
  if (!is_refused([&] { depth_blended(scene, pixels, {}); })) return "faces without tints are not refused";
  pixels.up = pixels.right;
  if (!is_refused([&] { depth_image(scene, pixels); })) return "directions in a plane are not refused";
  return {};
}

/// What floats do not hold is left out, and counted.
std::string flaw_of_floats(Random& random) {
  const Rational huge = generate::power_of_two(122), tiny = generate::power_of_two(-145);
  generate::Faces faces{generate::rectangle(-1, 1, -1, 1, 3)};
  if (random.chance(1, 2)) faces.push_back({{0, 0, huge}, {1, 0, 5}, {0, 1, 5}});
  const Polygon_soup soup = generate::soup_of(faces);
  const Depth_buffer_options options{4, 24, 0, 0};
  const auto left_out = [&](const Polygon_soup& all, const Exact_point& eye) {
    const Scene scene(all);
    const Pixel_view pixels{eye, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4};
    const std::uint64_t of_image = depth_image(scene, pixels, options).not_finite;
    return of_image == depth_buffer(scene, eye, options).not_finite ? of_image : scene.pieces().size() + 1;
  };
  if (left_out({}, {0, 0, 0}) != 0) return "an empty scene has something to leave out";
  if (left_out(soup, {0, 0, 0}) != soup.face_count() - 1) return "what floats do not hold is not left out, or more is";
  if (left_out(soup, {0, 0, generate::power_of_two(130)}) != soup.face_count())
    return "from an eye that floats do not hold something is drawn";
  if (left_out(generate::scaled(generate::soup_of({faces[0]}), tiny), {0, 0, 0}) != 1)
    return "planes are drawn between that floats do not tell apart";
  return {};
}

Outcome run(const Posed_scene&, Random& random) {
  const Depth_case drawn = any_case(random);
  std::string flaw;
  try {
    flaw = flaw_of_buffer(drawn);
    if (flaw.empty()) flaw = flaw_of_image(drawn, random);
  } catch (const std::invalid_argument&) {  // a plane that is given is on the wrong side of one that is not
    if ((drawn.options.near == 0) == (drawn.options.far == 0)) throw;
  }
  for (int k = 0; k < 12 && flaw.empty(); ++k) flaw = flaw_of_bounds(random);
  if (flaw.empty()) flaw = flaw_of_floats(random);
  return flaw.empty() ? Outcome{} : Outcome::failed(std::move(flaw));
}

}  // namespace depth_laws

Check depth_check() {
  return check_of_a_share("depth buffers", "depth buffers and blending by depth, at pixels where floats tell", 8,
                          depth_laws::run);
}

}  // namespace sightline::harness
