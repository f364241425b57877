#include <sightline/harness/laws/manners.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/crowd.h>
#include <sightline/kernel/scene/scene.h>

#include <atomic>
#include <utility>

namespace sightline::harness {

namespace {

struct Given_up {};

/// Who is told how far something is; gives up the so manyth time.
class Listener {
 public:
  explicit Listener(std::size_t patience) : patience_(patience) {}
  auto teller() {
    return [this](std::size_t done, std::size_t all) {
      if (done > all) is_beyond_ = true;
      if (++times_ > patience_) throw Given_up();
    };
  }
  bool is_beyond() const { return is_beyond_; }
  std::size_t times() const { return times_; }
  bool has_given_up() const { return times_ > patience_; }

 private:
  const std::size_t patience_;
  std::atomic<std::size_t> times_{0};
  std::atomic<bool> is_beyond_{false};
};

std::string flaw_of_manners(const Question& question, const Posed_scene& posed, Random& random) {
  const std::uint64_t choice = random.below(1u << 20);
  const std::string alone = question.ask(posed, {}, choice);
  const auto threads = [&] { return static_cast<int>(random.below(5)); };  // 0: as many as there are
  // 1. To somebody who listens.
  Listener listener(~std::size_t{0});
  const int so_many = threads();
  if (question.ask(posed, {so_many, listener.teller()}, choice) != alone)
    return question.name + " is another one by " + std::to_string(so_many) + " threads";
  if (listener.is_beyond()) return question.name + " tells of more than all";
  if (question.always_tells && listener.times() == 0)
    if (const Scene scene(posed.soup); !scene.pieces().empty()) return question.name + " tells nothing of its progress";
  // 2. To somebody who gives up on the way.
  Listener impatient(random.below(listener.times() + 1));
  try {
    const std::string answer = question.ask(posed, {threads(), impatient.teller()}, choice);
    if (impatient.has_given_up()) return question.name + " goes on though who is told has given up";
    if (answer != alone) return question.name + " is another one when it is told of";
  } catch (const Given_up&) {
  }
  return {};
}

}  // namespace

Check manners_check(std::vector<Question> questions) {
  return {"manners", "the same by several threads, whatever is told of progress, and nothing once that gives up",
          [questions = std::move(questions)](const Posed_scene& posed, const Answer&, Random& random) {
            constexpr std::size_t most_faces = 40, of_a_crowd = 1200, of_a_pile = 48;
            if (posed.soup.face_count() > most_faces) return Outcome::not_applicable();
            const Question& question = questions[random.below(questions.size())];
            Posed_scene scene = posed;
            if (question.is_for_crowds && random.chance(1, 4))  // beside each other, or piled up
              scene.soup = random.chance(2, 3) ? crowd(posed.soup, of_a_crowd, 1)
                                               : crowd(posed.soup, of_a_pile, generate::ratio(1, 50));
            const std::string flaw = flaw_of_manners(question, scene, random);
            return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
          },
          8};
}

}  // namespace sightline::harness
