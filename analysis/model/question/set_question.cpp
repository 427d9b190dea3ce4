#include "analysis/model/question/set_question.hpp"

#include <cstddef>
#include <utility>

namespace veritrack::model {

namespace {

/// The largest deviations of starts, for shapes; empty where none are assumed.
Eigen::VectorXd largest_deviations(const SetQuestion& question) {
  Eigen::VectorXd sizes;
  if (question.assumes_start) {
    sizes.resize(static_cast<Eigen::Index>(question.deviations.size()));
    for (std::size_t i = 0; i < question.deviations.size(); ++i) {
      sizes[static_cast<Eigen::Index>(i)] = question.deviations[i].upper();
    }
  }
  return sizes;
}

}  // namespace

std::vector<SetTask> tasks_of(const SetQuestion& question) {
  using enum ShapeObjective;
  const Eigen::VectorXd deviations = largest_deviations(question);
  // An amplitude that varies is a disturbance, even without noise. (Parts of a range are narrow: shapes are
  // those of one amplitude; see TubeSearch::prove.)
  const bool varies = question.tracker.amplitude_varies && !question.tone_at;
  std::vector<SetTask> tasks;
  tasks.push_back({.name = kStarts,
                   .objective = varies ? largest_noise : largest_starts,
                   .with_curve = true,
                   .deviations = deviations});
  if (question.is_disturbed()) {
    tasks.push_back({.name = kAssumed,
                     .objective = question.noise > 0.0 ? largest_noise : largest_slew,
                     .noise = question.noise,
                     .slew = question.slew,
                     .deviations = deviations});
  }
  if (question.required_error) {
    tasks.back().largest_error = question.required_error->lower();
  }
  if (question.deadline.is_set() && tasks.size() > 1) {
    std::swap(tasks[0], tasks[1]);  // the requirement rests on it
  }
  if (question.largest_noise) {
    tasks.push_back(
        {.name = kLargestNoise, .objective = largest_noise, .largest_noise = true, .deviations = {}});
  }
  if (question.largest_slew) {
    // A shape for the slew alone leaves no room for amplitudes; that of a filter is for both.
    const bool is_alone = !varies || question.tone.filter != nullptr;
    tasks.push_back({.name = kLargestSlew,
                     .objective = is_alone ? largest_slew : largest_noise,
                     .largest_slew = true,
                     .deviations = {}});
  }
  for (SetTask& task : tasks) {
    task.deadline = question.deadline;
    task.of_each_cell = question.is_thorough;
  }
  return tasks;
}

}  // namespace veritrack::model
