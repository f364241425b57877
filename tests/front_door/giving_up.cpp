// Questions that are given up: by budgets, by what progress throws, while they wait; and what no question made.

#include "models.h"

#include <sightline/harness/generate/families.h>
#include <sightline/sightline.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace sightline;

TEST(Answers, say_that_the_budget_ran_out) {
  const Model model = lamp_and_lid();
  Asking hasty;
  hasty.budget = 1e-9;
  EXPECT_THROW(order(model, {0, 0, 10}, hasty), Out_of_budget);
  EXPECT_THROW(see(model, {0, 0, 10}, hasty), Out_of_budget);
  EXPECT_THROW(see_along(model, {0, 0, 10}, {0, 0, 2}, hasty), Out_of_budget);
  EXPECT_THROW(combine("union", {cube(), cube()}, "positive", hasty), Out_of_budget);
  const Weak_visibility open = weakly_visible(model, 2, hasty);
  EXPECT_EQ(open.visible.size() + open.hidden.size() + open.undecided.size(), 3u);
  EXPECT_FALSE(open.undecided.empty());
  EXPECT_TRUE(verify(model, open.certificate()).accepted);
  Asking patient;
  patient.budget = 1e9;
  EXPECT_EQ(order(model, {0, 0, 10}, patient).parts.size(), 3u);
  EXPECT_THROW(order(model, {0, 0, 10}, hasty), Out_of_budget);  // though its tree is there
  EXPECT_TRUE(weakly_visible(model, 2, patient).undecided.empty());
}

TEST(Answers, what_progress_throws_ends_the_question) {
  struct Enough {};
  const Asking impatient{1, [](std::size_t, std::size_t) { throw Enough(); }};
  const Model model = lamp_and_lid();
  EXPECT_THROW(order(model, {0, 0, 10}, impatient), Enough);
  EXPECT_THROW(see(model, {0, 0, 10}, impatient), Enough);
  EXPECT_THROW(see_along(model, {0, 0, 10}, {0, 0, 2}, impatient), Enough);
  EXPECT_THROW(combine("union", {cube(), cube()}, "positive", impatient), Enough);
  EXPECT_THROW(weakly_visible(model, 2, impatient), Enough);
  EXPECT_EQ(order(model, {0, 0, 10}).parts.size(), 3u);  // and the model is as it was
}

/// Every question that takes an Asking.
std::vector<std::pair<std::string, std::function<void(const Asking&)>>> questions(const Model& model) {
  const Exact_point eye{0, 0, 10}, end{0, 0, 2};
  const std::vector<Exact_point> field{{-1, -1, -4}, {-1, 1, -4}, {1, 1, -4}, {1, -1, -4}};
  const std::vector<Exact_ray> rays{{eye, {0, 0, -1}}};
  const std::vector<Double_ray> doubles{{{0, 0, 10}, {0, 0, -1}}};
  const Model box = cube();
  const std::vector<Polygon_soup> solids{box.soup()};
  const auto lamp = sources_of(model, 2);
  const std::string claim = order(model, eye).certificate();
  const Combined both = combine("union", {box, box});
  const std::string solid_claim = both.certificate();
  return {
      {"order", [=](const Asking& a) { order(model, eye, a); }},
      {"priority_graph", [=](const Asking& a) { priority_graph(model, a); }},
      {"see", [=](const Asking& a) { see(model, eye, a); }},
      {"see_in_field", [=](const Asking& a) { see_in_field(model, eye, field, a); }},
      {"weakly_visible", [=](const Asking& a) { weakly_visible(model, lamp, a); }},
      {"possibly_visible", [=](const Asking& a) { possibly_visible(model, lamp, a); }},
      {"weakly_visible_from_solids", [=](const Asking& a) { weakly_visible_from_solids(model, solids, lamp, a); }},
      {"possibly_visible_from_solids", [=](const Asking& a) { possibly_visible_from_solids(model, solids, lamp, a); }},
      {"see_along", [=](const Asking& a) { see_along(model, eye, end, a); }},
      {"trace", [=](const Asking& a) { trace(model, rays, Ray_start::open, a); }},
      {"trace_all", [=](const Asking& a) { trace_all(model, rays, Ray_start::open, a); }},
      {"nearest", [=](const Asking& a) { nearest(model, doubles, Ray_start::open, a); }},
      {"combine",
       [=](const Asking& a) {
         combine("union", {box, box}, "positive", a);
       }},
      {"verify", [=](const Asking& a) { verify(model, claim, a); }},
      {"verify of solids", [=](const Asking& a) {
         verify({box, box}, both.model, solid_claim, a);
       }}};
}

TEST(Answers, what_progress_throws_ends_a_question_that_finds_all_made) {
  struct Enough {};
  const Model model = lamp_and_lid();
  for (const auto& [name, ask] : questions(model))
    for (const int threads : {1, 4}) {
      ask({threads, {}});
      EXPECT_THROW(ask({threads, [](std::size_t, std::size_t) { throw Enough(); }}), Enough) << name;
      std::atomic<std::size_t> beyond = 0;
      ask({threads, [&](std::size_t done, std::size_t all) { beyond += done > all; }});
      EXPECT_EQ(beyond, 0u) << name;
    }
}

TEST(Answers, certificates_and_lines_are_given_up_by_what_progress_throws) {
  struct Enough {};
  generate::Family_parameters parameters;
  parameters.seed = 3;
  parameters.size = 400;
  const Model small = lamp_and_lid(), large(generate::family("triangles_between_squares").make(parameters).soup);
  const auto check = [](const char* name, const Answer& answer, std::size_t least) {
    std::atomic<std::size_t> calls = 0;
    EXPECT_EQ(answer.certificate([&](std::size_t, std::size_t) { ++calls; }), answer.certificate()) << name;
    EXPECT_GE(calls, least) << name;
    // The last of them is in the middle of the text, where it has to come out of a stream.
    calls = 0;
    EXPECT_THROW(answer.certificate([&](std::size_t, std::size_t) {
      if (++calls == least) throw Enough();
    }),
                 Enough)
        << name;
  };
  check("order", order(large, {1, 2, 50}), 5);
  check("priority_graph", priority_graph(large), 3);
  check("see", see(large, {1, 2, 50}), 5);
  check("weakly_visible", weakly_visible(small, 2), 1);
  check("see_along", see_along(small, {0, 0, 10}, {0, 0, 2}), 2);
  check("combine", combine("union", {cube(), cube()}), 2);
  const Seen seen = see(small, {0, 0, 10});
  EXPECT_THROW(seen.lines([](std::size_t, std::size_t) { throw Enough(); }), Enough);
  EXPECT_THROW(see(large, {1, 2, 50}).certificate(progress_within_budget({1, {}, 1e-9})), Out_of_budget);
}

TEST(Answers, that_no_question_made_say_so) {
  EXPECT_THROW(Seen().area(0), std::logic_error);
  EXPECT_THROW(Seen().solid_angle(0), std::logic_error);
  EXPECT_THROW(Seen().lines(), std::logic_error);
  EXPECT_THROW(Seen().certificate(), std::logic_error);
  EXPECT_THROW(Visibility_order().certificate(), std::logic_error);
}

TEST(Answers, end_a_wait_for_what_another_thread_makes) {
  struct Enough {};
  const Model model = lamp_and_lid();
  std::atomic<bool> is_making = false, may_go_on = false, gave_up = false;
  Asking slow;
  slow.threads = 1;
  slow.progress = [&](std::size_t, std::size_t) {
    is_making = true;
    // A wait that nothing ends is over after a while, so that the test fails and does not hang.
    for (int k = 0; k < 2000 && !may_go_on; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    gave_up = gave_up || !may_go_on;
  };
  std::thread maker([&] { EXPECT_EQ(order(model, {0, 0, 10}, slow).parts.size(), 3u); });
  while (!is_making) std::this_thread::yield();
  Asking hasty;
  hasty.budget = 0.05;
  EXPECT_THROW(order(model, {1, 2, 10}, hasty), Out_of_budget);
  EXPECT_THROW(order(model, {1, 2, 10}, {1, [](std::size_t, std::size_t) { throw Enough(); }}), Enough);
  EXPECT_FALSE(gave_up);
  // Whom nothing ends gets it.
  std::thread waiter([&] { EXPECT_EQ(order(model, {1, 2, 10}).parts.size(), 3u); });
  may_go_on = true;
  maker.join();
  waiter.join();
}

TEST(Answers, are_made_by_who_waits_where_who_made_them_gave_up) {
  struct Enough {};
  const Model model = lamp_and_lid();
  std::atomic<bool> is_making = false, is_waiting = false;
  std::thread maker([&] {
    const auto give_up = [&](std::size_t, std::size_t) {
      is_making = true;
      for (int k = 0; k < 2000 && !is_waiting; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      throw Enough();
    };
    EXPECT_THROW(order(model, {0, 0, 10}, {1, give_up}), Enough);
  });
  while (!is_making) std::this_thread::yield();
  const auto wait = [&](std::size_t, std::size_t all) {
    if (!is_waiting) {
      EXPECT_EQ(all, 1u) << "as one that waits is told";
    }
    is_waiting = true;
  };
  EXPECT_EQ(order(model, {1, 2, 10}, {1, wait}).parts.size(), 3u);
  maker.join();
}

}  // namespace
