// The keys of a design file, each declared once: its name, what is allowed, how it is read, and what holds
// without it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "certificates/design/design.hpp"
#include "certificates/design/toml_value.hpp"

namespace veritrack::certificates {

/// What holds when a key is left out.
struct Absence {
  enum class Rule { is_an_error, is_nothing, is_default };
  Rule rule = Rule::is_an_error;
  std::string_view default_toml;  ///< for is_default: the value, as TOML
};

/// A key of the table that fills a Target.
template <typename Target>
struct Key {
  std::string_view name;
  std::string_view allowed;  ///< completes "allowed: ..."
  /// Checks the value and stores it. Throws InputError. Needs the upward rounding mode.
  void (*read)(const TomlValue& value, Target& target);
  Absence absence;
};

/// The keys above the first table.
[[nodiscard]] std::span<const Key<Design>> top_keys();
/// [design], for the tracker "quadrature-ekf".
[[nodiscard]] std::span<const Key<QuadratureEkfDesign>> quadrature_ekf_keys();
/// [design], for the tracker "single-channel-ekf".
[[nodiscard]] std::span<const Key<SingleChannelEkfDesign>> single_channel_ekf_keys();
/// [assume]
[[nodiscard]] std::span<const Key<Assumptions>> assume_keys();
/// [assume] of a tracker whose frequency may also be a single number.
[[nodiscard]] std::span<const Key<Assumptions>> assume_keys_with_one_frequency();
/// [require]
[[nodiscard]] std::span<const Key<Requirements>> require_keys();
/// [simulate]
[[nodiscard]] std::span<const Key<SimulationSettings>> simulate_keys();
/// [theorem_2_9]
[[nodiscard]] std::span<const Key<Theorem29Parameters>> theorem_2_9_keys();

/// [design], [assume] and [require] for the tracker "kkl-observer".
[[nodiscard]] std::span<const Key<KklObserverDesign>> kkl_design_keys();
[[nodiscard]] std::span<const Key<KklAssumptions>> kkl_assume_keys();
[[nodiscard]] std::span<const Key<KklRequirements>> kkl_require_keys();

/// Calls visit(name, keys, member) for each table of the tracker whose tables are `Tables`, in the order of a
/// design file; `member` is the part of Tables that the table fills.
template <typename Tables, typename Visitor>
void for_each_table(Visitor visit) {
  if constexpr (std::is_same_v<Tables, KklObserverTables>) {
    visit("design", kkl_design_keys(), &Tables::design);
    visit("assume", kkl_assume_keys(), &Tables::assume);
    visit("require", kkl_require_keys(), &Tables::require);
  } else if constexpr (std::is_same_v<Tables, QuadratureEkfTables>) {
    visit("design", quadrature_ekf_keys(), &Tables::design);
    visit("assume", assume_keys(), &Tables::assume);
    visit("require", require_keys(), &Tables::require);
    visit("simulate", simulate_keys(), &Tables::simulate);
    visit("theorem_2_9", theorem_2_9_keys(), &Tables::theorem_2_9);
  } else {
    static_assert(std::is_same_v<Tables, SingleChannelEkfTables>, "a tracker without keys");
    visit("design", single_channel_ekf_keys(), &Tables::design);
    visit("assume", assume_keys_with_one_frequency(), &Tables::assume);
    visit("require", require_keys(), &Tables::require);
    visit("simulate", simulate_keys(), &Tables::simulate);
  }
}

/// The trackers that a design file can name, in the order of the alternatives of Design::tables.
inline constexpr std::array<std::string_view, std::variant_size_v<decltype(Design::tables)>> kTrackerNames{
    "quadrature-ekf", "kkl-observer", "single-channel-ekf"};

/// Empty tables for the tracker of that name; nothing when it is not known.
[[nodiscard]] std::optional<decltype(Design::tables)> make_tables(std::string_view tracker);

}  // namespace veritrack::certificates
