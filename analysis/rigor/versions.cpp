#include "analysis/rigor/versions.hpp"

#include <mpfr.h>

#include <Eigen/Core>

namespace veritrack::rigor {

std::vector<std::pair<std::string, std::string>> arithmetic_versions() {
#if defined(__clang__)
  const std::string compiler = "clang++";
  const std::string compiler_version = __clang_version__;
#else
  const std::string compiler = "g++";
  const std::string compiler_version = __VERSION__;
#endif
  const auto dotted = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return {{compiler, compiler_version},
          {"MPFR", mpfr_get_version()},
          {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
}

}  // namespace veritrack::rigor
