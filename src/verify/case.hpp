// Cases of `galet verify`: scenes whose answer is known, exactly or from an independent computation, one table per
// family. A case runs with one engine at a time and reports what it found as checks: value, exact value, error, bound.
// A bound follows from the scheme's order, the solver's tolerance or the scatter of a mean, and says which; none is a
// matter of taste.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace galet::verify {

/// One number that a case looks at. `error` is in the units of `bound`.
struct Check {
  std::string quantity;
  double value = 0;
  double exact = 0;
  double error = 0;
  double bound = 0;
  std::string reason;                           ///< of the bound
  bool pass() const { return error <= bound; }  // not a number fails
};

/// What a case says of its run with one engine.
class Report {
 public:
  /// |value - exact| <= bound.
  void near(const std::string& quantity, double value, double exact, double bound, const std::string& reason);
  /// |value / exact - 1| <= bound.
  void relative(const std::string& quantity, double value, double exact, double bound, const std::string& reason);
  /// |value| <= bound, for what is zero in the exact answer.
  void small(const std::string& quantity, double value, double bound, const std::string& reason);

  void add_steps(long steps) { steps_ += steps; }
  long steps() const { return steps_; }
  const std::vector<Check>& checks() const { return checks_; }

 private:
  std::vector<Check> checks_;
  long steps_ = 0;
};

/// How long a case takes in the release preset, both engines together.
enum class Effort {
  brief,  ///< a fraction of a second
  quick,  ///< some seconds; with the brief ones under a minute
  full    ///< up to minutes
};

/// What an engine does with a case.
enum class Stance {
  runs,
  refuses,  ///< stops with an error whose text holds `why`; that is the right answer
  absent    ///< the case has no meaning for this engine; `why` says so
};
struct Part {
  Stance stance = Stance::runs;
  std::string why = {};
};

struct Case {
  std::string name;
  std::vector<std::string> tags;
  Effort effort = Effort::brief;
  std::string scene;    ///< what is run
  std::string exact;    ///< where the exact answer comes from
  std::string trouble;  ///< what instability, drift or a wrong law would look like
  std::function<void(EngineKind, Report&)> run;
  Part md = {}, cd = {};

  const Part& part(EngineKind engine) const { return engine == EngineKind::md ? md : cd; }
};

std::vector<Case> statics_cases();
std::vector<Case> pile_cases();
std::vector<Case> impact_cases();
std::vector<Case> slope_cases();
std::vector<Case> gas_cases();
std::vector<Case> lattice_cases();
std::vector<Case> packing_cases();
std::vector<Case> extreme_cases();

}  // namespace galet::verify
