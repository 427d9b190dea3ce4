// Certifies a design with the library and prints its claims.
#include <cstdio>
#include <exception>

#include "certificates/document/certificate.hpp"

int main(int count, char** words) {
  if (count != 2) {
    return 2;
  }
  try {
    for (const auto& claim : veritrack::certificates::certify_file(words[1]).claims) {
      if (claim.required) {
        std::printf("%s %s\n", std::string(veritrack::rigor::to_string(claim.verdict)).c_str(),
                    claim.id.c_str());
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
