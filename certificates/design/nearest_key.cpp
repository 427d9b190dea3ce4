#include "certificates/design/nearest_key.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace veritrack::certificates {

namespace {

constexpr std::size_t kComparedLimit = 100;  // bytes: no known key is nearly as long

std::string_view last_part(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the table distance(a[0..i), b[0..j)): the one being filled and the two before it.
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    current[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, current);
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replacement = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, replacement});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before_last[j - 2] + 1);
      }
    }
  }
  return current[b.size()];
}

const std::string& nearest_key(std::string_view path, std::span<const std::string> known) {
  path = path.substr(0, kComparedLimit);
  const std::string* nearest = &known.front();
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : known) {
    const std::size_t by_path = edit_distance(path, candidate);
    const std::size_t by_last_part = edit_distance(last_part(path), last_part(candidate)) + 1;
    const std::size_t distance = std::min(by_path, by_last_part);
    if (distance < least) {
      least = distance;
      nearest = &candidate;
    }
  }
  return *nearest;
}

}  // namespace veritrack::certificates
