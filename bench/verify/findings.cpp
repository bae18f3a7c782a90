#include "bench/verify/findings.h"

#include <cstdio>

namespace ccdt::verification {

Check make_check(std::string name, bool required) {
  Check check;
  check.name = std::move(name);
  check.required = required;
  return check;
}

std::string text(const Point3& p) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%.17g, %.17g, %.17g)", p.x, p.y, p.z);
  return buffer;
}

}  // namespace ccdt::verification
