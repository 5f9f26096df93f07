#include <cmath>

#include "src/verify/case.hpp"

namespace galet::verify {

void Report::near(const std::string& quantity, double value, double exact, double bound, const std::string& reason) {
  checks_.push_back({quantity, value, exact, std::abs(value - exact), bound, reason});
}

void Report::relative(const std::string& quantity, double value, double exact, double bound,
                      const std::string& reason) {
  checks_.push_back({quantity, value, exact, std::abs(value / exact - 1), bound, reason});
}

void Report::small(const std::string& quantity, double value, double bound, const std::string& reason) {
  near(quantity, value, 0, bound, reason);
}

}  // namespace galet::verify
