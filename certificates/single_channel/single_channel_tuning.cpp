#include "certificates/single_channel/single_channel_tuning.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "analysis/single_channel/phase_certificate.hpp"
#include "certificates/sets/contraction.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "certificates/tuning/tuned_file.hpp"
#include "certificates/tuning/value_search.hpp"

namespace veritrack::certificates {

namespace {

constexpr std::array<std::string_view, 6> kObjectives{"long-run", "for-ever", "radius",
                                                      "noise",    "slew",     "simulated-rms"};

/// q1, q2, r and epsilon, whatever keys they come from.
DesignValues given_values(const SingleChannelDesignTable& design) {
  const std::string scale = design.q ? design.q->text : "1";
  const std::string r = design.lambda ? design.lambda->text : design.r.value().text;
  if (design.variances) {
    return {(*design.variances)[0].text, (*design.variances)[1].text, r, design.epsilon.text};
  }
  const bool is_identity = design.process_noise == SingleChannelDesignTable::ProcessNoise::identity;
  return {is_identity ? scale : "0", scale, r, design.epsilon.text};
}

void put(const DesignValues& values, SingleChannelEkfTables& tables) {
  tables.design = {};
  tables.design.process_noise = SingleChannelDesignTable::ProcessNoise::diagonal;
  tables.design.variances = {number_of(values.q1), number_of(values.q2)};
  tables.design.r = number_of(values.r);
  tables.design.epsilon = number_of(values.epsilon);
}

CertifiedValues certified_over_phases(const Design& design, const std::set<Objective>& needed) {
  const rigor::UpwardRounding upward;
  const SingleChannelEkfTables& tables = single_channel_tables(design);
  const auto model =
      trackers::at_unit_amplitude(enclosed_values(tables.design), tables.assume.amplitude.value);
  single_channel::PhaseQuestion question{
      contraction_question(model, tables.assume, tables.require),
      rigor::hull(tables.assume.frequency[0].value, tables.assume.frequency[1].value)};
  question.tracker.with_limits = needed.contains(Objective::noise) || needed.contains(Objective::slew);
  return values_of(single_channel::certify_over_phases(question).result, tables.require);
}

}  // namespace

std::span<const std::string_view> single_channel_tuning_objectives() {
  return kObjectives;
}

TuningResult tune_single_channel(const Design& design, const TuningRequest& request) {
  const SingleChannelEkfTables& tables = single_channel_tables(design);
  const DesignValues given = given_values(tables.design);
  const Objective objective = chosen_objective(request.objective, tables.assume);
  const bool leaks = !(tables.design.epsilon.value == rigor::Interval(0.0));
  if (leaks && !request.free_leak && objective != Objective::simulated_rms) {
    return {std::nullopt,
            "With a leak no bound is certified for this tracker, only its bias; --free-leak lets it become "
            "0, and "
            "--objective simulated-rms compares simulations."};
  }
  return tuned<SingleChannelEkfTables>(
      design, request, {given, put, certified_over_phases, [&](const DesignValues& values) {
                          std::vector<DesignEdit> edits{
                              {"process_noise", fmt::format("{{ q1 = {}, q2 = {} }}", values.q1, values.q2)},
                              {"r", values.r},
                              {"q", std::nullopt},
                              {"lambda", std::nullopt}};
                          if (values.epsilon != given.epsilon) {
                            edits.push_back({"epsilon", values.epsilon});
                          }
                          return edits;
                        }});
}

}  // namespace veritrack::certificates
