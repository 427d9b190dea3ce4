#include "analysis/model/question/set_question.hpp"

#include <doctest/doctest.h>

#include <string>

#include "tests/analysis/model/tube_examples.hpp"

namespace veritrack::model {
namespace {

using rigor::Interval;

SetQuestion question_of(const test::Example& loop) {
  SetQuestion question{.tone = test::tone_of(loop.tracker), .tracker = loop.model};
  question.band = {0.3, 0.31, {}};
  question.deviations = {Interval(0.002), Interval(0.01)};
  return question;
}

std::string names_of(const SetQuestion& question) {
  std::string names;
  for (const SetTask& task : tasks_of(question)) {
    names += task.name + " ";
  }
  return names;
}

TEST_CASE("the sets of a question: for starts, and for each disturbance that is assumed or asked for") {
  const test::Example loop(test::phase_locked_loop());
  SetQuestion question = question_of(loop);
  CHECK(names_of(question) == "starts ");
  question.largest_noise = true;
  CHECK(names_of(question) == "starts noise ");
  question.slew = 1e-6;
  question.largest_slew = true;
  CHECK(names_of(question) == "starts assumed noise slew ");
  // Under a deadline what is required comes first.
  question.deadline = search::Deadline(1e6);
  CHECK(names_of(question) == "assumed starts noise slew ");
  question.slew = 0.0;
  CHECK(names_of(question) == "starts noise slew ");
  question.noise = 0.01;
  question.is_thorough = true;
  for (const SetTask& task : tasks_of(question)) {
    CHECK(task.deadline.is_set());
    CHECK(task.of_each_cell);
    CHECK(task.noise == (task.name == "assumed" ? 0.01 : 0.0));
    CHECK(task.largest_noise == (task.name == "noise"));
    CHECK(task.largest_slew == (task.name == "slew"));
    CHECK(task.with_curve == (task.name == "starts"));
  }
}

TEST_CASE("the requirement is for the set of what is assumed; starts are those that are assumed") {
  const test::Example loop(test::phase_locked_loop());
  SetQuestion question = question_of(loop);
  question.required_error = Interval::from_bounds(0.01, 0.02);
  CHECK(tasks_of(question).front().largest_error == 0.01);
  CHECK(tasks_of(question).front().deviations.size() == 0);
  question.assumes_start = true;
  question.noise = 0.01;
  question.largest_noise = true;
  question.deadline = search::Deadline(1e6);
  for (const SetTask& task : tasks_of(question)) {
    CHECK(task.largest_error == (task.name == "assumed" ? 0.01 : 0.0));
    CHECK(task.deviations.size() == (task.name == "noise" ? 0 : 2));
  }
  CHECK(tasks_of(question).front().deviations[1] == 0.01);
}

TEST_CASE("shapes are for the disturbance that there is; amplitudes that vary are one") {
  const test::Example loop(test::phase_locked_loop());
  SetQuestion question = question_of(loop);
  const auto objective = [&](const char* name) {
    for (const SetTask& task : tasks_of(question)) {
      if (task.name == name) {
        return task.objective;
      }
    }
    return ShapeObjective::largest_starts;
  };
  question.slew = 1e-6;
  question.largest_slew = true;
  CHECK(objective("starts") == ShapeObjective::largest_starts);
  CHECK(objective("assumed") == ShapeObjective::largest_slew);
  CHECK(objective("slew") == ShapeObjective::largest_slew);
  question.noise = 0.01;
  CHECK(objective("assumed") == ShapeObjective::largest_noise);
  question.tracker.amplitude_varies = true;
  CHECK(objective("starts") == ShapeObjective::largest_noise);
  CHECK(objective("slew") == ShapeObjective::largest_noise);
  // Cut into parts, each of which is narrow, the amplitudes hardly disturb.
  question.tone_at = [&](double, double) { return question.tone; };
  CHECK(objective("starts") == ShapeObjective::largest_starts);
  CHECK(objective("slew") == ShapeObjective::largest_slew);
}

}  // namespace
}  // namespace veritrack::model
