#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <sightline/kernel/threads.h>

#include <algorithm>
#include <atomic>

namespace sightline {

std::vector<std::uint32_t> first_pieces(const std::vector<Piece>& pieces) {
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (i == 0 || pieces[i].face != pieces[i - 1].face) first.push_back(i);
  return first;
}

void for_each_face(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& first, int threads,
                   const std::function<void(std::size_t, std::size_t)>& progress,
                   const std::function<void(std::size_t f, std::uint32_t begin, std::uint32_t end)>& decide) {
  std::atomic<std::size_t> done = 0;
  run_with_threads(threads, [&] {
    parallel_for(first.size(), [&](std::size_t f) {
      decide(f, first[f], f + 1 < first.size() ? first[f + 1] : static_cast<std::uint32_t>(pieces.size()));
      if (progress) progress(++done, first.size());
    });
  });
}

}  // namespace sightline
