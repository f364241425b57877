// The price of one predicate, stage by stage, and of a whole cut: Google Benchmark. bench_predicates
// [--benchmark_filter=...]

#include <sightline/harness/generate/scenes.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/harness/generate/soups.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <benchmark/benchmark.h>

#include <random>

using namespace sightline;

namespace {

/// Vertices that are meets of three random planes of a soup on a grid of `bits` bits, and planes to test them against:
/// random ones, or (incident) the planes through each vertex's own three planes' common point, which no cheap stage can
/// see.
struct Queries {
  Polygon_soup soup;
  Scene scene;
  Exact_traits traits;
  std::vector<Vertex> vertices;
  std::vector<Prepared_plane> planes;

  explicit Queries(int bits) : soup(generate::soup(2000, 0.5, 1, bits)), scene(soup), traits(scene) {
    std::mt19937_64 random(1);
    const auto plane = [&] {
      return traits.supporting_plane(static_cast<std::uint32_t>(random() % traits.piece_count()));
    };
    while (vertices.size() < 1024) {
      try {
        const Vertex v = traits.predicates().meet(plane().id(), plane().id(), plane().id());
        if (std::isfinite(v.error)) vertices.push_back(v);
      } catch (const std::domain_error&) {  // parallel
      }
      planes.push_back(traits.prepare(plane()));
    }
    planes.resize(1024);
  }
};

const Queries& queries(int bits) {
  static std::map<int, std::unique_ptr<Queries>> made;
  auto& entry = made[bits];
  if (!entry) entry = std::make_unique<Queries>(bits);
  return *entry;
}

void side_of_a_meet_by_the_cascade(benchmark::State& state) {
  const Queries& q = queries(static_cast<int>(state.range(0)));
  Predicate_counts counts;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(q.traits.side(q.vertices[i % 1024], q.planes[i * 7 % 1024], counts));
    ++i;
  }
  state.counters["beyond_doubles"] =
      static_cast<double>(counts.fixed + counts.gmp) / static_cast<double>(std::max<std::uint64_t>(1, counts.total()));
}
BENCHMARK(side_of_a_meet_by_the_cascade)->Arg(12)->Arg(26)->Arg(30);

template <class Number>
void side_of_a_meet_in(benchmark::State& state) {
  const Queries& q = queries(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        q.traits.predicates().side_exact<Number>(q.vertices[i % 1024], q.planes[i * 7 % 1024].plane));
    ++i;
  }
}
BENCHMARK(side_of_a_meet_in<Fixed_integer<2>>)->Arg(12)->Name("side_of_a_meet_in_128_bits");
BENCHMARK(side_of_a_meet_in<Fixed_integer<4>>)->Arg(26)->Name("side_of_a_meet_in_256_bits");
BENCHMARK(side_of_a_meet_in<Fixed_integer<8>>)->Arg(30)->Name("side_of_a_meet_in_512_bits");
BENCHMARK(side_of_a_meet_in<Integer>)->Arg(26)->Name("side_of_a_meet_in_GMP");

void meet_of_three_planes(benchmark::State& state) {
  const Queries& q = queries(26);
  std::size_t i = 0;
  for (auto _ : state) {
    const Vertex& v = q.vertices[i++ % 1024];
    benchmark::DoNotOptimize(q.traits.predicates().meet(v.plane[0], v.plane[1], v.plane[2]));
  }
}
BENCHMARK(meet_of_three_planes);

/// Tests a triangle against planes that cross it, and cuts it: the rate of exact polygon-plane cuts.
template <class Traits>
void cut(benchmark::State& state, const Traits& traits) {
  Split_scratch<Traits> scratch;
  Predicate_counts counts;
  Polygon_store<Traits> store;
  std::vector<std::pair<Convex_polygon<Traits>, typename Traits::Cutter>> crossing;
  for (std::uint32_t i = 0; i < traits.piece_count() && crossing.size() < 4096; ++i) {
    const auto polygon = store.piece(traits, i);
    for (std::uint32_t j = 0; j < traits.piece_count() && crossing.size() < 4096; j += 97) {
      const auto cutter = traits.prepare(traits.supporting_plane(j));
      if (position(traits, polygon, cutter, counts) == Position::across) crossing.emplace_back(polygon, cutter);
    }
  }
  std::size_t i = 0;
  auto out = std::make_unique<Polygon_store<Traits>>();
  for (auto _ : state) {
    const auto& [polygon, cutter] = crossing[i++ % crossing.size()];
    if (classify(traits, polygon, cutter, scratch, counts) == Position::across)
      benchmark::DoNotOptimize(split(traits, polygon, cutter, scratch, *out));
    if (i % 65536 == 0) out = std::make_unique<Polygon_store<Traits>>();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
void cut_exact(benchmark::State& state) { cut(state, queries(26).traits); }
void cut_double(benchmark::State& state) {
  cut(state, Point_traits<CGAL::Simple_cartesian<double>>(queries(26).scene));
}
void cut_epeck(benchmark::State& state) { cut(state, Point_traits<CGAL::Epeck>(queries(26).scene)); }
BENCHMARK(cut_exact);
BENCHMARK(cut_double);
BENCHMARK(cut_epeck);

}  // namespace

BENCHMARK_MAIN();
